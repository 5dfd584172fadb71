// Variables that take effect with a restart (RES): a program changes their start values, MC_Reset takes them
// over.
#include <gtest/gtest.h>

#include <string>

#include "projects/loader/simulation.hpp"

namespace lockstep::restart_test {
namespace {

/// A ring and an axis that can follow it. `more` stands in for the text MORE in the calls.
std::string project(const std::string& more) {
  std::string text = R"({
    "lockstep": 1, "name": "restart", "clock": { "servo_cycle": "1ms" },
    "technology_objects": {
      "Drum": { "type": "TO_PositioningAxis", "config": {
        "VirtualAxis": { "Mode": 1 }, "Modulo": { "Enable": true, "Length": 360.0 } } },
      "Belt": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } },
        "leading_values": [ { "to": "Drum" } ] } },
    "tags": { "on": { "type": "BOOL", "init": true }, "length": { "type": "LREAL", "init": 360.0 },
              "change": { "type": "BOOL" }, "again": { "type": "BOOL" }, "move": { "type": "BOOL" },
              "follow": { "type": "BOOL" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ MORE
      { "if": "change", "then": [ { "set_start": "Drum.Modulo.Length", "to": "length" } ] },
      { "fb": "MC_Power", "name": "drum_on", "in": { "Axis": "Drum", "Enable": "on" } },
      { "fb": "MC_Power", "name": "belt_on", "in": { "Axis": "Belt", "Enable": true } },
      { "fb": "MC_MoveRelative", "name": "turn",
        "in": { "Axis": "Drum", "Execute": "move", "Distance": 300.0, "Velocity": 1000.0 } },
      { "fb": "MC_GearIn", "name": "gear",
        "in": { "Master": "Drum", "Slave": "Belt", "Execute": "follow" } },
      { "fb": "MC_Reset", "name": "reset", "in": { "Axis": "Drum", "Execute": "again", "Restart": true } } ] } ]
  })";
  return text.replace(text.find("MORE"), 4, more);
}

class Restart : public testing::Test {
 protected:
  void SetUp() override { run(10); }  // until both axes are on

  void run(int milliseconds) { machine_.run_for(std::chrono::milliseconds(milliseconds)); }
  void write(const char* path, double value) { machine_.write(path, value); }
  double read(const char* path) const { return machine_.read(path); }

  Simulation machine_ = Simulation::from_text(project(""));
};

TEST_F(Restart, TakesOverTheStartValuesThatAProgramHasChanged) {
  write("move", 1.0);
  run(3000);
  EXPECT_EQ(read("Drum.Position"), 300.0);
  write("length", 250.0);
  write("change", 1.0);
  run(2);
  EXPECT_EQ(read("Drum.Modulo.Length"), 360.0) << "it counts with the restart only";
  EXPECT_EQ(read("Drum.StatusWord.X3"), 1.0) << "OnlineStartValuesChanged";
  EXPECT_EQ(read("Drum.Position"), 300.0);

  write("on", 0.0);
  write("change", 0.0);
  run(2);
  write("again", 1.0);
  run(3);
  EXPECT_EQ(read("reset.Done"), 1.0);
  EXPECT_EQ(read("Drum.Modulo.Length"), 250.0);
  EXPECT_EQ(read("Drum.StatusWord.X3"), 0.0);
  EXPECT_EQ(read("Drum.StatusWord.X5"), 0.0) << "HomingDone";
  EXPECT_EQ(read("Drum.ActualPosition"), 50.0) << "the place of 300 on the shorter ring";
}

TEST_F(Restart, KeepsTheStartValueWhenANewOneIsOutOfRange) {
  write("length", -1.0);
  write("change", 1.0);
  write("on", 0.0);
  run(2);
  write("change", 0.0);
  write("again", 1.0);
  run(3);
  EXPECT_EQ(read("reset.Done"), 1.0);
  EXPECT_EQ(read("Drum.Modulo.Length"), 0.001) << "the nearest that is allowed, as with 'set'";
}

TEST_F(Restart, OfALeadingAxisStopsTheAxesThatFollowItWithAlarm601) {
  write("follow", 1.0);
  run(50);
  ASSERT_EQ(read("gear.InGear"), 1.0);
  write("on", 0.0);
  run(50);
  ASSERT_EQ(read("gear.InGear"), 1.0) << "the coupling outlasts that the leading axis is switched off";
  write("again", 1.0);
  run(3);
  EXPECT_EQ(read("reset.Done"), 1.0);
  EXPECT_EQ(read("Belt.ErrorDetail.Number"), 601.0);
  EXPECT_EQ(read("Belt.ErrorWord.X14"), 1.0);
  EXPECT_EQ(read("gear.Error"), 1.0);
  EXPECT_EQ(read("Belt.Velocity"), 0.0);
}

TEST_F(Restart, IsRefusedWhileTheAxisIsOn) {
  write("again", 1.0);
  run(3);
  EXPECT_EQ(read("reset.Error"), 1.0);
  EXPECT_EQ(read("reset.ErrorID"), 0x800E);
}

TEST(StartValues, ThatCannotBeChangedAreToldWhenTheProjectIsLoaded) {
  const auto problem = [](const std::string& path, const std::string& to) {
    const LoadedProject loaded =
        load_project(project(R"({ "set_start": ")" + path + R"(", "to": )" + to + " },"));
    if (loaded.problems.size() != 1) return std::string("not one problem");
    return loaded.problems[0].place + ": " + loaded.problems[0].text;
  };
  EXPECT_EQ(problem("Drum.VirtualAxis.Mode", "0"),
            "/programs/0/calls/0/set_start: 'VirtualAxis.Mode' is read-only at run time (RON); it is set in "
            "'config'");
  EXPECT_EQ(problem("Drum.Position", "0.0"),
            "/programs/0/calls/0/set_start: 'Position' is computed by the runtime and has no start value");
  EXPECT_EQ(problem("on", "true"),
            "/programs/0/calls/0/set_start: only variables of technology objects have start values that can "
            "be changed");
}

}  // namespace
}  // namespace lockstep::restart_test
