// DSC: the position loop is closed in the drive, in cycles of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::dynamic_servo_control_test {
namespace {

using test::Rig;

/// An axis with a servo cycle of 4 ms, and setpoints that are late by as much.
struct Slow : Rig {
  explicit Slow(bool dsc, double kv, const std::function<void(Axis&)>& change = {})
      : Rig(4'000'000, 1),
        a(axis("Axis",
               [&](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.PositionControl.EnableDSC = dsc;
                 data.PositionControl.Kv = kv;
                 data.FollowingError.EnableMonitoring = false;
               })),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        move(block<MC_MoveAbsolute>()),
        run_v(block<MC_MoveVelocity>()) {
    a.drive_settings.time_constant = 0.001;
    a.drive_settings.dead_time = 0.004;
    if (change) change(a);
    power.Axis = home.Axis = move.Axis = run_v.Axis = &a;
    continuity[0].velocity = false;
    power.Enable = true;
    run(10);
    home.Execute = true;
    run(5);
  }

  /// Maximum deviation from where it is to stand, in the last of four seconds after a positioning.
  double restlessness() {
    move.Position = 20.0;
    move.Velocity = 100.0;
    move.Execute = true;
    run(750);
    double maximum = 0.0;
    for (int i = 0; i < 250; ++i) {
      tick();
      maximum = std::max(maximum, std::abs(a.data.ActualPosition - 20.0));
    }
    return maximum;
  }

  Axis& a;
  MC_Power& power;
  MC_Home& home;
  MC_MoveAbsolute& move;
  MC_MoveVelocity& run_v;
};

TEST(DynamicServoControl, BearsAGainWithWhichTheLoopOverTheBusOscillates) {
  constexpr double kHigh = 300.0;
  Slow over_the_bus(false, kHigh);
  EXPECT_GT(over_the_bus.restlessness(), 0.1);
  Slow in_the_drive(true, kHigh);
  EXPECT_LT(in_the_drive.restlessness(), 1e-6);
  EXPECT_TRUE(in_the_drive.move.Done);
  EXPECT_EQ(in_the_drive.a.pending_alarm(), 0);
}

TEST(DynamicServoControl, DependsOnTheCycleOfThePositionLoopInTheDrive) {
  constexpr double kVeryHigh = 700.0;
  Slow fine(true, kVeryHigh, [](Axis& axis) { axis.drive_settings.time_constant = 0.0; });
  EXPECT_LT(fine.restlessness(), 1e-6);
  Slow coarse(true, kVeryHigh, [](Axis& axis) {
    axis.drive_settings.time_constant = 0.0;
    axis.drive_settings.position_cycle = 0.004;
  });
  EXPECT_GT(coarse.restlessness(), 0.1);
}

class DynamicServoControlDelays : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(DeadTimes, DynamicServoControlDelays, ::testing::Values(0.0, 0.001, 0.004, 0.0095));

TEST_P(DynamicServoControlDelays, LeavesNoControlDifferenceAtConstantVelocity) {
  for (const double precontrol : {100.0, 0.0}) {
    Slow rig(true, 50.0, [](Axis& axis) { axis.drive_settings.dead_time = GetParam(); });
    rig.a.data.PositionControl.Kpc = precontrol;
    rig.run_v.Velocity = 80.0;
    rig.run_v.Execute = true;
    rig.run(1000);
    EXPECT_NEAR(rig.a.data.ActualVelocity, 80.0, 1e-6);
    const double missing = 1.0 - 0.01 * precontrol;
    EXPECT_NEAR(rig.a.data.StatusPositioning.FollowingError, missing * 80.0 / 50.0, 1e-6)
        << "v / Kv of what is not precontrolled, as without DSC";
  }
}

/// The target goes on between two commands, so that their cycle does not show in the motion.
TEST_P(DynamicServoControlDelays, MovesEvenlyBetweenTwoCommandsWhateverThePrecontrol) {
  for (const double precontrol : {150.0, 100.0, 40.0, 0.0}) {
    Slow rig(true, 50.0, [](Axis& axis) { axis.drive_settings.dead_time = GetParam(); });
    rig.a.data.PositionControl.Kpc = precontrol;
    rig.run_v.Velocity = 80.0;
    rig.run_v.Execute = true;
    rig.run(1000);
    double before = rig.a.data.ActualPosition;
    for (int i = 0; i < 50; ++i) {
      rig.tick();
      ASSERT_NEAR(rig.a.data.ActualPosition - before, 0.004 * 80.0, 1e-9) << "precontrol " << precontrol;
      ASSERT_NEAR(rig.a.data.ActualVelocity, 80.0, 1e-6) << "precontrol " << precontrol;
      before = rig.a.data.ActualPosition;
    }
  }
}

TEST(DynamicServoControl, PassesTheBacklashWithoutPrecontrol) {
  Slow rig(true, 50.0, [](Axis& axis) {
    axis.data.PositionControl.Kpc = 0.0;
    axis.data.Sensor[0].Backlash = {};
    axis.data.Sensor[0].Backlash.Enable = true;
    axis.data.Sensor[0].Backlash.Size = 0.5;
    axis.data.Sensor[0].Backlash.Velocity = 10.0;
  });
  EXPECT_LT(rig.restlessness(), 1e-6);
}

TEST(DynamicServoControl, IsOfNoEffectForAnotherEncoderThanThatOfTheDrive) {
  const auto beside = [](Axis& axis) {
    axis.data.Sensor[1].Existent = true;
    axis.data.PositionControl.InitialOperativeSensor = 2;
    axis.drive_settings.sensors[0].exists = true;
  };
  Slow with(true, 300.0, beside);
  EXPECT_GT(with.restlessness(), 0.1);
}

}  // namespace
}  // namespace lockstep::dynamic_servo_control_test
