// Commands that are short of file descriptors, memory or threads: they say of what, and end with 2.
// A sanitizer takes more addresses than any limit leaves, and descriptors of its own.
#ifndef __SANITIZE_ADDRESS__
#include <gtest/gtest.h>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::shortage_test {
namespace {

/// A run with everything that needs something: kept values, a server, a client, a trace, a cam.
std::string everything(const Directory& directory) {
  Json json = empty_project();
  json["technology_objects"]["A"] = virtual_axis();
  json["technology_objects"]["C"] = {{"type", "TO_Cam"}, {"points", {{0.0, 0.0}, {1.0, 1.0}}}};
  json["tags"] = {{"number", {{"type", "UINT"}, {"retain", true}}}, {"far", {{"type", "UINT"}}}};
  json["modbus"]["server"] = {{"listen", "127.0.0.1:0"}};
  json["modbus"]["map"] = {{{"tag", "number"}, {"table", "holding_register"}, {"address", 0}}};
  return directory.write("project.json", json.dump());
}

std::vector<std::string> run_of(const std::string& project, const Directory& directory) {
  return lockstep_command({"run", project, "--no-lcm", "--duration", "20ms", "--trace",
                           directory.file("trace.csv"), "--signals", "A.Position"});
}

Ended run(std::vector<std::string> before, const std::vector<std::string>& command) {
  before.insert(before.end(), command.begin(), command.end());
  Process process(before);
  Ended ended;
  ended.status = process.status();
  ended.err = process.err();
  return ended;
}

/// Whether it has ended as it should, or says what is short; 127: the program itself could not be loaded.
void expect_told(const Ended& ended, const std::string& what, const std::string& of) {
  EXPECT_TRUE(ended.status == 0 || ended.status == 2 || ended.status == 127)
      << of << ": " << ended.status << ended.err;
  if (ended.status != 2) return;
  EXPECT_NE(ended.err.find(what), std::string::npos) << of << ended.err;
  EXPECT_NE(ended.err.find("what helps: "), std::string::npos) << of << ended.err;
}

TEST(Shortage, OfFileDescriptorsIsToldBeforeAnythingStarts) {
  const Directory directory;
  const std::string project = everything(directory);
  int refused = 0;
  for (int limit = 4; limit < 128; limit += limit < 24 ? 1 : 8) {
    const std::string option = "--nofile=" + std::to_string(limit) + ":" + std::to_string(limit);
    const Ended ended = run({"prlimit", option}, run_of(project, directory));
    expect_told(ended, "file descriptors", option);
    refused += ended.status == 2 ? 1 : 0;
    EXPECT_EQ(ended.err.find("warning: retain"), std::string::npos) << option << ended.err;
  }
  EXPECT_GT(refused, 20);
  // A limit that may be raised is raised.
  EXPECT_EQ(run({"prlimit", "--nofile=16:1024"}, run_of(project, directory)).status, 0);
}

TEST(Shortage, OfFileDescriptorsIsToldByEveryCommand) {
  const Directory directory;
  const std::string project = everything(directory);
  const std::vector<std::vector<std::string>> commands{
      {"check", project},          {"tags", project}, {"describe"}, {"plot", "trace.csv", "-o", "trace.svg"},
      {"read", project, "number"}, {"--help"}};
  for (const std::vector<std::string>& command : commands)
    for (const char* limit : {"--nofile=4:4", "--nofile=5:5"}) {
      const Ended ended = run({"prlimit", limit}, lockstep_command(command));
      EXPECT_EQ(ended.status, 2) << command[0] << ended.err;
      EXPECT_NE(ended.err.find("file descriptors"), std::string::npos) << command[0] << ended.err;
      EXPECT_NE(ended.err.find("ulimit -n"), std::string::npos) << command[0] << ended.err;
    }
}

TEST(Shortage, OfMemoryIsTold) {
  const Directory directory;
  const std::string project = everything(directory);
  int refused = 0;
  for (int megabytes = 12; megabytes < 80; megabytes += megabytes < 28 ? 1 : 8) {
    const std::string option = "--as=" + std::to_string(megabytes * 1'000'000);
    const Ended ended = run({"prlimit", option}, run_of(project, directory));
    expect_told(ended, "memory", option);
    refused += ended.status == 2 ? 1 : 0;
  }
  EXPECT_GT(refused, 5);
}

TEST(Shortage, OfMemoryForAProjectIsToldByCheckToo) {
  const Directory directory;
  Json json = empty_project();
  for (int i = 0; i < 20'000; ++i) json["technology_objects"]["A" + std::to_string(i)] = virtual_axis();
  const std::string project = directory.write("project.json", json.dump());
  const Ended ended = run({"prlimit", "--as=60000000"}, lockstep_command({"check", project}));
  EXPECT_EQ(ended.status, 2) << ended.err;
  EXPECT_NE(ended.err.find("not enough memory; what helps: "), std::string::npos) << ended.err;
}

TEST(Shortage, OfThreadsIsTold) {
  const Directory directory;
  const std::string project = everything(directory);
  int refused = 0;
  Ended last;
  for (int threads = 0; threads < 10; ++threads) {
    last = run({"env", "LOCKSTEP_THREADS=" + std::to_string(threads), "LD_PRELOAD=" LOCKSTEP_NO_THREADS},
               run_of(project, directory));
    expect_told(last, "no further thread can be started", std::to_string(threads));
    refused += last.status == 2 ? 1 : 0;
  }
  EXPECT_GE(refused, 5) << "watch, keeper, server, recorder, cycle";
  EXPECT_EQ(last.status, 0) << last.err;
}

}  // namespace
}  // namespace lockstep::test::shortage_test
#endif
