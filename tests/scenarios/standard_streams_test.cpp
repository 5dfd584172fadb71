// Standard streams that are closed, full or not read: nothing lands where it does not belong, no command ends
// with 0 when what it was asked for is lost.
#include <gtest/gtest.h>

#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::standard_streams_test {
namespace {

const std::string kExample = example("02_rotary_knife");
const std::string kCam = std::string(LOCKSTEP_SOURCE_DIR) + "/projects/cams/";

/// `lockstep` by a line of the shell, in which it is "$0" and the arguments are "$@".
Ended by_shell(const std::string& line, std::vector<std::string> arguments) {
  std::vector<std::string> command{"sh", "-c", line, LOCKSTEP_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Process process(command);
  Ended ended;
  ended.status = process.status();
  ended.out = process.out();
  ended.err = process.err();
  return ended;
}

std::string a_cam() {
  for (const auto& entry : std::filesystem::directory_iterator(kCam))
    if (entry.path().extension() == ".json") return entry.path();
  ADD_FAILURE() << "no cam in " << kCam;
  return "";
}

class DataOnStandardOutput : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(DataOnStandardOutput, ThatIsFullEndsWith2AndIsTold) {
  std::vector<std::string> arguments = GetParam();
  for (std::string& argument : arguments)
    if (argument == "CAM") argument = a_cam();
  ASSERT_EQ(lockstep(arguments).status, 0);
  ASSERT_NE(lockstep(arguments).out, "");
  const Ended full = by_shell("exec \"$0\" \"$@\" >/dev/full", arguments);
  EXPECT_EQ(full.status, 2);
  EXPECT_NE(full.err.find("lockstep: standard output: No space left on device"), std::string::npos)
      << full.err;
  const Ended closed = by_shell("exec \"$0\" \"$@\" >&-", arguments);
  EXPECT_EQ(closed.status, 2);
  EXPECT_NE(closed.err.find("lockstep: standard output: "), std::string::npos) << closed.err;
}

INSTANTIATE_TEST_SUITE_P(Commands, DataOnStandardOutput,
                         testing::Values(std::vector<std::string>{"--help"},
                                         std::vector<std::string>{"--version"},
                                         std::vector<std::string>{"run", "--help"},
                                         std::vector<std::string>{"describe"},
                                         std::vector<std::string>{"describe", "--json"},
                                         std::vector<std::string>{"describe", "MC_GearInPos.InSync"},
                                         std::vector<std::string>{"tags", kExample},
                                         std::vector<std::string>{"tags", kExample, "--json"},
                                         std::vector<std::string>{"tags", kExample, "--csv"},
                                         std::vector<std::string>{"cam", "info", "CAM"},
                                         std::vector<std::string>{"cam", "sample", "CAM"}),
                         [](const auto& words) {
                           std::string name;
                           for (const std::string& word : words.param)
                             for (const char c : word.find('/') == word.npos ? word : "")
                               if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

TEST(StandardOutput, OfReadThatIsFullEndsWith2) {
  Json json = empty_project();
  json["tags"]["number"] = {{"type", "UINT"}};
  json["modbus"]["map"] = {{{"tag", "number"}, {"table", "holding_register"}, {"address", 0}}};
  const Directory directory;
  const std::string project = directory.write("project.json", json.dump());
  const RunningLockstep run(project);
  const std::string server = "127.0.0.1:" + std::to_string(run.port());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"read", server, "--project", project, "number"},
        std::vector<std::string>{"read", server, "--project", project, "number", "--json"}}) {
    const Ended good = lockstep(words);
    ASSERT_EQ(good.status, 0) << good.err;
    const Ended full = by_shell("exec \"$0\" \"$@\" >/dev/full", words);
    EXPECT_EQ(full.status, 2);
    EXPECT_NE(full.err.find("standard output: No space left on device"), std::string::npos) << full.err;
  }
}

TEST(StandardOutput, OfAPictureThatIsFullEndsWith2) {
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  ASSERT_EQ(lockstep({"run", kExample, "--simulate", "--duration", "100ms", "--trace", trace}).status, 0);
  std::filesystem::create_symlink("/dev/full", directory.file("picture.svg"));
  const Ended ended = lockstep({"plot", trace, "-o", directory.file("picture.svg")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("picture.svg: No space left on device"), std::string::npos) << ended.err;
}

/// With none of them open, the first files of the run would be them.
TEST(StandardStreams, ThatAreClosedPutNoMessageIntoAFileOrASocket) {
  const Directory directory;
  Json json = empty_project();
  json["tags"] = {{"a", {{"type", "LREAL"}}}, {"count", {{"type", "DINT"}}}};
  // A count that is told at the end, and a value that is recorded.
  json["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls", {assignment("count", "count / (count - count)"), assignment("a", "a + 1.0")}}});
  const std::string project = directory.write("project.json", json.dump());
  for (const std::string closed : {"<&- >&- 2>&-", "2>&-", ">&- 2>&-", "<&-"}) {
    const std::string trace = directory.file("trace.csv");
    std::filesystem::remove(trace);
    const Ended ended =
        by_shell("exec \"$0\" \"$@\" " + closed, {"run", project, "--no-modbus", "--no-lcm", "--duration",
                                                  "300ms", "--trace", trace, "--signals", "a"});
    EXPECT_EQ(ended.status, 0) << closed;
    const std::string text = content(trace);
    EXPECT_TRUE(text.starts_with("t,a\n")) << closed << "\n" << text.substr(0, 300);
    EXPECT_EQ(text.find("lockstep"), std::string::npos) << closed << "\n" << text.substr(0, 300);
    EXPECT_EQ(text.find("ticks"), std::string::npos) << closed;
  }
}

/// What a process has open as 0, 1 and 2.
TEST(StandardStreams, ThatAreClosedAreNotTheSocketsOfARun) {
  const Directory directory;
  Json json = empty_project();
  json["tags"]["number"] = {{"type", "UINT"}};
  json["modbus"]["map"] = {{{"tag", "number"}, {"table", "holding_register"}, {"address", 0}}};
  const std::string project = directory.write("project.json", json.dump());
  const std::string trace = directory.file("trace.csv");
  Process run({"sh", "-c", "exec \"$0\" \"$@\" <&- >&- 2>&-", LOCKSTEP_PROGRAM, "run", project, "--modbus",
               "127.0.0.1:0", "--no-lcm", "--trace", trace, "--signals", "number"});
  ASSERT_TRUE(wait_until([&] { return content(trace).size() > 100; }));
  for (const char* stream : {"0", "1", "2"})
    EXPECT_EQ(std::filesystem::read_symlink("/proc/" + std::to_string(run.pid()) + "/fd/" + stream),
              "/dev/null")
        << stream;
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
}

}  // namespace
}  // namespace lockstep::test::standard_streams_test
