// Expectations of a project: how they are read, and when they hold.
#include <gtest/gtest.h>

#include <string>

#include "changed_project.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/judge.hpp"

namespace lockstep {
namespace {

/// A tag n that counts the ticks of a millisecond.
std::string project(const std::string& expectations) {
  return R"({ "lockstep": 1, "name": "counter", "clock": { "servo_cycle": "1ms" },
    "tags": { "n": { "type": "LINT" }, "x": { "type": "LREAL" }, "kind": { "type": "STRING[5]", "init": "K\u00F6l" },
      "t": { "type": "TIME", "init": "1500ms" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "set": "n", "to": "n + 1" }, { "set": "x", "to": "x + 0.5" } ] } ],
    "stimuli": [ { "at": "5ms", "set": { "kind": "ale" } } ],
    "expectations": )" +
         expectations + " }";
}

std::vector<std::string> judged(const std::string& expectations) {
  LoadedProject loaded = load_project(project(expectations));
  if (!loaded.project) return {lines(loaded.problems)};
  std::vector<std::string> results;
  for (const Judgement& one : judge(*loaded.project))
    results.push_back((one.holds ? "pass " : "fail ") + std::to_string(one.at / 1'000'000) + "ms " +
                      title_of(*one.expectation) + ": " + one.actual);
  return results;
}

TEST(Expectations, AreLookedAtInTheirTickAndAtTheEnd) {
  EXPECT_EQ(judged(R"([
    { "at": "4ms", "expect": "n = 5" }, { "at": "0ms", "expect": "n", "value": 1 },
    { "expect": "n = 21", "text": "counted to the end" },
    { "at": "10ms", "expect": "x", "value": 5.4, "tolerance": 0.11 },
    { "at": "10ms", "expect": "x", "value": 5.4, "tolerance": 0.09 } ], "duration": "21ms")"),
            (std::vector<std::string>{"pass 4ms n = 5: TRUE (n = 5)", "pass 0ms n = 1: 1",
                                      "pass 20ms counted to the end: TRUE (n = 21)",
                                      "pass 10ms x = 5.4 ± 0.11: 5.5", "fail 10ms x = 5.4 ± 0.09: 5.5"}));
}

TEST(Expectations, ShowTheValuesThatTheyName) {
  EXPECT_EQ(judged(R"([ { "at": "4ms", "expect": "kind = 'ale' AND n > 3 AND x > 9.0 AND t > T#1s" },
                        { "expect": "kind = 'ale'" } ], "duration": "8ms")"),
            (std::vector<std::string>{"fail 4ms kind = 'ale' AND n > 3 AND x > 9.0 AND t > T#1s: FALSE (kind "
                                      "= 'Köl', n = 5, x = 2.5, t = 1500ms)",
                                      "pass 7ms kind = 'ale': TRUE (kind = 'ale')"}));
  EXPECT_EQ(judged(R"([ { "at": "2ms", "expect": "x / 0.0 - x / 0.0", "value": 0, "tolerance": 1e300 } ])")[0]
                .substr(0, 8),
            "fail 2ms")
      << "what is no number is none that is expected";
}

TEST(Expectations, WithATimeTellHowLongToSimulate) {
  EXPECT_EQ(judged(R"([ { "expect": "n = 8" }, { "at": "7ms", "expect": "TRUE" } ])")[0],
            "pass 7ms n = 8: TRUE (n = 8)");
}

TEST(Expectations, AreCheckedWhenTheProjectIsLoaded) {
  const auto told = [](const std::string& expectations) {
    const LoadedProject loaded = load_project(project(expectations));
    return loaded.problems.size() == 1
               ? loaded.problems[0].place + ": " + loaded.problems[0].text
               : std::to_string(loaded.problems.size()) + " problems\n" + lines(loaded.problems);
  };
  EXPECT_NE(told(R"([ { "at": "1s", "expect": "n" } ])").find("/expectations/0/expect: "), std::string::npos);
  EXPECT_NE(
      told(R"([ { "at": "1s", "expect": "n = 1", "value": 1 } ])").find("with 'value' it has to be a number"),
      std::string::npos);
  EXPECT_NE(told(R"([ { "at": "1s", "expect": "m = 1" } ])").find("unknown name 'm'"), std::string::npos);
  EXPECT_NE(told(R"([ { "at": "1s", "expect": "n = (1" } ])").find("/expectations/0/expect: "),
            std::string::npos);
  EXPECT_EQ(told(R"([ { "at": "1s" } ])"), "/expectations/0: the key 'expect' is missing");
  EXPECT_EQ(told(R"([ { "at": "soon", "expect": "TRUE" } ])").substr(0, 47),
            "/expectations/0/at: 'soon' is not a duration; a")
      << "and not that a time is missing, too";
  EXPECT_EQ(told(R"([ { "expect": "TRUE" } ])"),
            "/expectations: nothing tells how long to simulate; allowed: 'duration' of the project, or an "
            "expectation "
            "with 'at'");
  EXPECT_EQ(told(R"([ { "at": "2s", "expect": "TRUE" } ], "duration": "1s")"),
            "/duration: '1s' is over before the last expectation, at 2s; allowed: that or longer");
  EXPECT_EQ(told(R"([ { "at": "2s", "expect": "TRUE", "tolerance": 1 } ])"),
            "/expectations/0/tolerance: there is no 'value' to which a tolerance could belong");
  EXPECT_NE(told(R"([ { "at": "2s", "expect": "n", "value": 1, "tolerance": -1 } ])")
                .find("/tolerance: -1 is not allowed"),
            std::string::npos);
  EXPECT_NE(told(R"({})").find("allowed: an array"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
