// DynamicLimits that the program of a project writes while an axis moves.
#include <gtest/gtest.h>

#include "projects/loader/simulation.hpp"

namespace lockstep::changed_limits_test {
namespace {

using namespace std::chrono_literals;

constexpr char kProject[] = R"({
  "lockstep": 1, "name": "limits", "clock": { "servo_cycle": "1ms" },
  "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "DynamicLimits": { "Velocity": 2000.0, "MaxAcceleration": 2000.0, "MaxDeceleration": 5000.0 } } } },
  "tags": { "lower": { "type": "BOOL" }, "zero": { "type": "BOOL" } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Slide", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Slide", "Execute": "power.Status", "Velocity": 1500.0 } },
    { "if": "lower", "then": [ { "set": "Slide.DynamicLimits.Velocity", "to": 21.0 },
                               { "set": "Slide.DynamicLimits.MaxAcceleration", "to": 90.0 } ] },
    { "if": "zero", "then": [ { "set": "Slide.DynamicLimits.Velocity", "to": 0.0 } ] } ] } ]
})";

class LimitsOfAProgram : public testing::Test {
 protected:
  LimitsOfAProgram() : machine_(Simulation::from_text(kProject)) {
    machine_.run_for(5s);
    EXPECT_EQ(machine_.read("Slide.Velocity"), 1500.0);
    EXPECT_EQ(machine_.read("run.InVelocity"), 1.0);
  }
  Simulation machine_;
};

TEST_F(LimitsOfAProgram, CountBothWhenTheyChangeInOneCall) {
  machine_.write("lower", 1.0);
  machine_.run_for(5s);
  EXPECT_EQ(machine_.read("Slide.Velocity"), 21.0);
  EXPECT_EQ(machine_.read("Slide.ErrorDetail.Number"), 0.0);
}

TEST_F(LimitsOfAProgram, OfZeroStopTheAxisWithTheirAlarm) {
  machine_.write("zero", 1.0);
  machine_.run_for(1s);
  EXPECT_EQ(machine_.read("Slide.ErrorDetail.Number"), 304.0);
  EXPECT_EQ(machine_.read("Slide.Velocity"), 0.0);
  EXPECT_EQ(machine_.read("run.ErrorID"), 0x8001);
}

}  // namespace
}  // namespace lockstep::changed_limits_test
