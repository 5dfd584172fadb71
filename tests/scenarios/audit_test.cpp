// The audit log of a real run.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::audit_test {
namespace {

Json machine() {
  Json json = empty_project();
  json["tags"] = Json::parse(R"({"speed": {"type": "LREAL", "init": 200.0}, "shown": {"type": "LREAL"},
    "kind": {"type": "STRING[4]", "init": "ale"}})");
  json["programs"] = {
      {{"name", "P"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", {assignment("shown", "speed")}}}};
  json["modbus"]["map"] = Json::parse(R"([
    {"tag": "speed", "table": "holding_register", "address": 0, "type": "REAL"},
    {"tag": "kind", "table": "holding_register", "address": 10},
    {"tag": "shown", "table": "input_register", "address": 0, "type": "REAL"}])");
  return json;
}

/// The lines of a log; each has to be JSON.
std::vector<Json> lines(const std::string& path) {
  std::vector<Json> found;
  std::istringstream all(content(path));
  for (std::string text; std::getline(all, text);) found.push_back(Json::parse(text));
  return found;
}

std::vector<Json> lines_of(const std::string& path, const std::string& target) {
  std::vector<Json> found;
  for (const Json& line : lines(path))
    if (line.value("target", "").starts_with(target)) found.push_back(line);
  return found;
}

TEST(Audit, TellsWhatALibraryAndLockstepWriteHaveWrittenWhileItRuns) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const std::string log = directory.file("audit.jsonl");
  RunningLockstep run(project, {"--audit", log});
  ModbusClient client(run.port());
  ASSERT_TRUE(wait_until([&] { return client.input_float(0) == 200.0F; })) << "a tick has been seen";
  client.write_float(0, 250.0F);
  ASSERT_TRUE(wait_until([&] { return !lines_of(log, "speed").empty(); })) << "while it runs";
  const Ended ended =
      lockstep({"write", "127.0.0.1:" + std::to_string(run.port()), "--project", project, "kind=pils"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const Ended refused = lockstep({"write", "127.0.0.1:" + std::to_string(run.port()), "--project",
                                  directory.write("other.json",
                                                  [] {
                                                    Json other = machine();
                                                    other["modbus"]["map"][1]["address"] =
                                                        11;  // half of it is beyond the map
                                                    return other.dump();
                                                  }()),
                                  "kind=bock"});
  EXPECT_NE(refused.status, 0);
  run.send(SIGINT);
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_NE(run.err().find("writes and commands from outside are told in " + log), std::string::npos);

  EXPECT_EQ(lines(log).front()["event"], "begin");
  EXPECT_EQ(lines(log).front()["project"], "small");
  const auto speed = lines_of(log, "speed");
  ASSERT_EQ(speed.size(), 1u) << content(log);
  EXPECT_EQ(speed[0]["old"], 200.0);
  EXPECT_EQ(speed[0]["new"], 250.0);
  EXPECT_GE(speed[0]["tick"], 0);
  EXPECT_EQ(speed[0]["via"], "modbus");
  EXPECT_EQ(speed[0]["result"], "accepted");
  EXPECT_TRUE(speed[0]["from"].get<std::string>().starts_with("127.0.0.1:"));
  EXPECT_EQ(lines_of(log, "kind (characters 1 and 2)").size(), 1u) << content(log);
  const auto beyond = lines_of(log, "holding_register 11");
  ASSERT_EQ(beyond.size(), 1u) << content(log);
  EXPECT_EQ(beyond[0]["result"], "refused");
}

TEST(Audit, OfAProjectStandsWhereItSaysAndIsOffInSimulation) {
  const Directory directory;
  Json json = machine();
  const std::string log = directory.file("own.jsonl");
  json["audit"] = {{"file", log}};
  const std::string project = directory.write("project.json", json.dump());
  EXPECT_EQ(lockstep({"run", project, "--simulate", "--duration", "10ms"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_EQ(lockstep({"run", project, "--no-modbus", "--duration", "10ms"}).status, 0);
  EXPECT_EQ(lines(log).size(), 1u);
  const std::string asked = directory.file("asked.jsonl");
  EXPECT_EQ(lockstep({"run", project, "--simulate", "--audit", asked, "--duration", "10ms"}).status, 0);
  EXPECT_EQ(lines(asked).size(), 1u);
  EXPECT_EQ(lines(log).size(), 1u);
}

TEST(Audit, ThatCannotBeWrittenKeepsTheRunFromStarting) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const Ended ended = lockstep({"run", project, "--no-modbus", "--audit", directory.file("no/such/folder")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("audit log: "), std::string::npos) << ended.err;
  const Ended unnamed = lockstep({"run", project, "--no-modbus", "--audit", ""});
  EXPECT_EQ(unnamed.status, 2);
  EXPECT_NE(unnamed.err.find("--audit: an empty text is no value"), std::string::npos) << unnamed.err;
}

}  // namespace
}  // namespace lockstep::test::audit_test
