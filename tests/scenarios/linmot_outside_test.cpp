// The process image of a LinMot controller as masters outside have it: words over Modbus, and words and bytes
// in traces over LCM.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::linmot_outside_test {
namespace {

/// One motor that is where its set-point is.
Json bus_project() {
  Json project = empty_project();
  project["technology_objects"]["C"] = Json::parse(R"({
    "type": "LinMot_Controller",
    "config": { "System": { "Command Interface": "PROFIBUS" }, "Drives": { "Drive A": { "Type": "LinMot P0x-37" } } },
    "profibus": { "modules": [ "Control/Status", "Get Position", "Set Position" ] } })");
  return project;
}

class OverModbus {
 public:
  explicit OverModbus(const Json& project)
      : file_(directory_.write("project.json", project.dump())), run(file_, {"--no-retain"}) {}
  void write(const std::string& assignment) const {
    const Ended ended = lockstep(command("write", assignment));
    EXPECT_EQ(ended.status, 0) << ended.err;
  }
  int value(const std::string& name) const {
    const Ended ended = lockstep(command("read", "--json"));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.status == 0 ? Json::parse(ended.out).at(name).get<int>() : -1;
  }
  bool comes(const std::string& name, int value) const {
    return wait_until([&] { return this->value(name) == value; });
  }

 private:
  std::vector<std::string> command(const std::string& command, const std::string& value) const {
    return {command, "127.0.0.1:" + std::to_string(run.port()), "--project", file_, "--timeout", "60", value};
  }
  Directory directory_;
  std::string file_;

 public:
  RunningLockstep run;
};

TEST(LinMotOutside, IsRunByAMasterOverModbus) {
  for (const char* const order : {"big", "little"}) {
    Json project = bus_project();
    Json& map = project["modbus"]["map"] = Json::array();
    int address = 0;
    for (const char* const word : {"C.ProfibusOut[1]", "C.ProfibusOut[2]"})
      map.push_back({{"tag", word},
                     {"table", "holding_register"},
                     {"address", address++},
                     {"access", "write"},
                     {"byte_order", order}});
    for (const char* const word : {"C.ProfibusIn[1]", "C.ProfibusIn[2]", "C.ProfibusOutByte[3]"})
      map.push_back(
          {{"tag", word}, {"table", "input_register"}, {"address", address++}, {"byte_order", order}});
    OverModbus master(project);
    ASSERT_TRUE(master.comes("C.ProfibusIn[1]", 0x0090)) << master.run.err();
    EXPECT_EQ(master.value("C.ProfibusIn[2]"), 0x7FFF);
    master.write("C.ProfibusOut[1]=16#0008");
    EXPECT_TRUE(master.comes("C.ProfibusIn[1]", 0x0009));
    master.write("C.ProfibusOut[1]=16#0002");
    EXPECT_TRUE(master.comes("C.ProfibusIn[1]", 0x1003));
    master.write("C.ProfibusOut[2]=16#0A00");
    EXPECT_TRUE(master.comes("C.ProfibusIn[2]", 2560)) << order;
    EXPECT_TRUE(master.comes("C.ProfibusIn[1]", 0x1003));
    EXPECT_EQ(master.value("C.ProfibusOutByte[3]"), 0x00);  // low byte first
  }
}

TEST(LinMotOutside, IsSeenInTracesOverLcm) {
  Json project = bus_project();
  project["tags"]["tick"] = {{"type", "DINT"}};
  project["programs"] = Json::parse(R"([ { "name": "Master", "ob": "MC_PreServo", "calls": [
    { "set": "tick", "to": "tick + 1" },
    { "if": "tick = 10", "then": [ { "set": "C.ProfibusOut[1]", "to": "16#0008" } ] },
    { "if": "tick = 20", "then": [ { "set": "C.ProfibusOut[1]", "to": "16#0002" } ] },
    { "if": "tick = 30", "then": [ { "set": "C.ProfibusOut[2]", "to": "16#0A00" } ] } ] } ])");
  project["trace"] = Json::parse(R"({ "lcm": { "url": "udpm://239.255.76.67:7667?ttl=0", "channel": "BUS" },
    "signals": [ "C.ProfibusOut[1]", "C.ProfibusIn[1]", "C.ProfibusIn[2]", "C.ProfibusOutByte[4]", "C.ProfibusInByte[1]" ] })");
  const Directory directory;
  const std::string trace = directory.file("trace.lcm");
  const Ended ended = lockstep({"run", directory.write("project.json", project.dump()), "--simulate",
                                "--duration", "500ms", "--trace", trace});
  ASSERT_EQ(ended.status, 0) << ended.err;
  LcmTraceReader reader(trace, "BUS");
  std::size_t rows = 0;
  std::map<std::string, std::uint64_t> last;
  std::set<std::uint64_t> status;
  while (reader.next()) {
    ++rows;
    for (std::size_t i = 0; i < reader.signals().size(); ++i)
      last[reader.signals()[i].name] = reader.row().values[i].u;
    status.insert(last["C.ProfibusIn[1]"]);
  }
  EXPECT_EQ(rows, 500u);
  EXPECT_EQ(status, (std::set<std::uint64_t>{0x0090, 0x0009, 0x1003, 0x0003}));
  EXPECT_EQ(last["C.ProfibusIn[2]"], 2560u);
  EXPECT_EQ(last["C.ProfibusOutByte[4]"], 0x0Au);
  EXPECT_EQ(last["C.ProfibusInByte[1]"], 0x03u);
}

}  // namespace
}  // namespace lockstep::test::linmot_outside_test
