// The emergency ramp of an axis with a drive begins where the axis is, and as fast as it is: how far it
// really goes, with a drive that lags, a following error, a torque limit, a fixed stop, and axes that follow
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/torque.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::emergency_ramp_test {
namespace {

using test::Rig;

constexpr double kDeceleration = 4000.0;  // of the emergency ramp [u/s²]

/// A driven axis under way at 100 u/s.
struct Driven : Rig {
  explicit Driven(const std::function<void(Axis&)>& change = {}, int ratio = 1)
      : Rig(1'000'000, ratio),
        cycle(ratio),
        a(axis("Axis",
               [](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.DynamicDefaults.EmergencyDeceleration = kDeceleration;
                 data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = 3000.0;
                 data.DynamicLimits.MaxVelocity = data.DynamicLimits.Velocity = 300.0;
                 data.DynamicLimits.MaxJerk = 1e5;
                 data.FollowingError.EnableMonitoring = false;
               })),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        run_v(block<MC_MoveVelocity>()),
        stop(block<MC_Stop>()) {
    a.drive_settings.time_constant = 0.002;
    continuity[0].velocity = false;  // the setpoint of a driven axis steps onto its actual state
    if (change) change(a);
    power.Axis = home.Axis = run_v.Axis = stop.Axis = &a;
  }
  void set_out(int ticks = 1000) {
    power.Enable = true;
    run(10 * cycle);
    home.Execute = true;
    run(10 * cycle);
    run_v.Velocity = 100.0;
    run_v.Acceleration = 3000.0;
    run_v.Jerk = 0.0;
    run_v.Execute = true;
    run(ticks);
  }

  /// What an axis that brakes from here at once may make of it [u], and when it stands [s].
  double minimum_distance() const {
    return a.data.ActualVelocity * a.data.ActualVelocity / (2.0 * kDeceleration);
  }

  /// Runs until the axis stands; tells the way that it has really made [u].
  double distance_to_rest() {
    const double from = a.data.ActualPosition;
    ticks = 0;
    fastest = a.data.ActualVelocity;
    hardest = 0.0;
    double before = a.data.ActualVelocity;
    for (int still = 0; still < 50 && ticks < 5000;) {
      tick();
      ++ticks;
      const double v = a.data.ActualVelocity;
      fastest = std::max(fastest, v);
      hardest = std::max(hardest, (before - v) / 0.001);
      before = v;
      if (std::abs(v) >= 0.5) stood_after = ticks + 1;
      still = std::abs(v) < 1e-3 ? still + 1 : 0;
    }
    return a.data.ActualPosition - from;
  }

  int cycle;  // of the interpolator [ticks]
  int ticks = 0;
  int stood_after = 0;   // below 0.5 u/s for good [ticks]
  double fastest = 0.0;  // actual velocity on the way
  double hardest = 0.0;  // actual deceleration on the way
  Axis& a;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run_v;
  MC_Stop& stop;
};

void lags_behind(Axis& axis) {
  axis.data.PositionControl.Kv = 10.0;
  axis.data.PositionControl.Kpc = 0.0;
}

/// The velocity that a drive with a lag of 40 ms still gains by what it has been told already [u/s].
double gained_within(double ticks, const Driven& rig) {
  return 0.001 * ticks * (rig.a.data.VelocitySetpoint - rig.a.data.ActualVelocity) / 0.04;
}

TEST(EmergencyRamp, OfADriveThatLagsNeverSpeedsItUp) {
  Driven rig([](Axis& axis) { axis.drive_settings.time_constant = 0.04; });
  rig.set_out(35);
  const double v = rig.a.data.ActualVelocity;
  ASSERT_GT(v, 20.0);
  ASSERT_LT(v, 60.0);
  ASSERT_GT(rig.a.data.VelocitySetpoint, v + 20.0) << "the drive is still to become faster";
  const double until_heard = gained_within(3.0, rig);
  rig.stop.Execute = true;
  rig.stop.Mode = 0;
  const double minimum = rig.minimum_distance();
  const double distance = rig.distance_to_rest();
  EXPECT_LE(rig.fastest, v + until_heard);
  EXPECT_NEAR(distance, minimum + v * 0.04, 0.4) << "the ramp, and what the drive runs on by its lag";
  EXPECT_TRUE(rig.stop.Done);
}

TEST(EmergencyRamp, DoesNotWorkOffTheFollowingError) {
  Driven rig(&lags_behind);
  rig.set_out();
  ASSERT_NEAR(rig.a.data.StatusPositioning.FollowingError, 10.0, 0.5);
  rig.stop.Execute = true;
  rig.stop.Mode = 0;
  const double minimum = rig.minimum_distance();
  const double distance = rig.distance_to_rest();
  EXPECT_NEAR(distance, minimum, 0.5);
  EXPECT_LE(rig.stood_after, 25 + 20) << "v / a = 25 ms, and the lag";
  EXPECT_NEAR(rig.hardest, kDeceleration, 0.1 * kDeceleration) << "a ramp, not a blow";
  EXPECT_TRUE(rig.stop.Done);
  EXPECT_NEAR(rig.a.data.Position, rig.a.data.ActualPosition, 0.05);
}

TEST(EmergencyRamp, OfDynamicServoControlDoesNotWorkItOffEither) {
  Driven rig([](Axis& axis) {
    lags_behind(axis);
    axis.data.PositionControl.EnableDSC = true;
  });
  rig.set_out();
  ASSERT_GT(rig.a.data.StatusPositioning.FollowingError, 5.0);
  rig.stop.Execute = true;
  const double minimum = rig.minimum_distance();
  EXPECT_NEAR(rig.distance_to_rest(), minimum, 0.5);
  EXPECT_LE(rig.stood_after, 45);
}

TEST(EmergencyRamp, OfFallingEnableWithStopMode0IsTheSame) {
  Driven rig(&lags_behind);
  rig.set_out();
  rig.power.Enable = false;
  const double minimum = rig.minimum_distance();
  EXPECT_NEAR(rig.distance_to_rest(), minimum, 0.5);
  EXPECT_FALSE(rig.power.Status);
}

TEST(EmergencyRamp, AtAHardwareLimitSwitchEndsShortlyBehindIt) {
  Driven rig([](Axis& axis) {
    lags_behind(axis);
    axis.data.PositionLimits_HW.Active = true;
    axis.data.PositionLimits_HW.ApproachBehavior = 1;
    axis.drive_settings.signals.limit_max = 50.0;
  });
  rig.set_out(10);
  ASSERT_TRUE(rig.run_until([&] { return rig.a.pending_alarm() != 0; }, 2000));
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kHardwareLimitSwitch);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 3);
  rig.distance_to_rest();
  EXPECT_NEAR(rig.a.data.ActualPosition, 50.0 + 100.0 * 100.0 / (2.0 * kDeceleration), 0.6);
  EXPECT_TRUE(rig.power.Status);
}

TEST(EmergencyRamp, BeginsWhereTheAxisIsWhateverTheInterpolatorCycle) {
  Driven rig(&lags_behind, 8);
  rig.set_out(2000);
  rig.stop.Execute = true;
  const double minimum = rig.minimum_distance();
  EXPECT_LT(rig.distance_to_rest(), minimum + 100.0 * 0.016 + 0.4) << "up to two interpolator cycles later";
}

TEST(EmergencyRamp, WithoutPositionControlBeginsAtTheActualVelocity) {
  Driven rig([](Axis& axis) { axis.drive_settings.time_constant = 0.04; });
  rig.run_v.PositionControlled = false;
  rig.set_out(35);
  const double v = rig.a.data.ActualVelocity;
  ASSERT_GT(rig.a.data.VelocitySetpoint, v + 20.0);
  const double until_heard = gained_within(3.0, rig);
  rig.stop.Execute = true;
  rig.distance_to_rest();
  EXPECT_LE(rig.fastest, v + until_heard);
  EXPECT_TRUE(rig.stop.Done);
  EXPECT_FALSE(rig.a.position_controlled()) << "MC_Stop keeps it as it is";
}

TEST(EmergencyRamp, WeakerStopsGoOnFromTheSetpoint) {
  Driven rig(&lags_behind);
  rig.set_out();
  rig.stop.Execute = true;
  rig.stop.Mode = 2;
  rig.continuity[0].velocity = true;
  EXPECT_GT(rig.distance_to_rest(), 10.0) << "the following error is worked off";
}

// ---- The manipulated value
// ---------------------------------------------------------------------------------------

/// The largest change of what the drive is told from one tick to the next, in the first ones of the ramp.
double maximum_step(double smoothing) {
  Driven rig([smoothing](Axis& axis) {
    axis.drive_settings.time_constant = 0.04;
    axis.data.PositionControl.SmoothingTimeByChangeDifference = smoothing;
  });
  rig.set_out(35);
  rig.stop.Execute = true;
  double step = 0.0;
  double before = rig.a.data.VelocitySetpoint;
  for (int i = 0; i < 10; ++i) {
    rig.tick();
    step = std::max(step, before - rig.a.data.VelocitySetpoint);
    before = rig.a.data.VelocitySetpoint;
  }
  return step;
}

TEST(EmergencyRamp, IsSwitchedOverToWithTheSmoothingTime) {
  EXPECT_GT(maximum_step(0.0), 20.0);
  EXPECT_LT(maximum_step(0.02), 10.0);
}

// ---- Limited torque
// ----------------------------------------------------------------------------------------------

/// A press that is held up by something hard at 50.
struct Blocked : Driven {
  explicit Blocked(DINT mode)
      : Driven([](Axis& axis) {
          axis.data.Actor.Interface.EnableTorqueData = true;
          axis.data.FollowingError.EnableMonitoring = true;
          axis.data.FollowingError.MinValue = axis.data.FollowingError.MaxValue = 5.0;
          axis.data.Clamping.FollowingErrorDeviation = 2.0;
          axis.data.Clamping.PositionTolerance = 0.5;
          axis.drive_settings.plant.inertia = 0.001;
          axis.drive_settings.plant.has_stop = true;
          axis.drive_settings.plant.stop = {50.0, 1, 1000.0};
        }),
        limiting(block<MC_TorqueLimiting>()),
        move(block<MC_MoveAbsolute>()),
        halt(block<MC_Halt>()) {
    limiting.Axis = move.Axis = halt.Axis = &a;
    limiting.Mode = mode;
    limiting.Limit = 20.0;
    power.Enable = true;
    run(10);
    home.Execute = true;
    run(10);
    limiting.Enable = true;
    move.Position = 75.0;
    move.Velocity = 50.0;
    move.Execute = true;
    run(2500);
  }
  MC_TorqueLimiting& limiting;
  MC_MoveAbsolute& move;
  MC_Halt& halt;
};

TEST(EmergencyRamp, EndsTheFollowingErrorThatALimitedTorqueHasLeft) {
  Blocked rig(0);
  ASSERT_GT(rig.a.data.StatusPositioning.FollowingError, 20.0);
  rig.stop.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.stop.Done; }, 100));
  rig.run(200);
  EXPECT_LT(std::abs(rig.a.data.StatusPositioning.FollowingError), 0.1);
  rig.limiting.Enable = false;
  rig.run(1000);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_TRUE(rig.power.Status);
  EXPECT_LT(std::abs(rig.a.data.ActualPosition - 50.0), 0.5) << "nothing leaps";
}

TEST(EmergencyRamp, AtAFixedStopThatHasBeenFoundKeepsTheForce) {
  Blocked rig(1);
  ASSERT_TRUE(rig.limiting.InClamping);
  const double torque = rig.a.data.StatusTorqueData.ActualTorque;
  ASSERT_GT(torque, 15.0);
  rig.stop.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.stop.Done; }, 100));
  rig.run(200);
  EXPECT_TRUE(rig.limiting.InClamping);
  EXPECT_NEAR(rig.a.data.StatusTorqueData.ActualTorque, torque, 0.5);
}

// ---- Following axes
// ----------------------------------------------------------------------------------------------

/// An axis that follows the setpoint of a driven one which lags behind it.
struct Following : Driven {
  Following()
      : Driven(&lags_behind), f(axis("Following")), power_f(block<MC_Power>()), gear(block<MC_GearIn>()) {
    lead(f, a);
    power_f.Axis = gear.Slave = &f;
    gear.Master = &a;
    gear.RatioNumerator = 2;
    power_f.Enable = true;
    continuity[1].highest_acceleration = 2.0 * (kDeceleration + 3000.0) + 1.0;
    continuity[1].acceleration = false;
    power.Enable = true;
    run(10);
    home.Execute = true;
    run(10);
    gear.Execute = true;
    run(10);
  }
  Axis& f;
  MC_Power& power_f;
  MC_GearIn& gear;
};

TEST(EmergencyRamp, IsNoStepForAxesThatFollowAndLeavesThemInTheirPlace) {
  Following rig;
  ASSERT_TRUE(rig.gear.InGear);
  const double apart = rig.f.data.Position - 2.0 * rig.a.data.Position;
  rig.set_out();
  rig.stop.Execute = true;
  rig.run(3);
  const double leading_jump = rig.run_v.Velocity * 0.1;  // the following error, v / Kv
  EXPECT_GT(rig.f.data.Position - 2.0 * rig.a.data.Position, apart + leading_jump)
      << "it goes on from the setpoint of before";
  rig.run(2000);
  EXPECT_TRUE(rig.gear.InGear);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  EXPECT_NEAR(rig.f.data.Position - 2.0 * rig.a.data.Position, apart, 1e-9) << "and comes over to it";
}

TEST(EmergencyRamp, IsComeOverToWhileTheLeadingAxisIsHomedAndMovesOn) {
  Following rig;
  const double apart = rig.f.data.Position - 2.0 * rig.a.data.Position;
  rig.set_out();
  rig.stop.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.stop.Done; }, 200));
  rig.stop.Execute = false;
  rig.run_v.Execute = false;
  rig.run(2);
  rig.run_v.Execute = true;
  rig.run(1000);
  EXPECT_TRUE(rig.gear.InGear);
  EXPECT_NEAR(rig.f.data.Position - 2.0 * rig.a.data.Position, apart, 1e-9);
}

}  // namespace
}  // namespace lockstep::emergency_ramp_test
