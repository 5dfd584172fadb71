#include "projects/simulation.hpp"

#include <gtest/gtest.h>

namespace lockstep {
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

}  // namespace
}  // namespace lockstep
