#include "projects/loader/simulation.hpp"

#include <gtest/gtest.h>

namespace lockstep::simulation_test {
namespace {

constexpr std::string_view kProject = R"({
  "lockstep": 1, "name": "embedded", "clock": { "servo_cycle": "1ms" },
  "technology_objects": { "Axis": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } } },
  "tags": { "go": { "type": "BOOL" }, "speed": { "type": "LREAL", "init": 10.0 }, "count": { "type": "INT" } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Axis", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run",
      "in": { "Axis": "Axis", "Execute": "power.Status AND go", "Velocity": "speed" } } ] } ]
})";

TEST(Simulation, RunsAProjectAndReadsAndWritesItsValues) {
  Simulation machine = Simulation::from_text(kProject);
  machine.write("speed", 25.0);
  machine.write("go", 1.0);
  machine.run_for(std::chrono::seconds(2));
  EXPECT_EQ(machine.now(), std::chrono::seconds(2));
  EXPECT_EQ(machine.read("Axis.Velocity"), 25.0);
  EXPECT_EQ(machine.read("run.InVelocity"), 1.0);
  EXPECT_EQ(machine.read("Axis.StatusWord.X0"), 1.0);
  EXPECT_GT(machine.read("Axis.Position"), 40.0);
}

TEST(Simulation, TellsWhatIsWrong) {
  EXPECT_THROW(Simulation::from_text("{}"), InvalidProject);
  EXPECT_THROW(Simulation("no/such/file.json"), UnreadableFile);
  Simulation machine = Simulation::from_text(kProject);
  EXPECT_THROW(machine.read("Axis.Positon"), std::out_of_range);
  EXPECT_THROW(machine.write("Axis.Position", 1.0), std::out_of_range);
  EXPECT_THROW(machine.write("count", 40000.0), std::domain_error);
  EXPECT_THROW(machine.write("count", 1.5), std::domain_error);
  EXPECT_THROW(machine.write("Axis.Override.Velocity", 300.0), std::domain_error);
  machine.write("Axis.Override.Velocity", 50.0);
  EXPECT_EQ(machine.read("Axis.Override.Velocity"), 50.0);
}

constexpr std::string_view kGlue = R"({
  "lockstep": 1, "name": "glue", "clock": { "servo_cycle": "1ms" },
  "technology_objects": {
    "Belt": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } },
    "Glue": { "type": "TO_OutputCam", "assigned_to": "Belt",
      "config": { "Parameter": { "OutputCamType": 1 }, "Interface": { "Address": "valve" } },
      "switching_times": { "on": "opened", "off": "closed" } },
    "Stamps": { "type": "TO_CamTrack", "assigned_to": "Belt", "config": {
      "Interface": { "Address": "stamp" },
      "Parameter": { "CamTrackLength": 50.0, "Cam[3]": { "Existent": true, "OnPosition": 10.0, "OffPosition": 20.0 } } } },
    "Fan": { "type": "TO_SpeedAxis", "drive": { "model": "simulated" } } },
  "tags": { "valve": { "type": "BOOL" }, "stamp": { "type": "BOOL" },
    "opened": { "type": "LREAL", "init": -1.0 }, "closed": { "type": "LREAL", "init": -1.0 } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Belt", "Enable": true } },
    { "fb": "MC_Power", "name": "power_fan", "in": { "Axis": "Fan", "Enable": true } },
    { "fb": "MC_OutputCam", "name": "glue_on",
      "in": { "OutputCam": "Glue", "Enable": true, "OnPosition": 100.05, "Duration": 25.25, "Direction": 3 } },
    { "fb": "MC_CamTrack", "name": "stamps_on", "in": { "CamTrack": "Stamps", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run_fan",
      "in": { "Axis": "Fan", "Execute": "power_fan.Status", "Velocity": 1500.0 } },
    { "fb": "MC_MoveVelocity", "name": "run",
      "in": { "Axis": "Belt", "Execute": "power.Status", "Velocity": 100.0 } } ] } ]
})";

TEST(Simulation, SwitchesTagsByOutputCamsAndTurnsSpeedAxes) {
  Simulation machine = Simulation::from_text(kGlue);
  while (machine.read("valve") == 0.0 && machine.now() < std::chrono::seconds(3)) machine.step();
  EXPECT_EQ(machine.read("valve"), 1.0);
  const double opened = machine.read("opened");
  // Seen one cycle later than the setpoint, which is 0.05 beyond the place per half a millisecond.
  const double now = std::chrono::duration<double>(machine.now()).count() - 0.001;
  EXPECT_NEAR(opened, now + 0.001 - (machine.read("Belt.Position") - 100.05) / 100.0, 1e-9);
  EXPECT_EQ(machine.read("glue_on.CamOutput"), 1.0);
  while (machine.read("valve") == 1.0 && machine.now() < std::chrono::seconds(3)) machine.step();
  EXPECT_NEAR(machine.read("closed") - opened, 0.02525, 1e-12);
  int stamps = 0;
  for (bool last = true; machine.now() < std::chrono::seconds(5); machine.step()) {
    const bool stamp = machine.read("stamp") == 1.0;
    EXPECT_EQ(stamp, machine.read("Stamps.SingleCamState.X2") == 1.0);
    if (stamp && !last) ++stamps;
    last = stamp;
  }
  EXPECT_GE(stamps, 6);
  EXPECT_EQ(machine.read("Fan.Velocity"), 1500.0);
  EXPECT_NEAR(machine.read("Fan.ActualSpeed"), 1500.0, 1e-6);
  EXPECT_THROW(machine.read("Fan.Position"), std::out_of_range);
}

}  // namespace
}  // namespace lockstep::simulation_test
