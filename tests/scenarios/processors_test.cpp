// A project whose ticks use several processors, as a user runs it.
#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::processors_test {
namespace {

constexpr int kAxes = 150;

/// Axes in chains of gears, so that there are levels with more axes than one processor steps alone.
Json chains(int processors) {
  Json project = empty_project();
  project["clock"]["processors"] = processors;
  project["tags"]["go"] = {{"type", "BOOL"}};
  project["stimuli"] = {stimulus("5ms", "go", true)};
  Json calls = Json::array();
  for (int i = 0; i < kAxes; ++i) {
    const std::string axis = "A" + std::to_string(i);
    const std::string leading = "A" + std::to_string(i / 100);
    project["technology_objects"][axis] =
        i == 0 ? virtual_axis() : virtual_axis({leading == axis ? "A0" : leading});
    calls.push_back(call("MC_Power", "power" + std::to_string(i), {{"Axis", axis}, {"Enable", true}}));
    if (i > 0)
      calls.push_back(call("MC_GearIn", "gear" + std::to_string(i),
                           {{"Master", leading == axis ? "A0" : leading},
                            {"Slave", axis},
                            {"RatioNumerator", 1 + i % 3},
                            {"RatioDenominator", 1 + i % 7},
                            {"Execute", "go"}}));
  }
  calls.push_back(call("MC_MoveVelocity", "run", {{"Axis", "A0"}, {"Execute", "go"}, {"Velocity", 100.0}}));
  project["programs"] = {Json{{"name", "Main"}, {"ob", "MC_PreInterpolator"}, {"calls", calls}}};
  return project;
}

std::string trace_of(int processors) {
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  const Ended ended = lockstep({"run", directory.write("project.json", chains(processors).dump()),
                                "--simulate", "--duration", "300ms", "--trace", trace, "--signals",
                                "A0.Position,A1.Position,A99.Position,A149.Position,A149.Velocity"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  return content(trace);
}

TEST(Processors, WriteTheSameTraceHoweverManyThereAre) {
  const std::string one = trace_of(1);
  EXPECT_GT(one.size(), 10'000u);
  EXPECT_NE(one.find("100"), std::string::npos);
  EXPECT_TRUE(trace_of(2) == one);
  EXPECT_TRUE(trace_of(64) == one);
}

TEST(Processors, BeyondThoseOfTheMachineAreWarnedOf) {
  const Directory directory;
  const Ended ended = lockstep({"run", directory.write("project.json", chains(64).dump()), "--no-modbus",
                                "--no-lcm", "--duration", "100ms"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  if (std::thread::hardware_concurrency() < 64) {
    EXPECT_NE(ended.err.find("asks for 64 processors"), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace lockstep::test::processors_test
