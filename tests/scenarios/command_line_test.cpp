// The command line: exit statuses, messages, what the options do.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::command_line_test {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(LOCKSTEP_SOURCE_DIR "/projects"))
    if (std::filesystem::exists(entry.path() / "project.json"))
      files.push_back(entry.path() / "project.json");
  std::sort(files.begin(), files.end());
  return files;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A tag that counts the calls of a program and one that a stimulus changes, at a clock of 1 ms.
Json counting_project() {
  Json project = empty_project();
  project["tags"] = {{"calls", {{"type", "UDINT"}}}, {"mark", {{"type", "BOOL"}}}};
  project["programs"].push_back(
      {{"name", "Main"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", {assignment("calls", "calls + 1")}}});
  project["stimuli"] = {stimulus("0.1s", "mark", true)};
  project["trace"] = {{"signals", {"calls", "mark"}}};
  return project;
}

TEST(Check, EveryExampleIsValidAndNothingElseIsSaidAboutIt) {
  ASSERT_GE(examples().size(), 3u);
  for (const std::string& file : examples()) {
    const Ended ended = lockstep({"check", file});
    EXPECT_EQ(ended.status, 0) << file;
    EXPECT_EQ(ended.err, file + ": valid\n");
    EXPECT_EQ(ended.out, "") << file;
  }
}

TEST(Check, TellsEveryProblemOnALineOfItsOwnWithFileAndPointerAndEndsWith1) {
  const Directory directory;
  Json project = counting_project();
  project["clock"]["interpolator_ratio"] = 33;
  project["tags"]["calls"]["tpye"] = "DINT";
  project["programs"][0]["calls"][0]["to"] = "calls + unknown";
  const std::string file = directory.write("faulty.json", project.dump());
  for (const char* command : {"check", "run"}) {
    const Ended ended = lockstep({command, file});
    EXPECT_EQ(ended.status, 1);
    EXPECT_EQ(lines_of(ended.err), 3u) << ended.err;
    for (const char* pointer :
         {":/clock/interpolator_ratio: ", ":/tags/calls/tpye: ", ":/programs/0/calls/0/to: "})
      EXPECT_NE(ended.err.find(file + pointer), std::string::npos) << pointer << "\n" << ended.err;
    EXPECT_EQ(ended.out, "");
  }
}

TEST(Check, TellsLineAndColumnOfASyntaxError) {
  const Directory directory;
  const std::string file = directory.write("broken.json", "{\n  \"lockstep\": 1,,\n}\n");
  const Ended ended = lockstep({"check", file});
  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(ended.err.rfind(file + ":2:", 0), 0u) << ended.err;
}

TEST(Check, EndsWith2WhenTheFileCannotBeRead) {
  const Directory directory;
  for (const char* command : {"check", "run"}) {
    const Ended ended = lockstep({command, directory.file("none.json")});
    EXPECT_EQ(ended.status, 2);
    EXPECT_NE(ended.err.find("none.json"), std::string::npos) << ended.err;
    EXPECT_EQ(lockstep({command, directory.file("")}).status, 2) << "a directory is no project";
  }
}

TEST(CommandLine, AWrongOneEndsWith2) {
  const std::string knife = example("02_rotary_knife");
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"rnu", knife},
      {"check"},
      {"run"},
      {"run", knife, "--simulat"},
      {"run", knife, "--simulate", "--duration", "5 parsecs"},
      {"run", knife, "--simulate", "--duration", "0s"},
      {"run", knife, "--simulate", "--duration", "-1s"},
      {"run", knife, "--simulate", "--duration", "1s", "--trace", "knife.txt"},
      {"run", knife, "--simulate", "--duration", "1s", "--trace", "/nowhere/at/all/knife.csv"},
      {"run", knife, "--simulate", "--duration", "1s", "--signals", "Knife.Positon"},
      {"run", knife, "--no-retain", "--duration", "1s", "--modbus", "127.0.0.1:65536"},
      {"run", knife, "--no-retain", "--duration", "1s", "--modbus", "127.0.0.1:0", "--no-modbus"},
      {"run", knife, "--no-retain", "--duration", "1s", "--no-modbus", "--lcm", "tcpq://127.0.0.1:1"}};
  for (const auto& arguments : wrong) {
    const Ended ended = lockstep(arguments);
    EXPECT_EQ(ended.status, 2) << testing::PrintToString(arguments) << "\n" << ended.err;
    EXPECT_NE(ended.err, "") << testing::PrintToString(arguments);
    EXPECT_EQ(ended.out, "") << testing::PrintToString(arguments);
  }
}

TEST(CommandLine, HelpAndVersionGoToStandardOutputAndEndWith0) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"--version"}, {"check", "--help"}, {"run", "--help"}}) {
    const Ended ended = lockstep(arguments);
    EXPECT_EQ(ended.status, 0);
    EXPECT_NE(ended.out, "");
    EXPECT_EQ(ended.err, "");
  }
}

TEST(Run, ADurationGivesOneRowForEachInterpolatorCycleThatBeginsWithinIt) {
  const Directory directory;
  struct Case {
    const char* servo_cycle;
    int ratio;
    const char* duration;
    std::size_t rows;
    double last;
  };
  for (const Case& c :
       {Case{"1ms", 1, "10ms", 10, 0.009}, Case{"1ms", 2, "10ms", 5, 0.008}, Case{"1ms", 2, "9ms", 5, 0.008},
        Case{"1ms", 2, "8ms", 4, 0.006}, Case{"1ms", 4, "1us", 1, 0.0}, Case{"250us", 32, "1s", 125, 0.992},
        Case{"3ms", 3, "1s", 112, 0.999}}) {
    Json project = empty_project(c.servo_cycle, c.ratio);
    project["tags"] = {{"x", {{"type", "BOOL"}}}};
    const CsvTable table = simulate(project, c.duration, "x");
    ASSERT_EQ(table.rows, c.rows) << c.servo_cycle << " × " << c.ratio << ", " << c.duration;
    EXPECT_EQ(table["t"].front(), 0.0);
    EXPECT_DOUBLE_EQ(table["t"].back(), c.last);
  }
}

TEST(Run, ADurationInVirtualTimeTakesExactlyItsTicks) {
  const Directory directory;
  const std::string file = directory.write("project.json", counting_project().dump());
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "1234500us"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find(", 1235 ticks"), std::string::npos) << ended.err;
}

TEST(Run, TwoSimulatedRunsGiveTheSameBytes) {
  for (const std::string& file : examples()) {
    const Directory directory;
    for (const char* format : {"csv", "lcm"}) {
      const std::string one = directory.file(std::string("one.") + format);
      const std::string two = directory.file(std::string("two.") + format);
      for (const std::string& trace : {one, two})
        ASSERT_EQ(lockstep({"run", file, "--simulate", "--duration", "8s", "--trace", trace}).status, 0);
      EXPECT_GT(content(one).size(), 10'000u);
      EXPECT_EQ(Process({"cmp", one, two}).status(), 0) << file << " as " << format;
    }
  }
}

TEST(Run, TheTwoTraceFormatsHoldTheSameValues) {
  const Directory directory;
  const std::string knife = example("02_rotary_knife");
  for (const char* name : {"knife.csv", "knife.lcm"})
    ASSERT_EQ(
        lockstep({"run", knife, "--simulate", "--duration", "3s", "--trace", directory.file(name)}).status,
        0);
  const CsvTable csv = read_csv(directory.file("knife.csv"));
  LcmTraceReader lcm(directory.file("knife.lcm"), "ROTARY_KNIFE");
  ASSERT_EQ(lcm.signals().size() + 1, csv.names.size());
  for (std::size_t i = 0; i < lcm.signals().size(); ++i) EXPECT_EQ(lcm.signals()[i].name, csv.names[i + 1]);
  for (std::size_t row = 0; row < csv.rows; ++row) {
    ASSERT_TRUE(lcm.next());
    ASSERT_EQ(static_cast<double>(lcm.row().t) / 1e9, csv.columns[0][row]);
    for (std::size_t i = 0; i < lcm.signals().size(); ++i) {
      const Value value = lcm.row().values[i];
      const bool real = lcm.signals()[i].type == Type::LREAL;
      ASSERT_EQ(real ? value.r : static_cast<double>(value.u), csv.columns[i + 1][row]) << csv.names[i + 1];
    }
  }
  EXPECT_FALSE(lcm.next());
  EXPECT_EQ(lcm.remark(), "");
}

TEST(Run, SignalsReplaceThoseOfTheProjectInTheOrderInWhichTheyAreGiven) {
  const CsvTable table = simulate(example("02_rotary_knife"), "100ms",
                                  {"--signals", "gear.InSync,speed,Knife.ModuloCycle,Knife.StatusWord.X5"});
  EXPECT_EQ(table.names, (std::vector<std::string>{"t", "gear.InSync", "speed", "Knife.ModuloCycle",
                                                   "Knife.StatusWord.X5"}));
  EXPECT_EQ(table["speed"].back(), 200.0);
  EXPECT_EQ(table["Knife.StatusWord.X5"].back(), 1.0) << "homed within 100 ms";
}

TEST(Run, StimuliApplyInSimulationAndInRealTimeOnlyOnDemand) {
  const Directory directory;
  const std::string file = directory.write("project.json", counting_project().dump());
  const CsvTable simulated = simulate(file, "200ms");
  EXPECT_EQ(simulated.first("mark", 1.0), 100u);
  for (const bool asked : {false, true}) {
    const std::string trace = directory.file("trace.csv");
    std::vector<std::string> arguments{"run", file, "--duration", "500ms", "--trace", trace};
    if (asked) arguments.emplace_back("--stimuli");
    ASSERT_EQ(lockstep(arguments).status, 0);
    const CsvTable table = read_csv(trace);
    ASSERT_GT(table.rows, 0u);
    ASSERT_GE(table["t"].back(), 0.1);
    if (!asked) {
      EXPECT_EQ(table["mark"].back(), 0.0);
    }
    for (std::size_t i = 0; asked && i < table.rows; ++i)
      ASSERT_EQ(table["mark"][i], table["t"][i] >= 0.1 ? 1.0 : 0.0) << table["t"][i];
  }
}

TEST(Run, ATraceIntoAFullDiskIsAWarningAndTheRunGoesOnAndEndsWith2) {
  const Directory directory;
  const std::string full = directory.file("full.csv");
  std::filesystem::create_symlink("/dev/full", full);
  const Ended ended =
      lockstep({"run", example("02_rotary_knife"), "--simulate", "--duration", "3s", "--trace", full});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("warning: trace incomplete"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("No space left on device"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(", 3000 ticks"), std::string::npos) << ended.err;
}

TEST(Run, OfASystemWhoseTraceIsNotWholeEndsWith2) {
  const Directory directory;
  std::filesystem::create_symlink("/dev/full", directory.file("full.Stamping.csv"));
  const Ended ended = lockstep({"run", LOCKSTEP_SOURCE_DIR "/projects/12_two_presses/system.json",
                                "--simulate", "--duration", "3s", "--trace", directory.file("full.csv")});
  EXPECT_EQ(ended.status, 2) << ended.err;
  EXPECT_NE(ended.err.find("Stamping: trace incomplete"), std::string::npos) << ended.err;
}

TEST(Run, MessagesThatNobodyTakesDoNotEndTheRun) {
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  const std::string run = std::string(LOCKSTEP_PROGRAM) + " run " + example("02_rotary_knife") +
                          " --simulate --duration 1s --trace " + trace;
  EXPECT_EQ(Process({"sh", "-c", run + " 2>/dev/full"}).status(), 0);
  EXPECT_EQ(read_csv(trace).rows, 500u);
  EXPECT_EQ(Process({"bash", "-c", run + " 2>&1 | true; exit ${PIPESTATUS[0]}"}).status(), 0);
  EXPECT_EQ(read_csv(trace).rows, 500u);
}

TEST(Run, APipeGetsNoProgressAndStandardOutputNothing) {
  const Ended ended = lockstep({"run", example("02_rotary_knife"), "--simulate", "--duration", "60s"});
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err.find('\r'), std::string::npos);
  EXPECT_EQ(ended.err.find('\033'), std::string::npos);
}

TEST(Run, EndsWith3WhenTheOverrunPolicySaysStop) {
  const Directory directory;
  Json project = counting_project();
  project["clock"] = {{"servo_cycle", "1us"}, {"overrun", "stop"}};
  project["programs"][0]["cycle"] = "1us";
  for (int i = 0; i < 2000; ++i)  // far more than a microsecond's work
    project["programs"][0]["calls"].push_back(assignment("calls", "calls + 1"));
  const Ended ended =
      lockstep({"run", directory.write("project.json", project.dump()), "--duration", "50s", "--no-modbus"});
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_NE(ended.err.find("three interpolator cycles in a row"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace lockstep::test::command_line_test
