// lockstep test, and what makes a run fail: results, their XML, exit statuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "cli/test/junit.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli {
namespace {

std::string project(const std::string& expectations) {
  return R"({ "lockstep": 1, "name": "counter <1>", "clock": { "servo_cycle": "1ms" }, "tags": { "n": { "type": "LINT" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ { "set": "n", "to": "n + 1" } ] } ])" +
         expectations + " }";
}

constexpr char kHolds[] = R"(,
    "expectations": [ { "at": "4ms", "expect": "n", "value": 5 } ])";
constexpr char kFails[] = R"(,
    "expectations": [ { "at": "4ms", "expect": "n", "value": 5, "text": "five" },
      { "at": "9ms", "expect": "n < 10 & n > 0", "text": "less than \"ten\"" } ])";

TEST(TestCommand, PassesWhereAllExpectationsHold) {
  const Directory folder;
  const std::string file = folder.write("a.json", project(kHolds));
  const Ended ended = lockstep({"test", file, file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const std::string line = "pass  0.004000 s  " + file + ":3: n = 5: is 5\n";
  EXPECT_EQ(ended.out, line + line + "2 of 2 expectations hold\n");
  EXPECT_EQ(ended.err, "");
}

TEST(TestCommand, TellsWhatDoesNotHoldWithTheValues) {
  const Directory folder;
  const std::string good = folder.write("good.json", project(kHolds));
  const std::string bad = folder.write("bad.json", project(kFails));
  const Ended ended = lockstep({"test", good, bad, "--junit", folder.file("out.xml")});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.out.find("pass  0.004000 s  " + bad + ":3: five: is 5\n"), std::string::npos) << ended.out;
  EXPECT_NE(
      ended.out.find(
          "FAIL  0.009000 s  " + bad +
          ":4: less than \"ten\": expected: n < 10 & n > 0; is FALSE (n = 10)\n2 of 3 expectations hold\n"),
      std::string::npos)
      << ended.out;
  const std::string counts = R"xml(<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="3" failures="1" errors="0">
)xml";
  const std::string first = "  <testsuite name=\"counter &lt;1&gt;\" file=\"" + good +
                            R"xml(" tests="1" failures="0" errors="0">
    <testcase name="n = 5" classname="counter &lt;1&gt;" time="0.004000"/>
  </testsuite>
)xml";
  const std::string second = "  <testsuite name=\"counter &lt;1&gt;\" file=\"" + bad +
                             R"xml(" tests="2" failures="1" errors="0">
    <testcase name="five" classname="counter &lt;1&gt;" time="0.004000"/>
    <testcase name="less than &quot;ten&quot;" classname="counter &lt;1&gt;" time="0.009000">
      <failure message="expected: n &lt; 10 &amp; n &gt; 0; is FALSE (n = 10)"/>
    </testcase>
  </testsuite>
</testsuites>
)xml";
  EXPECT_EQ(content(folder.file("out.xml")), counts + first + second);
}

TEST(TestCommand, FailsForProjectsThatAreNotValidOrNotThere) {
  const Directory folder;
  const std::string wrong =
      folder.write("wrong.json", project(R"(, "expectations": [ { "at": "1s", "expect": "m" } ])"));
  const Ended invalid = lockstep({"test", wrong, "--junit", folder.file("out.xml")});
  EXPECT_EQ(invalid.status, 1);
  EXPECT_NE(invalid.err.find(wrong + ":/expectations/0/expect: unknown name 'm'"), std::string::npos)
      << invalid.err;
  EXPECT_NE(content(folder.file("out.xml")).find("<error message=\"the project is not valid\"/>"),
            std::string::npos);
  EXPECT_EQ(lockstep({"test", folder.file("none.json")}).status, 2);
  const std::string good = folder.write("good.json", project(kHolds));
  const Ended unwritten = lockstep({"test", good, "--junit", folder.file("none/out.xml")});
  EXPECT_EQ(unwritten.status, 2);
  EXPECT_NE(unwritten.err.find("--junit: "), std::string::npos);
  EXPECT_EQ(lockstep({"test"}).status, 2);
}

TEST(TestCommand, DoesNotWriteResultsOverAProject) {
  const Directory folder;
  const std::string good = folder.write("good.json", project(kHolds));
  const std::string other = folder.write("other.json", project(kHolds));
  const Ended ended = lockstep({"test", "--junit", other, good});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.err, "lockstep: --junit: '" + other + "' has to end in .xml\n");
  EXPECT_EQ(ended.out, "") << "before anything runs";
  EXPECT_EQ(content(other), project(kHolds));
}

TEST(TestCommand, SaysThatAProjectHasNoExpectations) {
  const Directory folder;
  const std::string file = folder.write("a.json", project(""));
  const Ended ended = lockstep({"test", file});
  EXPECT_EQ(ended.status, 2) << "nothing was checked";
  EXPECT_EQ(ended.out,
            file + ": no expectations\n0 of 0 expectations hold; 1 of 1 projects have no expectations\n");
  EXPECT_EQ(ended.err.find("lockstep: nothing was checked: no project has \"expectations\""), 0u)
      << ended.err;
  const std::string other = folder.write("b.json", project(kHolds));
  const Ended beside = lockstep({"test", file, other});
  EXPECT_EQ(beside.status, 0) << beside.err;
  EXPECT_TRUE(beside.out.ends_with("\n1 of 1 expectations hold; 1 of 2 projects have no expectations\n"))
      << beside.out;
  const Ended unread = lockstep({"test", folder.file("none.json")});
  EXPECT_EQ(unread.err.find("nothing was checked"), std::string::npos)
      << "it has its own reason: " << unread.err;
}

TEST(TestCommand, FindsTheExamplesAsTheyExpectThemselves) {
  std::vector<std::string> command{"test"};
  for (const auto& entry : std::filesystem::directory_iterator(LOCKSTEP_SOURCE_DIR "/projects"))
    if (std::filesystem::exists(entry.path() / "project.json"))
      command.push_back((entry.path() / "project.json").string());
  ASSERT_GE(command.size(), 13u);
  const Ended ended = lockstep(command);
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  std::set<std::string> with_expectations;
  for (const std::string& file : command)
    if (ended.out.find("pass  ") != std::string::npos && ended.out.find(file + ":") != std::string::npos &&
        ended.out.find(file + ": no expectations") == std::string::npos)
      with_expectations.insert(file);
  EXPECT_GE(with_expectations.size(), 4u) << ended.out;
}

TEST(Junit, LeavesNothingThatWouldBreakTheDocument) {
  const std::string xml =
      junit_xml({{.name = "a\"b'c&<d>\x01\n", .file = "f", .cases = {{.name = "\xff]]>", .message = ""}}}});
  EXPECT_NE(xml.find("name=\"a&quot;b&apos;c&amp;&lt;d&gt;??\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("name=\"?]]&gt;\""), std::string::npos) << xml;
  const std::string none =
      junit_xml({{.name = "\xEF\xBF\xBE\xEF\xBF\xBF\xEF\xBF\xBD", .file = "f", .cases = {}}});
  EXPECT_NE(none.find("name=\"??\xEF\xBF\xBD\""), std::string::npos)
      << "Unicode has U+FFFE and U+FFFF, XML has not: " << none;
}

/// An axis whose halt is rejected for its deceleration of 0, or which runs into its limit switch.
std::string machine(const std::string& call, const std::string& limit) {
  return R"({ "lockstep": 1, "name": "m", "clock": { "servo_cycle": "1ms" }, "technology_objects": {
    "Axis": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
      "PositionLimits_SW": { "Active": )" +
         limit + R"(, "MinPosition": -1.0, "MaxPosition": 1.0 } } } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "2ms", "calls": [
      { "fb": "MC_Power", "name": "on", "in": { "Axis": "Axis", "Enable": true } },
      { "fb": "MC_Home", "name": "home", "in": { "Axis": "Axis", "Execute": "on.Status", "Mode": 0, "Position": 0.0 } },
      )" +
         call + " ] } ] }";
}
constexpr char kRejected[] =
    R"({ "fb": "MC_Halt", "name": "halt", "in": { "Axis": "Axis", "Execute": "home.Done", "Deceleration": 0.0 } })";
constexpr char kRunsOut[] =
    R"({ "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Axis", "Execute": "home.Done", "Velocity": 10.0 } })";

TEST(RunCommand, FailsOnAlarmsAndFailedJobsIfItIsToDoSo) {
  const Directory folder;
  const std::string job = folder.write("job.json", machine(kRejected, "false"));
  const std::string alarm = folder.write("alarm.json", machine(kRunsOut, "true"));
  const auto status = [](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> command{"run", file, "--simulate", "--duration", "1s"};
    command.insert(command.end(), more.begin(), more.end());
    return lockstep(command);
  };
  EXPECT_EQ(status(job, {}).status, 0);
  EXPECT_EQ(status(job, {"--fail-on", "alarm"}).status, 0);
  const Ended failed = status(job, {"--fail-on", "job"});
  EXPECT_EQ(failed.status, 4);
  EXPECT_NE(failed.err.find("failed: 1 failed jobs (--fail-on)"), std::string::npos) << failed.err;
  EXPECT_EQ(status(job, {"--fail-on", "alarm,job", "--trace", folder.file("t.lcm")}).status, 4);
  EXPECT_EQ(status(alarm, {}).status, 0);
  const Ended ran_out = status(alarm, {"--fail-on", "alarm"});
  EXPECT_EQ(ran_out.status, 4) << ran_out.err;
  EXPECT_NE(ran_out.err.find(" alarms (--fail-on)"), std::string::npos) << ran_out.err;
  EXPECT_EQ(status(alarm, {"--fail-on", "alarms"}).status, 2);
  EXPECT_EQ(lockstep({"run", alarm, "--duration", "500ms", "--fail-on", "alarm", "--no-retain"}).status, 4)
      << "in real time too";
}

TEST(RunCommand, FailsOnAWarningOnlyIfItIsToDoSo) {
  const Directory folder;
  constexpr char kTooFast[] =
      R"({ "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Axis", "Execute": "home.Done", "Velocity": 1.0E6 } })";
  const std::string file = folder.write("fast.json", machine(kTooFast, "false"));
  const auto run = [&](const char* what) {
    return lockstep({"run", file, "--simulate", "--duration", "1s", "--fail-on", what});
  };
  const Ended spared = run("alarm,job");
  EXPECT_EQ(spared.status, 0) << spared.err;
  EXPECT_NE(spared.err.find("Axis: alarm 501: "), std::string::npos) << "a warning: " << spared.err;
  const Ended failed = run("warning");
  EXPECT_EQ(failed.status, 4) << failed.err;
  EXPECT_NE(failed.err.find("failed: 1 warnings (--fail-on)"), std::string::npos) << failed.err;
  const std::string alarm = folder.write("alarm.json", machine(kRunsOut, "true"));
  EXPECT_EQ(lockstep({"run", alarm, "--simulate", "--duration", "1s", "--fail-on", "warning"}).status, 4)
      << "any alarm, too";
}

TEST(TestCommand, TellsWhatHappenedInTheRun) {
  const Directory folder;
  const auto expecting = [](std::string text) {
    return text.insert(text.rfind('}'), R"(, "expectations": [ { "at": "1s", "expect": "on.Status" } ])");
  };
  const Ended alarm = lockstep({"test", folder.write("alarm.json", expecting(machine(kRunsOut, "true")))});
  EXPECT_NE(alarm.err.find("Axis: alarm 5"), std::string::npos) << alarm.err;
  EXPECT_NE(alarm.err.find("remedy: "), std::string::npos) << alarm.err;
  const Ended job = lockstep({"test", folder.write("job.json", expecting(machine(kRejected, "false")))});
  EXPECT_NE(job.err.find("failed, ErrorID 16#"), std::string::npos) << job.err;
  const Ended counted = lockstep(
      {"test", folder.write("zero.json", expecting(machine(R"({ "set": "n", "to": "1 / n" })", R"(false)"))
                                             .insert(1, R"( "tags": { "n": { "type": "INT" } },)"))});
  EXPECT_NE(counted.err.find("integer divisions by zero gave 0"), std::string::npos) << counted.err;
}

TEST(TestCommand, CountsNoExpectationOfWhatItCannotTest) {
  const Directory folder;
  const Ended ended = lockstep({"test", folder.write("a.json", project(kHolds)), folder.file("none.json")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(ended.out.ends_with("\n1 of 1 expectations hold; 1 of 2 projects could not be tested\n"))
      << ended.out;
}

TEST(CheckCommand, WritesAProjectAsOneFile) {
  const std::string file = LOCKSTEP_SOURCE_DIR "/projects/14_twelve_stations/project.json";
  const Ended expanded = lockstep({"check", file, "--expanded"});
  ASSERT_EQ(expanded.status, 0) << expanded.err;
  EXPECT_EQ(expanded.out.find("${"), std::string::npos);
  const Directory folder;
  const std::string whole = folder.write("whole.json", expanded.out);
  const auto trace = [&](const std::string& project) {
    const std::string path = folder.file("trace.csv");
    EXPECT_EQ(lockstep({"run", project, "--simulate", "--duration", "2s", "--trace", path}).status, 0);
    return content(path);
  };
  EXPECT_EQ(trace(whole), trace(file));
  const std::string wrong = folder.write("wrong.json", "{}");
  const Ended invalid = lockstep({"check", wrong, "--expanded"});
  EXPECT_EQ(invalid.status, 1);
  EXPECT_EQ(invalid.out, "");
  EXPECT_NE(invalid.err.find(wrong + ":: the key 'lockstep' is missing (line 1, column 1)\n"),
            std::string::npos);
}

}  // namespace
}  // namespace lockstep::cli
