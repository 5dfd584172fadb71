// Files that commands write: whole, or the old one stays.
#include "cli/command/whole_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::whole_file_test {
namespace {

constexpr char kExpecting[] = R"({ "lockstep": 1, "name": "n", "clock": { "servo_cycle": "1ms" },
  "tags": { "a": { "type": "BOOL" } }, "expectations": [ { "at": "1ms", "expect": "NOT a" } ] })";

std::ptrdiff_t files_in(const Directory& folder) {
  return std::ranges::distance(std::filesystem::directory_iterator(folder.file("")));
}

/// With files that may not grow beyond 1 KiB, as on a disk that is full then.
Ended lockstep_on_a_full_disk(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bash", "-c", R"(ulimit -f 1; exec "$0" "$@")", LOCKSTEP_EXECUTABLE});
  return run(std::move(arguments));
}

TEST(WholeFile, StaysAsItIsWhereTheNewOneIsNotWhole) {
  const Directory folder;
  const std::string old = folder.write("old.csv", "old");
  const std::string cam = LOCKSTEP_SOURCE_DIR "/projects/cams/feeder.cam.json";
  const Ended ended = lockstep_on_a_full_disk({"cam", "sample", cam, "--count", "361", "-o", old});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("old.csv: File too large"), std::string::npos) << ended.err;
  EXPECT_EQ(content(old), "old");
  EXPECT_EQ(files_in(folder), 1) << "what was begun is gone";
  EXPECT_EQ(lockstep({"cam", "sample", cam, "--count", "361", "-o", old}).status, 0);
  EXPECT_GT(content(old).size(), 1024U);
}

TEST(WholeFile, OfResultsOfTestsStaysToo) {
  const Directory folder;
  const std::string old = folder.write("old.xml", "old");
  std::vector<std::string> words = {"test", "--junit", old};
  words.insert(words.end(), 10, folder.write("good.json", kExpecting));
  EXPECT_EQ(lockstep_on_a_full_disk(words).status, 2);
  EXPECT_EQ(content(old), "old");
  EXPECT_EQ(lockstep(words).status, 0);
  EXPECT_TRUE(content(old).starts_with("<?xml"));
}

TEST(WholeFile, ThatCannotBeIsToldBeforeTheTests) {
  const Directory folder;
  const std::string project = folder.write("good.json", kExpecting);
  const Ended nowhere = lockstep({"test", project, "--junit", folder.file("none/out.xml")});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_EQ(nowhere.out, "") << "no project has been tested";
  EXPECT_NE(nowhere.err.find("--junit: " + folder.file("none/out.xml") + ": No such file"),
            std::string::npos);
  std::filesystem::create_directory(folder.file("folder.xml"));
  const Ended directory = lockstep({"test", project, "--junit", folder.file("folder.xml")});
  EXPECT_EQ(directory.status, 2);
  EXPECT_EQ(directory.out, "");
  EXPECT_EQ(lockstep({"test", folder.file("none.json"), "--junit", folder.file("out.xml")}).status, 2);
  EXPECT_TRUE(content(folder.file("out.xml")).starts_with("<?xml"));
}

TEST(WholeFile, KeepsItsRightsAndItsLink) {
  const Directory folder;
  const std::string file = folder.write("file", "old");
  ::chmod(file.c_str(), 0640);
  std::filesystem::create_symlink("file", folder.file("link"));
  write_whole_file(folder.file("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(content(file), "new");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
  std::filesystem::create_symlink("later", folder.file("ahead"));
  write_whole_file(folder.file("ahead"), "new");
  EXPECT_EQ(content(folder.file("later")), "new");
  EXPECT_EQ(files_in(folder), 4);
}

TEST(WholeFile, MayBeADevice) {
  write_whole_file("/dev/null", "text");
  EXPECT_THROW(write_whole_file("/dev/full", "text"), std::runtime_error);
  EXPECT_THROW(write_whole_file("/dev", "text"), std::runtime_error);
  EXPECT_NO_THROW(require_writable("/dev/null"));
}

}  // namespace
}  // namespace lockstep::cli::whole_file_test
