// Axes that follow the extrapolated actual value of another one, through the blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/bent_cam.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::actual_coupling_test {
namespace {

using test::Rig;

void driven(AxisData& data) {
  data.VirtualAxis.Mode = 0;
}
void driven_ring(AxisData& data) {
  data.VirtualAxis.Mode = 0;
  data.Modulo.Enable = true;
  data.Properties.MotionType = 1;
}
void virtual_line(AxisData& /*data*/) {}
void virtual_ring(AxisData& data) {
  data.Modulo.Enable = true;
}

/// A leading axis with a drive, as a rule, and one that follows its actual value.
struct Pair : Rig {
  explicit Pair(const std::function<void(AxisData&)>& leading = driven,
                const std::function<void(AxisData&)>& following = virtual_line, int ratio = 1,
                double resolution = 0.0)
      : Rig(1'000'000, ratio),
        l(axis("Leading", leading)),
        f(axis("Following", following)),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home_l(block<MC_Home>()),
        home_f(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        move_l(block<MC_MoveAbsolute>()),
        gear(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()) {
    l.drive_settings = {.time_constant = 0.003, .dead_time = 0.002, .resolution = resolution};
    f.drive_settings = {.time_constant = 0.002, .dead_time = 0.0015};
    f.leading_values.push_back({&l, Coupling::actual});
    power_l.Axis = home_l.Axis = run_l.Axis = move_l.Axis = &l;
    power_f.Axis = home_f.Axis = &f;
    gear.Master = pos.Master = &l;
    gear.Slave = pos.Slave = &f;
    power_l.Enable = power_f.Enable = true;
    // What the encoder of the leading axis shows is no profile: only positions and velocities are watched.
    continuity[1].velocity = false;
    Rig::run(10 * ratio);
    home_l.Execute = home_f.Execute = true;
    Rig::run(10 * ratio);
  }

  void run_leading(double velocity) {
    run_l.Velocity = velocity;
    run_l.Execute = false;
    tick();
    run_l.Execute = true;
    tick();
  }
  /// In gear, the leading axis at constant velocity, everything settled.
  void settle(double velocity) {
    gear.Execute = true;
    ASSERT_TRUE(run_until([&] { return gear.InGear; }));
    run_leading(velocity);
    ASSERT_TRUE(run_until([&] { return run_l.InVelocity; }));
    run(4000);
  }
  /// Highest velocity of the following setpoint in so many ticks [u/s].
  double fastest_of(int ticks) {
    double fastest = 0.0;
    for (int i = 0; i < ticks; ++i) {
      tick();
      fastest = std::max(fastest, std::abs(f.setpoint().velocity));
    }
    return fastest;
  }
  /// By what the following setpoint is ahead of the leading actual position [u].
  double lead_of_setpoint() const {
    return shortest_distance(l.data.ActualPosition, f.setpoint().position.value, l.modulo());
  }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home_l;
  MC_Home& home_f;
  MC_MoveVelocity& run_l;
  MC_MoveAbsolute& move_l;
  MC_GearIn& gear;
  MC_GearInPos& pos;
};

TO_Struct_Extrapolation filtered() {
  TO_Struct_Extrapolation settings;
  settings.PositionFilter = {0.004, 0.003};
  settings.VelocityFilter = {0.02, 0.01};
  return settings;
}

class ActualCoupling : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratios, ActualCoupling, ::testing::Values(1, 2, 8));

TEST_P(ActualCoupling, HasNoFollowingErrorAtConstantVelocity) {
  Pair rig(driven, virtual_line, GetParam());
  rig.l.data.Extrapolation = filtered();
  rig.l.data.Extrapolation.FollowingAxisDependentTime = 0.0025;
  rig.settle(300.0);
  EXPECT_DOUBLE_EQ(rig.l.data.Extrapolation.LeadingAxisDependentTime, rig.period() + 0.007);
  const double ahead = 300.0 * (rig.period() + 0.0025);
  for (int i = 0; i < 500 * GetParam(); ++i) {
    rig.tick();
    if (i % GetParam() != 0) continue;
    ASSERT_NEAR(rig.lead_of_setpoint(), ahead, 1e-6);
    ASSERT_NEAR(rig.f.data.Velocity, 300.0, 1e-6);
  }
}

/// The setpoint of a following axis takes SetpointExecutionTime until the axis is there. The interpolator
/// cycle in it is the one that the leading-axis part counts already.
TEST_P(ActualCoupling, MovesBothAxesAtOnceWhereTheFollowingAxisPartIsItsSetpointExecutionTime) {
  Pair rig(driven, driven, GetParam());
  rig.l.data.Extrapolation = filtered();
  rig.l.data.Extrapolation.FollowingAxisDependentTime =
      rig.f.data.StatusPositioning.SetpointExecutionTime - rig.period();
  rig.settle(300.0);
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.f.data.ActualPosition, rig.l.data.ActualPosition, 1e-6);
  }
}

TEST_P(ActualCoupling, KeepsPhaseOverManyTurnsOfARing) {
  Pair rig(driven_ring, virtual_ring, GetParam());
  rig.l.data.Extrapolation = filtered();
  rig.settle(-3000.0);
  const double ahead = -3000.0 * rig.period();
  for (int i = 0; i < 2000; ++i) {
    rig.run(GetParam());
    ASSERT_NEAR(rig.lead_of_setpoint(), ahead, 1e-6);
  }
  EXPECT_LT(rig.l.data.ActualModuloCycle, -40);
}

TEST(ActualCouplingStatus, ShowsTheStagesOfTheExtrapolation) {
  Pair rig(driven, virtual_line);
  rig.l.data.Extrapolation = filtered();
  rig.settle(100.0);
  const auto& status = rig.l.data.StatusExtrapolation;
  EXPECT_NEAR(status.FilteredPosition, rig.l.data.ActualPosition - 0.7, 1e-7);
  EXPECT_NEAR(status.FilteredVelocity, 100.0, 1e-7);
  EXPECT_NEAR(status.ExtrapolatedPosition, rig.l.data.ActualPosition + 0.1, 1e-7);
  EXPECT_NEAR(status.ExtrapolatedVelocity, 100.0, 1e-7);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Position, status.ExtrapolatedPosition);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Velocity, status.ExtrapolatedVelocity);
}

TEST(ActualCouplingStatus, IsLeftAloneOnAxesThatDoNotLeadByTheirActualValue) {
  Rig rig;
  Axis& l = rig.axis("Leading");
  Axis& f = rig.axis("Following");
  rig.lead(f, l);
  auto& power = rig.block<MC_Power>();
  auto& run = rig.block<MC_MoveVelocity>();
  power.Axis = run.Axis = &l;
  power.Enable = true;
  rig.run(5);
  run.Velocity = 10.0;
  run.Execute = true;
  rig.run(2000);
  EXPECT_GT(l.data.ActualPosition, 1.0);
  EXPECT_EQ(l.data.StatusExtrapolation.ExtrapolatedPosition, 0.0);
  EXPECT_DOUBLE_EQ(l.data.Extrapolation.LeadingAxisDependentTime, 0.001);
}

TEST(ActualCouplingStatus, KeepsTheHysteresisAndTheBandOutOfAStandingLeadingAxis) {
  Pair rig(driven, virtual_line, 1, 0.01);
  rig.l.data.Extrapolation = filtered();
  rig.l.data.Extrapolation.Hysteresis.Value = 0.02;
  rig.l.data.Extrapolation.VelocityTolerance.Range = 20.0;
  rig.settle(0.3);  // an increment in 33 ms: velocities of 10 u/s, or none
  double last = rig.f.setpoint().position.value;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    ASSERT_GE(rig.f.setpoint().position.value, last);
    last = rig.f.setpoint().position.value;
  }
  EXPECT_NEAR(last, rig.l.data.ActualPosition, 0.02 + 10.0 * 0.008 + 0.01);
}

// ---- Encoders
// ---------------------------------------------------------------------------------------------------

/// The error stays within what the published stages allow: half the band over the extrapolation time, the
/// hysteresis, and what the filters leave of the increments.
TEST(ActualCouplingWithEncoder, StaysWithinBandHysteresisAndFilteredNoise) {
  const double resolution = 0.005;
  Pair rig(driven_ring, virtual_ring, 1, resolution);
  auto& settings = rig.l.data.Extrapolation;
  settings = filtered();
  settings.VelocityFilter = {0.05, 0.05};
  settings.VelocityTolerance.Range = 0.6;
  settings.Hysteresis.Value = 0.004;
  rig.settle(123.4);
  const double time = settings.LeadingAxisDependentTime;
  // An increment is up to half of it away from the position; the velocity is the difference of two such
  // errors per cycle, and a lag leaves of a difference at most its jump over the lag.
  const double velocity_noise = resolution / 0.05;
  const double bound = 0.5 * settings.VelocityTolerance.Range * time + settings.Hysteresis.Value +
                       resolution + velocity_noise * time;
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    rig.tick();
    const double error = std::abs(rig.lead_of_setpoint() - 123.4 * rig.period());
    ASSERT_LE(error, bound);
    worst = std::max(worst, error);
  }
  // Unfiltered, an increment more or less in one cycle would be 5 u/s, and as much of a step.
  EXPECT_NEAR(rig.l.data.StatusExtrapolation.FilteredVelocity, 123.4, 0.3 + velocity_noise);
  RecordProperty("worst_error_nm", static_cast<int>(worst * 1e6));
}

TEST(ActualCouplingWithEncoder, FiltersCalmTheFollowingVelocity) {
  const auto roughness = [](bool with_filters) {
    Pair rig(driven, virtual_line, 1, 0.005);
    if (with_filters) rig.l.data.Extrapolation = filtered();
    rig.pos.MasterSyncPosition = 20.0;
    rig.pos.SlaveSyncPosition = 20.0;
    rig.pos.MasterStartDistance = 15.0;
    rig.pos.SyncProfileReference = 1;
    rig.pos.Execute = true;
    rig.run_leading(123.4);
    EXPECT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
    rig.run(500);
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double last = rig.f.data.Velocity;
      rig.tick();
      worst = std::max(worst, std::abs(rig.f.data.Velocity - last));
    }
    return worst;
  };
  const double raw = roughness(false);
  const double calm = roughness(true);
  EXPECT_GE(raw, 4.9);
  EXPECT_LE(calm, raw / 5.0);
}

// ---- Changes at run time
// ----------------------------------------------------------------------------------------

TEST(ActualCouplingAtRunTime, AChangedPositionFilterMovesTheFollowingAxisNotAtAll) {
  Pair rig;
  rig.l.data.Extrapolation = filtered();
  rig.settle(200.0);
  for (const double t1 : {0.05, 0.0, 0.011}) {
    rig.l.data.Extrapolation.PositionFilter.T1 = t1;
    for (int i = 0; i < 50; ++i) {
      rig.tick();
      ASSERT_NEAR(rig.lead_of_setpoint(), 0.2, 1e-6);
    }
    EXPECT_DOUBLE_EQ(rig.l.data.Extrapolation.LeadingAxisDependentTime, 0.001 + t1 + 0.003);
  }
}

TEST(ActualCouplingAtRunTime, HomingTheLeadingAxisStepsTheLeadingValueByTheShiftAlone) {
  Pair rig;
  rig.l.data.Extrapolation = filtered();
  rig.settle(100.0);
  rig.home_l.Execute = false;
  rig.tick();
  const double before = rig.lead_of_setpoint();
  rig.continuity[0].velocity = false;  // homing is a step
  rig.home_l.Mode = 1;
  rig.home_l.Position = 50.0;
  rig.home_l.Execute = true;
  const double last = rig.f.setpoint().position.value;
  rig.run(2);
  EXPECT_TRUE(rig.home_l.Done);
  EXPECT_NEAR(rig.f.setpoint().position.value - last, 50.0 + 2 * 0.1, 1e-6);
  for (int i = 0; i < 100; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.lead_of_setpoint(), before, 1e-6);
  }
}

// ---- Position control of the leading axis
// -----------------------------------------------------------------------

TEST(ActualCouplingWithoutPositionControl, IsAcceptedAndFollows) {
  Pair rig;
  rig.run_l.PositionControlled = false;
  rig.run_leading(80.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_l.InVelocity; }));
  rig.run(200);
  ASSERT_FALSE(rig.l.position_controlled());
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  EXPECT_EQ(rig.f.pending_alarm(), 0);
  const double offset = rig.lead_of_setpoint();
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.lead_of_setpoint(), offset, 1e-6);
  }
}

TEST(ActualCouplingWithoutPositionControl, LeavesTheCouplingActiveWhenTheModeIsSwitched) {
  Pair rig;
  rig.l.data.Extrapolation = filtered();
  rig.settle(80.0);
  ASSERT_TRUE(rig.l.position_controlled());
  for (const bool controlled : {false, true, false}) {
    rig.run_l.PositionControlled = controlled;
    rig.run_leading(80.0);
    for (int i = 0; i < 500; ++i) {
      const double last = rig.f.setpoint().position.value;
      rig.tick();
      const double here = rig.f.setpoint().position.value;
      ASSERT_EQ(here, rig.l.data.StatusExtrapolation.ExtrapolatedPosition);
      // The axis itself moves unevenly while position control begins; a leading value of zero would step by
      // hundreds.
      ASSERT_NEAR(here, last, 0.2);
      ASSERT_TRUE(rig.gear.InGear);
    }
    EXPECT_EQ(rig.l.position_controlled(), controlled);
    EXPECT_NEAR(rig.lead_of_setpoint(), 0.08, 1e-3);
  }
}

TEST(ActualCouplingWithoutPositionControl, FollowsALeadingAxisThatIsSwitchedOffAndCoasts) {
  Pair rig;
  rig.settle(80.0);
  rig.continuity[0].velocity = false;  // the setpoint goes to the actual position
  rig.power_l.StopMode = 3;
  rig.power_l.Enable = false;
  rig.run(300);
  EXPECT_TRUE(rig.gear.InGear);
  EXPECT_NEAR(rig.f.setpoint().position.value, rig.l.data.ActualPosition, 1e-6);
}

// ---- MC_GearInPos
// -----------------------------------------------------------------------------------------------

class GearInPosByActualValue : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Profiles, GearInPosByActualValue, ::testing::Values(0, 1, 3));

TEST_P(GearInPosByActualValue, PlacesTheFunctionAtTheSynchronousPositions) {
  Pair rig;
  rig.l.data.Extrapolation = filtered();
  rig.pos.RatioNumerator = 2;
  rig.pos.MasterSyncPosition = 100.0;
  rig.pos.SlaveSyncPosition = 30.0;
  rig.pos.MasterStartDistance = 40.0;
  rig.pos.SyncProfileReference = GetParam();
  rig.pos.Velocity = 500.0;
  rig.pos.Execute = true;
  rig.run_leading(60.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; })) << static_cast<unsigned>(rig.pos.ErrorID);
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    const double leading = rig.l.data.StatusExtrapolation.ExtrapolatedPosition;
    ASSERT_NEAR(rig.f.setpoint().position.value, 30.0 + 2.0 * (leading - 100.0), 1e-9);
  }
  EXPECT_NEAR(rig.f.setpoint().position.value, 30.0 + 2.0 * (rig.l.data.ActualPosition + 0.06 - 100.0), 1e-5);
}

/// An extrapolated leading value tells no acceleration. The profile over time is carried out over the leading
/// distance: where that value has just begun to move, its beginning would be as steep as the value is slow.
TEST(GearInPosOverTimeByActualValue, DoesNotThrowAnAxisInMotionBehindALeadingAxisThatHasJustBegunToMove) {
  Pair rig;
  auto& move_f = rig.block<MC_MoveVelocity>();
  move_f.Axis = &rig.f;
  move_f.Velocity = 100.0;
  move_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return move_f.InVelocity; }));
  rig.pos.SyncProfileReference = 0;
  rig.pos.Velocity = 250.0;
  rig.pos.Acceleration = rig.pos.Deceleration = 500.0;
  rig.pos.Jerk = 0.0;
  rig.pos.MasterSyncPosition = rig.l.data.Position + 0.8;
  rig.pos.SlaveSyncPosition = rig.f.data.Position - 100.0;
  rig.pos.Execute = true;
  rig.run_leading(100.0);
  EXPECT_LE(rig.fastest_of(3000), 250.0);
}

TEST(CamInOverTimeByActualValue, DoesNotThrowAnAxisInMotionBehindALeadingAxisThatHasJustBegunToMove) {
  Pair rig;
  auto& move_f = rig.block<MC_MoveVelocity>();
  auto& in = rig.block<MC_CamIn>();
  Cam& cam = test::add_bent_cam(rig.controller, 360.0);
  move_f.Axis = &rig.f;
  move_f.Velocity = 100.0;
  move_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return move_f.InVelocity; }));
  in.Master = &rig.l;
  in.Slave = &rig.f;
  in.Cam = &cam;
  in.SyncProfileReference = 0;
  in.Velocity = 250.0;
  in.Acceleration = in.Deceleration = 500.0;
  in.Jerk = 0.0;
  in.MasterSyncPosition = rig.l.data.Position + 0.8;
  in.SlaveOffset = rig.f.data.Position - 100.0;
  in.Execute = true;
  rig.run_leading(100.0);
  EXPECT_LE(rig.fastest_of(3000), 250.0);
}

/// What speeds up behind the start makes the profile steeper.
TEST(GearInPosOverTimeByActualValue, DoesNotThrowAnAxisAtRestBehindALeadingAxisThatRunsUp) {
  for (const double place : {0.3, 1.0, 3.0, 8.0}) {
    Pair rig;
    rig.pos.SyncProfileReference = 0;
    rig.pos.Velocity = 400.0;
    rig.pos.Acceleration = rig.pos.Deceleration = 2000.0;
    rig.pos.MasterSyncPosition = rig.l.data.Position + place;
    rig.pos.SlaveSyncPosition = rig.f.data.Position + 60.0;
    rig.pos.Execute = true;
    rig.run_leading(100.0);
    EXPECT_LE(rig.fastest_of(3000), 600.0) << place;
  }
}

/// What a coarse encoder shows from cycle to cycle is no acceleration that would have to be waited out.
TEST(GearInPosOverTimeByActualValue, TakesAnAxisInMotionOverBehindACoarseEncoder) {
  Pair rig(driven, virtual_line, 1, 0.02);
  auto& move_f = rig.block<MC_MoveVelocity>();
  move_f.Axis = &rig.f;
  move_f.Velocity = 50.0;
  move_f.Execute = true;
  rig.run_leading(70.0);
  rig.run(1000);
  rig.pos.SyncProfileReference = 0;
  rig.pos.Acceleration = rig.pos.Deceleration = 2000.0;
  rig.pos.MasterSyncPosition = rig.l.data.Position + 100.0;
  rig.pos.SlaveSyncPosition = rig.f.data.Position + 60.0;
  rig.pos.Execute = true;
  EXPECT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
}

/// At creep speed an encoder shows an increment now and then, at a velocity that is far too high: what is
/// extrapolated goes back again.
struct Creeping : Pair {
  explicit Creeping(double tolerance, double hysteresis)
      : Pair(
            driven,
            [tolerance](AxisData& data) { data.Synchronization.MasterReversionTolerance = tolerance; }, 1,
            0.01) {
    l.data.Extrapolation.Hysteresis.Value = hysteresis;
    pos.MasterSyncPosition = 2.0;
    pos.SlaveSyncPosition = 2.0;
    pos.MasterStartDistance = 1.0;
    pos.SyncProfileReference = 1;
    pos.Execute = true;
    run_leading(0.5);
  }
};

TEST(GearInPosByNoisyActualValue, RaisesAlarm608) {
  Creeping rig(0.0, 0.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.f.pending_alarm() != 0 || rig.pos.InSync; }));
  EXPECT_EQ(rig.f.pending_alarm(), 608);
  EXPECT_TRUE(rig.pos.Error);
}

TEST(GearInPosByNoisyActualValue, SynchronizesWithinMasterReversionTolerance) {
  Creeping rig(0.05, 0.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.f.pending_alarm() != 0 || rig.pos.InSync; }));
  EXPECT_EQ(rig.f.pending_alarm(), 0);
  EXPECT_TRUE(rig.pos.InSync);
}

TEST(GearInPosByNoisyActualValue, SynchronizesWithAHysteresisThatHoldsReversalsBack) {
  Creeping rig(0.0, 0.05);
  ASSERT_TRUE(rig.run_until([&] { return rig.f.pending_alarm() != 0 || rig.pos.InSync; }));
  EXPECT_EQ(rig.f.pending_alarm(), 0);
  EXPECT_TRUE(rig.pos.InSync);
}

}  // namespace
}  // namespace lockstep::actual_coupling_test
