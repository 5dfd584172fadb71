// An external encoder whose position comes over Modbus: where it begins, and a link that is lost and returns
// while an axis is geared to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::encoder_over_modbus_test {
namespace {

/// A run that is read and written by the names of its map.
class Named {
 public:
  Named(const Json& project, const std::string& name, const std::vector<std::string>& options = {})
      : file_(directory_.write(name + ".json", project.dump())), run(file_, options) {}

  std::vector<std::string> command(const std::string& command, const std::string& value) const {
    return {command, "127.0.0.1:" + std::to_string(run.port()), "--project", file_, "--timeout", "60", value};
  }
  void write(const std::string& assignment) const {
    const Ended ended = lockstep(command("write", assignment));
    EXPECT_EQ(ended.status, 0) << ended.err;
  }
  Json all() const {
    const Ended ended = lockstep(command("read", "--json"));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return Json::parse(ended.out);
  }
  Json value(const std::string& name) const { return all().at(name); }
  /// Waits until a name has a value.
  bool comes(const std::string& name, const Json& value) const {
    return wait_until([&] { return this->value(name) == value; });
  }

 private:
  Directory directory_;
  std::string file_;

 public:
  RunningLockstep run;
};

/// The foreign device: its position is what somebody writes.
Json device_project() {
  Json project = empty_project();
  project["tags"]["position"] = {{"type", "LREAL"}, {"init", 1000.0}};
  project["modbus"]["map"] = {Json{{"tag", "position"}, {"table", "holding_register"}, {"address", 0}}};
  return project;
}

/// A drum that is geared to an encoder, whose value is polled from the device.
Json machine_project(int device) {
  Json project = empty_project();
  project["technology_objects"]["Encoder"] = Json::parse(
      R"({"type": "TO_ExternalEncoder",
          "encoder": {"model": "simulated", "signal": "seen", "valid": "heard"}})");
  project["technology_objects"]["Drum"] = virtual_axis();
  project["technology_objects"]["Drum"]["leading_values"] = {Json{{"to", "Encoder"}, {"coupling", "actual"}}};
  project["tags"] = Json::parse(R"({"seen": {"type": "LREAL"}, "heard": {"type": "BOOL"},
                                    "start": {"type": "BOOL"}, "reset": {"type": "BOOL"}})");
  project["programs"] = {
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power", {{"Axis", "Drum"}, {"Enable", true}}),
         call("MC_GearIn", "gear", {{"Master", "Encoder"}, {"Slave", "Drum"}, {"Execute", "start"}}),
         call("MC_Reset", "reset_encoder", {{"Axis", "Encoder"}, {"Execute", "reset"}}),
         call("MC_Reset", "reset_drum", {{"Axis", "Drum"}, {"Execute", "reset"}})}}}};
  project["modbus"] = Json::parse(R"({
    "clients": [{"timeout": "3s", "devices": [{"name": "device", "cycle": "10ms", "quality": "heard",
                 "read": [{"tag": "seen", "table": "holding_register", "address": 0}]}]}],
    "map": [{"tag": "seen", "table": "input_register", "address": 0},
            {"tag": "Encoder.ActualPosition", "table": "input_register", "address": 4},
            {"tag": "Drum.Position", "table": "input_register", "address": 8},
            {"tag": "Encoder.ErrorDetail.Number", "table": "input_register", "address": 12},
            {"tag": "Drum.ErrorDetail.Number", "table": "input_register", "address": 14},
            {"tag": "heard", "table": "discrete_input", "address": 0},
            {"tag": "gear.InGear", "table": "discrete_input", "address": 1},
            {"tag": "start", "table": "coil", "address": 0},
            {"tag": "reset", "table": "coil", "address": 1}]})");
  project["modbus"]["clients"][0]["connect"] = "127.0.0.1:" + std::to_string(device);
  return project;
}

/// The largest step of a column from row to row, from a row on.
double largest_step(const std::vector<double>& column, std::size_t from) {
  double largest = 0.0;
  for (std::size_t i = from + 1; i < column.size(); ++i)
    largest = std::max(largest, std::abs(column[i] - column[i - 1]));
  return largest;
}

/// All motion that the encoder may show is the steps of 1 u that the device makes while it is heard.
void expect_no_jump(const CsvTable& table) {
  const std::size_t begin = table.first("heard", 1.0);
  ASSERT_LT(begin, table.rows);
  EXPECT_EQ(table["Encoder.ActualPosition"][begin], 1000.0) << "it begins at the first value";
  EXPECT_LE(largest_step(table["Encoder.ActualPosition"], begin), 1.0 + 1e-9);
  EXPECT_LE(largest_step(table["Drum.Position"], 0), 2.0 + 1e-9) << "the step, and what it extrapolates to";
  for (const double velocity : table["Encoder.ActualVelocity"]) ASSERT_LE(std::abs(velocity), 1000.0 + 1e-6);
}

TEST(EncoderOverModbus, BeginsAtItsFirstValueAndALostLinkIsAFaultThatNothingFollows) {
  Named device(device_project(), "device");
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  Named machine(machine_project(device.run.port()), "machine",
                {"--no-retain", "--trace", trace, "--signals",
                 "heard,Encoder.ActualPosition,Encoder.ActualVelocity,Drum.Position"});
  ASSERT_TRUE(machine.comes("heard", true)) << machine.run.err();
  EXPECT_EQ(machine.value("Encoder.ActualPosition"), 1000.0);
  EXPECT_EQ(machine.value("Encoder.ErrorDetail.Number"), 0) << "before the first value there was no fault";
  machine.write("start=TRUE");
  ASSERT_TRUE(machine.comes("gear.InGear", true));
  const auto drum = machine.value("Drum.Position").get<double>();
  device.write("position=1001");
  EXPECT_TRUE(machine.comes("Drum.Position", drum + 1.0));

  device.run.send(SIGSTOP);
  ASSERT_TRUE(machine.comes("Encoder.ErrorDetail.Number", 411));
  Json now = machine.all();
  EXPECT_EQ(now["heard"], false);
  EXPECT_EQ(now["Drum.ErrorDetail.Number"], 601);
  EXPECT_EQ(now["gear.InGear"], false);
  Process away(lockstep_command(device.command("write", "position=1041")));  // it goes on unseen
  device.run.send(SIGCONT);
  EXPECT_EQ(away.status(), 0) << away.err();
  ASSERT_TRUE(machine.comes("seen", 1041.0));
  ASSERT_TRUE(machine.comes("heard", true));
  now = machine.all();
  EXPECT_EQ(now["Encoder.ErrorDetail.Number"], 411) << "until it is acknowledged";
  EXPECT_EQ(now["Encoder.ActualPosition"], 1001.0);
  EXPECT_EQ(now["Drum.Position"], drum + 1.0);

  machine.write("reset=TRUE");
  ASSERT_TRUE(machine.comes("Encoder.ErrorDetail.Number", 0));
  ASSERT_TRUE(machine.comes("Drum.ErrorDetail.Number", 0));
  machine.write("start=FALSE");
  machine.write("start=TRUE");
  ASSERT_TRUE(machine.comes("gear.InGear", true));
  device.write("position=1042");
  EXPECT_TRUE(machine.comes("Encoder.ActualPosition", 1002.0));
  EXPECT_TRUE(machine.comes("Drum.Position", drum + 2.0));
  machine.run.send(SIGINT);
  EXPECT_EQ(machine.run.status(), 0) << machine.run.err();
  expect_no_jump(read_csv(trace));
}

}  // namespace
}  // namespace lockstep::test::encoder_over_modbus_test
