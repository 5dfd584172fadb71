// A running project read and written by the names of its map, and its diagnostics; a second one that polls
// it.
#include <gtest/gtest.h>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test {
namespace {

Json entry(const std::string& tag, const std::string& table, int address, const Json& more = Json::object()) {
  Json json{{"tag", tag}, {"table", table}, {"address", address}};
  json.update(more);
  return json;
}

/// "doubled" follows "speed".
Json panel_project() {
  Json project = empty_project();
  project["tags"] = Json::parse(R"({
    "speed": {"type": "LREAL", "init": 200.0}, "doubled": {"type": "LREAL"}, "start": {"type": "BOOL"},
    "wait": {"type": "TIME", "init": "250ms"}, "mask": {"type": "WORD", "init": "16#0F0F"},
    "small": {"type": "DINT", "init": -3}, "tenths": {"type": "REAL"}})");
  project["programs"] = {
      {{"name", "P"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", {assignment("doubled", "speed * 2.0")}}}};
  project["modbus"]["map"] = {
      entry("speed", "holding_register", 0, {{"type", "REAL"}}),
      entry("doubled", "input_register", 0),
      entry("start", "holding_register", 9, {{"bit", 3}}),
      entry("wait", "holding_register", 10),
      entry("mask", "holding_register", 12, {{"byte_order", "little"}}),
      entry("small", "holding_register", 13, {{"type", "INT"}}),
      entry("tenths", "holding_register", 14, {{"type", "INT"}, {"scale", 0.1}}),
      Json{{"diagnostic", "ticks"}, {"table", "input_register"}, {"address", 100}},
      Json{{"diagnostic", "overruns"}, {"table", "input_register"}, {"address", 104}, {"type", "UDINT"}},
      Json{{"diagnostic", "alarms"}, {"table", "input_register"}, {"address", 106}, {"type", "UINT"}},
      Json{{"diagnostic", "clients"}, {"table", "input_register"}, {"address", 107}, {"type", "UINT"}}};
  return project;
}

class Panel : public ::testing::Test {
 protected:
  Ended call(const std::string& command, std::vector<std::string> arguments, int port) const {
    std::vector<std::string> all{command, "127.0.0.1:" + std::to_string(port), "--project", file};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return lockstep(all);
  }
  Directory directory;
  std::string file = directory.write("project.json", panel_project().dump());
};

TEST_F(Panel, ReadsAndWritesByName) {
  RunningLockstep run(file);
  Ended ended = call("read", {"speed", "START", "wait", "mask", "small"}, run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "speed = 200.0\nstart = FALSE\nwait = T#0.25s\nmask = 16#F0F\nsmall = -3\n");
  ended =
      call("write", {"speed=-12.5", "start=TRUE", "wait=1.5s", "mask=16#1234", "small=-40", "tenths=12.34"},
           run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  ended = call("read", {"speed", "start", "wait", "mask", "small"}, run.port());
  EXPECT_EQ(ended.out, "speed = -12.5\nstart = TRUE\nwait = T#1.5s\nmask = 16#1234\nsmall = -40\n");
  EXPECT_TRUE(wait_until([&] { return call("read", {"doubled"}, run.port()).out == "doubled = -25.0\n"; }));
  const Json all = Json::parse(call("read", {"--json"}, run.port()).out);
  EXPECT_EQ(all.size(), 11u);
  EXPECT_NEAR(all["tenths"].get<double>(), 12.3, 1e-6);
  EXPECT_GT(all["diagnostic.ticks"].get<int>(), 0);
  EXPECT_EQ(all["diagnostic.alarms"], 0);
  EXPECT_EQ(all["diagnostic.clients"], 1);
}

TEST_F(Panel, TellsNamesAndValuesThatAreWrongAndWritesNothing) {
  RunningLockstep run(file);
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"speeed=1"}, "did you mean 'speed'?"},
      {{"doubled=1"}, "is read-only on Modbus"},
      {{"speed=1", "start=2"}, "start: "},
      {{"speed"}, "is not NAME=VALUE"},
      {{"small=40000"}, "does not fit INT"},
      {{"tenths=5000"}, "does not fit INT"},
      {{"wait=30d"}, "wait: "},
      {{"speed=1e39"}, "does not fit REAL"},
      {{"diagnostic.ticks=1"}, "is read-only"}};
  for (const auto& [arguments, part] : wrong) {
    const Ended ended = call("write", arguments, run.port());
    EXPECT_EQ(ended.status, 1) << part;
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  }
  EXPECT_EQ(call("read", {"speed"}, run.port()).out, "speed = 200.0\n");
  EXPECT_EQ(call("read", {"speeed"}, run.port()).status, 1);
}

TEST_F(Panel, WhereNobodyAnswersItSaysSo) {
  const Ended ended = call("read", {"speed"}, 1);
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("127.0.0.1:1: Connection refused"), std::string::npos) << ended.err;
}

TEST_F(Panel, RefusedClientsAreToldAtTheEndOfTheRun) {
  Json project = panel_project();
  project["modbus"]["server"] = {{"listen", "127.0.0.1:0"}, {"allow", {"10.0.0.0/8"}}};
  const std::string guarded = directory.write("guarded.json", project.dump());
  RunningLockstep run(guarded);
  const Ended ended = call("read", {"speed"}, run.port());
  EXPECT_EQ(ended.status, 2);
  run.send(SIGINT);
  EXPECT_EQ(run.status(), 0);
  EXPECT_NE(run.err().find("warning: Modbus: 1 connections refused: not from a network in 'allow'"),
            std::string::npos)
      << run.err();
}

TEST_F(Panel, OneControllerPollsAnother) {
  RunningLockstep device(file);
  Json project = empty_project();
  project["tags"] = Json::parse(R"({
    "seen": {"type": "LREAL"}, "wanted": {"type": "LREAL", "init": 77.0}, "good": {"type": "BOOL"},
    "age": {"type": "TIME"}})");
  const Json reading = entry("seen", "input_register", 0, {{"type", "LREAL"}});
  const Json writing = entry("wanted", "holding_register", 0, {{"type", "REAL"}});
  project["modbus"]["clients"] = {{{"connect", "127.0.0.1:" + std::to_string(device.port())},
                                   {"devices",
                                    {{{"name", "panel"},
                                      {"cycle", "10ms"},
                                      {"quality", "good"},
                                      {"age", "age"},
                                      {"read", {reading}},
                                      {"write", {writing}}}}}}};
  project["modbus"]["map"] = {entry("seen", "input_register", 0), entry("good", "coil", 0)};
  RunningLockstep poller(directory.write("poller.json", project.dump()));
  const ModbusClient client(poller.port());
  EXPECT_TRUE(wait_until([&] {
    ModbusClient again(poller.port());
    return again.coil(0) && call("read", {"speed"}, device.port()).out == "speed = 77.0\n";
  }));
  device.send(SIGINT);
  EXPECT_EQ(device.status(), 0);
  EXPECT_TRUE(wait_until([&] { return !ModbusClient(poller.port()).coil(0); }));
  poller.send(SIGINT);
  EXPECT_EQ(poller.status(), 0);
  EXPECT_NE(poller.err().find("warning: Modbus client of 127.0.0.1:"), std::string::npos) << poller.err();
}

}  // namespace
}  // namespace lockstep::test
