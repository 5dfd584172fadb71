// What the published reactions to an alarm do to a moving axis, and how it is taken into service again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::alarm_reactions_test {
namespace {

using test::Rig;

constexpr double kOfTheJob = 500.0;  // decelerations [u/s²]
constexpr double kMaximum = 4000.0;
constexpr double kEmergency = 9000.0;
constexpr double kMaximumJerk = 1e5;  // [u/s³]

/// An axis on its way, at 200 u/s, with three decelerations that can be told from each other.
struct Moving : Rig {
  explicit Moving(bool driven = false)
      : a(axis("Axis",
               [driven](AxisData& data) {
                 data.VirtualAxis.Mode = driven ? 0 : 1;
                 data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = kMaximum;
                 data.DynamicLimits.MaxJerk = kMaximumJerk;
                 data.DynamicDefaults.EmergencyDeceleration = kEmergency;
                 data.PositionLimits_SW.LimitReachedBehavior = 1;
                 data.PositionLimits_SW.MinPosition = -100.0;
                 data.PositionLimits_SW.MaxPosition = 100.0;
                 data.FollowingError.EnableMonitoring = false;
               })),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        run_v(block<MC_MoveVelocity>()),
        back(block<MC_MoveVelocity>()),
        stop(block<MC_Stop>()) {
    a.drive_settings.time_constant = 0.01;
    power.Axis = home.Axis = run_v.Axis = back.Axis = stop.Axis = &a;
    reset.Axis = &a;
    continuity[0].velocity = !driven;
    continuity[0].acceleration = false;
    power.Enable = home.Execute = true;
    run(20);
    run_v.Velocity = 200.0;
    run_v.Acceleration = 2000.0;
    run_v.Deceleration = kOfTheJob;
    run_v.Jerk = 0.0;
    run_v.Execute = true;
  }

  /// Runs until the axis stands; the maximum deceleration and the maximum change of it in a tick.
  void watch_stop() {
    deceleration = change = 0.0;
    double last = a.setpoint().acceleration;
    ASSERT_TRUE(run_until([&] {
      const double now = a.setpoint().acceleration;
      deceleration = std::max(deceleration, -now);
      if (now < 0.0) change = std::max(change, std::abs(now - last));
      last = now;
      return a.setpoint().velocity == 0.0;
    }));
  }

  /// The alarm has ended the job, new ones are refused, MC_Reset ends that.
  void expect_alarm(int number, int reaction) {
    EXPECT_EQ(a.pending_alarm(), number);
    EXPECT_EQ(a.data.ErrorDetail.Reaction, reaction);
    EXPECT_TRUE(has_bit(a.data.StatusWord, StatusBit::Error));
    EXPECT_TRUE(run_v.Error);
    EXPECT_EQ(run_v.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
    back.Velocity = 50.0;
    back.Direction = 2;
    back.Execute = true;
    run(3);
    EXPECT_TRUE(back.Error);
    EXPECT_EQ(back.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
    EXPECT_EQ(a.setpoint().velocity, 0.0);
  }
  void expect_service_after_reset() {
    back.Execute = false;
    reset.Execute = true;
    run(3);
    EXPECT_TRUE(reset.Done);
    EXPECT_EQ(a.pending_alarm(), 0);
    EXPECT_FALSE(has_bit(a.data.StatusWord, StatusBit::Error));
    ASSERT_TRUE(run_until([&] { return power.Status; }, 500)) << "Enable has stayed TRUE";
    back.Execute = true;
    EXPECT_TRUE(run_until([&] { return back.InVelocity; }, 500));
  }

  double deceleration = 0.0;
  double change = 0.0;
  Axis& a;
  MC_Power& power;
  MC_Home& home;
  MC_Reset& reset;
  MC_MoveVelocity& run_v;
  MC_MoveVelocity& back;
  MC_Stop& stop;
};

TEST(AlarmReaction, StopWithCurrentDynamicsBrakesWithTheValuesOfTheJob) {
  Moving rig;
  rig.a.data.PositionLimits_SW.Active = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.pending_alarm() != 0; }));
  rig.watch_stop();
  EXPECT_NEAR(rig.deceleration, kOfTheJob, 5.0);
  EXPECT_EQ(rig.a.data.Position, 100.0);
  rig.expect_alarm(alarm::kSoftwareLimitReached, 1);
  EXPECT_TRUE(rig.power.Status);
  rig.expect_service_after_reset();
}

TEST(AlarmReaction, StopWithMaximumDynamicsKeepsTheGreatestJerk) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.a.raise(alarm::kLeadingAxis);
  rig.watch_stop();
  EXPECT_NEAR(rig.deceleration, kMaximum, 1e-6);
  EXPECT_NEAR(rig.change, kMaximumJerk * rig.period(), 1e-6);
  rig.expect_alarm(alarm::kLeadingAxis, 2);
  EXPECT_TRUE(rig.power.Status);
  rig.expect_service_after_reset();
}

TEST(AlarmReaction, StopWithTheEmergencyRampHasNoJerkLimit) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.a.raise(alarm::kMarkNotFound);
  rig.watch_stop();
  EXPECT_NEAR(rig.deceleration, kEmergency, 1e-6);
  EXPECT_GT(rig.change, kEmergency / 2) << "at once";
  rig.expect_alarm(alarm::kMarkNotFound, 3);
  EXPECT_TRUE(rig.power.Status);
  rig.expect_service_after_reset();
}

TEST(AlarmReaction, RemovingTheEnableLeavesTheStopToTheDriveUntilTheAxisIsEnabledAnew) {
  Moving rig(true);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.run(100);
  rig.a.raise(alarm::kFollowingError);
  rig.run(2);
  EXPECT_FALSE(rig.power.Status);
  EXPECT_TRUE(rig.power.Error);
  EXPECT_EQ(rig.a.data.VelocitySetpoint, 0.0);
  EXPECT_GT(rig.a.data.ActualVelocity, 50.0) << "the drive is on its own ramp";
  ASSERT_TRUE(rig.run_until([&] { return rig.a.off(); }));
  EXPECT_LT(std::abs(rig.a.data.ActualVelocity), 1.0);
  EXPECT_FALSE(bit_of(rig.a.drive().words().zsw1, zsw1::kOperationEnabled));
  rig.run(100);
  rig.expect_alarm(alarm::kFollowingError, 4);
  rig.expect_service_after_reset();
}

TEST(AlarmReaction, TrackingTheSetpointsPutsOutNoneAndFollowsTheActualValues) {
  constexpr int kMovesOnItsOwn = 550;
  Moving rig(true);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.run(100);
  rig.a.raise(kMovesOnItsOwn);
  rig.run(2);
  EXPECT_FALSE(rig.power.Status);
  for (int i = 0; i < 20; ++i) {
    rig.tick();
    ASSERT_EQ(rig.a.data.VelocitySetpoint, 0.0);
    ASSERT_EQ(rig.a.setpoint().position.value, rig.a.data.ActualPosition);
  }
  ASSERT_GT(rig.a.data.ActualPosition, rig.a.setpoint().position.value - 1e-9);
  rig.run(500);
  rig.expect_alarm(kMovesOnItsOwn, 5);
  rig.expect_service_after_reset();
}

TEST(AlarmReaction, GivesWayToAStrongerOneAndNotToAWeaker) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.a.raise(alarm::kLeadingAxis);
  rig.run(10);
  rig.a.raise(alarm::kMarkNotFound);
  rig.run(2);
  EXPECT_NEAR(rig.a.setpoint().acceleration, -kEmergency, 1e-6);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kMarkNotFound);
  rig.a.raise(alarm::kSynchronizing);
  rig.run(2);
  EXPECT_NEAR(rig.a.setpoint().acceleration, -kEmergency, 1e-6) << "the stop goes on";
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kMarkNotFound);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::SynchronousError)) << "both are shown";
}

TEST(AlarmReaction, EndsARunningMC_StopWithCommandAborted) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.stop.Mode = 3;
  rig.stop.Deceleration = 100.0;
  rig.stop.Execute = true;
  rig.run(10);
  ASSERT_TRUE(rig.stop.Busy);
  rig.a.raise(alarm::kLeadingAxis);
  rig.run(2);
  EXPECT_TRUE(rig.stop.CommandAborted);
  EXPECT_FALSE(rig.stop.Error);
}

/// Ranks of stop reactions: MC_Stop Mode 0 is as strong as reaction 3, Mode 2 as 2, Mode 3 as 1.
TEST(AlarmReaction, GivesWayToAStrongerMC_Stop) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.a.raise(alarm::kLeadingAxis);
  rig.run(3);
  rig.stop.Mode = 0;
  rig.stop.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.stop.Busy);
  EXPECT_NEAR(rig.a.setpoint().acceleration, -kEmergency, 1e-6);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kLeadingAxis);
  ASSERT_TRUE(rig.run_until([&] { return !rig.stop.Busy; }));
  EXPECT_TRUE(rig.stop.Done);
  EXPECT_TRUE(rig.a.setpoint().standing());
}

TEST(AlarmReaction, RefusesAWeakerMC_StopWithCommandAborted) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.a.raise(alarm::kLeadingAxis);
  rig.run(10);
  rig.stop.Mode = 3;
  rig.stop.Deceleration = 100.0;
  rig.stop.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.stop.CommandAborted);
  EXPECT_FALSE(rig.stop.Error);
  rig.watch_stop();
  EXPECT_GT(rig.deceleration, 0.9 * kMaximum) << "the stop of the alarm goes on";
}

TEST(AlarmReaction, LeavesAStrongerMC_StopAlone) {
  Moving rig;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_v.InVelocity; }));
  rig.stop.Mode = 0;
  rig.stop.Execute = true;
  rig.run(3);
  rig.a.raise(alarm::kLeadingAxis);
  rig.run(3);
  EXPECT_TRUE(rig.stop.Busy);
  EXPECT_NEAR(rig.a.setpoint().acceleration, -kEmergency, 1e-6);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 2);
  ASSERT_TRUE(rig.run_until([&] { return !rig.stop.Busy; }));
  EXPECT_TRUE(rig.stop.Done);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kLeadingAxis);
}

/// Until its Execute falls, no job starts: whatever has happened to the axis meanwhile.
TEST(MC_StopThatIsDone, LocksTheAxisBeyondAnAlarmAndItsEnable) {
  for (const bool by_alarm : {true, false}) {
    Moving rig;
    rig.stop.Mode = 0;
    rig.stop.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.stop.Done; }));
    if (by_alarm) {
      rig.a.raise(alarm::kMarkNotFound);
      rig.run(3);
      rig.reset.Execute = true;
    } else {
      rig.power.Enable = false;
      ASSERT_TRUE(rig.run_until([&] { return rig.a.off(); }));
      rig.power.Enable = true;
    }
    rig.run(5);
    ASSERT_TRUE(rig.power.Status);
    ASSERT_TRUE(rig.stop.Done);
    EXPECT_TRUE(has_bit(rig.a.data.StatusWord2, Status2Bit::StopCommand));
    rig.back.Velocity = 50.0;
    rig.back.Execute = true;
    rig.run(3);
    EXPECT_EQ(rig.back.ErrorID, static_cast<WORD>(ErrorId::locked)) << by_alarm;
    rig.stop.Execute = rig.back.Execute = false;
    rig.run(3);
    rig.back.Execute = true;
    rig.run(3);
    EXPECT_TRUE(rig.back.Busy);
  }
}

}  // namespace
}  // namespace lockstep::alarm_reactions_test
