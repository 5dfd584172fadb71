// Torque limiting, torque data and the fixed stop of an axis with a simulated machine.
#include "fb/torque.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::torque_test {
namespace {

using test::Rig;

constexpr double kStop = 50.0;         // [u]
constexpr double kStiffness = 1000.0;  // [Nm/u]

bool bit(const Axis& axis, StatusBit bit) {
  return has_bit(axis.data.StatusWord, bit);
}

/// An axis that can run into a fixed stop at 50.
struct Press : Rig {
  explicit Press(const std::function<void(Axis&)>& change = {}, int ratio = 1)
      : Rig(1'000'000, ratio),
        a(axis("Press",
               [](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.Actor.Interface.EnableTorqueData = true;
                 data.Clamping.FollowingErrorDeviation = 2.0;
                 data.Clamping.PositionTolerance = 0.5;
                 data.FollowingError.MinValue = 5.0;
                 data.FollowingError.MaxValue = 5.0;
               })),
        leading(axis("Leading")),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        limiting(block<MC_TorqueLimiting>()),
        range(block<MC_TorqueRange>()),
        additive(block<MC_TorqueAdditive>()),
        move(block<MC_MoveAbsolute>()),
        back(block<MC_MoveRelative>()),
        run_v(block<MC_MoveVelocity>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()) {
    a.drive_settings.time_constant = 0.002;
    a.drive_settings.plant.inertia = 0.001;
    a.drive_settings.plant.has_stop = true;
    a.drive_settings.plant.stop = {kStop, 1, kStiffness};
    if (change) change(a);
    lead(a, leading);
    power.Axis = home.Axis = &a;
    reset.Axis = &a;
    limiting.Axis = range.Axis = additive.Axis = &a;
    move.Axis = back.Axis = run_v.Axis = jog.Axis = halt.Axis = &a;
    continuity[0].velocity = false;  // a setpoint that is frozen is a published step
    power.Enable = true;
    run(10);
    home.Execute = true;
    run(10);
    limiting.Limit = 20.0;
    move.Velocity = 50.0;
    move.Position = 100.0;
  }

  void clamp() {
    limiting.Mode = 1;
    limiting.Enable = true;
    move.Execute = true;
    ASSERT_TRUE(run_until([&] { return limiting.InClamping; }, 5000));
    move.Execute = false;
    run(500);
    ASSERT_TRUE(limiting.InClamping);
  }

  Axis& a;
  Axis& leading;
  MC_Power& power;
  MC_Home& home;
  MC_Reset& reset;
  MC_TorqueLimiting& limiting;
  MC_TorqueRange& range;
  MC_TorqueAdditive& additive;
  MC_MoveAbsolute& move;
  MC_MoveRelative& back;
  MC_MoveVelocity& run_v;
  MC_MoveJog& jog;
  MC_Halt& halt;
};

// ---- MC_TorqueLimiting Mode 0
// ------------------------------------------------------------------------------------

TEST(TorqueLimiting, KeepsTheTorqueWithinTheLimitAndTellsWhenItIsReached) {
  Press rig;
  rig.limiting.Enable = true;
  rig.run(3);
  EXPECT_TRUE(rig.limiting.Busy);
  EXPECT_FALSE(rig.limiting.InLimitation);
  EXPECT_TRUE(bit(rig.a, StatusBit::TorqueLimitingCommand));
  rig.move.Execute = true;
  bool reached = false;
  for (int i = 0; i < 4000; ++i) {
    rig.tick();
    ASSERT_LE(std::abs(rig.a.data.StatusTorqueData.ActualTorque), 20.0);
    reached |= rig.limiting.InLimitation;
  }
  EXPECT_TRUE(reached);
  EXPECT_TRUE(rig.limiting.InLimitation);
  EXPECT_TRUE(bit(rig.a, StatusBit::InLimitation));
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 20.0);
  EXPECT_NEAR(rig.a.data.ActualPosition, kStop + 20.0 / kStiffness, 1e-6);
  EXPECT_EQ(rig.a.pending_alarm(), 0) << "neither following error nor positioning are watched over";
  EXPECT_TRUE(rig.move.Busy);
  EXPECT_FALSE(rig.limiting.InClamping);
  EXPECT_FALSE(bit(rig.a, StatusBit::InClamping));
}

TEST(TorqueLimiting, LeavesTheMonitoringOnIfItIsConfigured) {
  Press rig([](Axis& a) { a.data.TorqueLimiting.PositionBasedMonitors = 1; });
  rig.limiting.Enable = true;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Error; }, 4000));
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kFollowingError);
  EXPECT_TRUE(rig.limiting.Busy) << "the limiting outlasts the alarm";
}

TEST(TorqueLimiting, LeavesMC_HaltDoneOnceTheAxisHasStoodForTheDwellTime) {
  Press rig([](Axis& a) { a.data.PositioningMonitoring.MinDwellTime = 0.1; });
  rig.limiting.Enable = true;
  rig.move.Execute = true;
  rig.run(4000);
  rig.halt.Execute = true;
  rig.run(90);
  EXPECT_TRUE(rig.halt.Busy) << "not before the dwell time is over";
  ASSERT_TRUE(rig.run_until([&] { return rig.halt.Done; }, 40));
  EXPECT_GT(rig.a.data.StatusPositioning.FollowingError, 10.0) << "which MC_Halt leaves as it is";
  EXPECT_EQ(rig.a.pending_alarm(), 0);
}

TEST(TorqueLimiting, LeavesMC_HaltBusyWhileTheAxisStillMoves) {
  Press rig([](Axis& a) {
    a.drive_settings.plant.has_stop = false;
    a.data.PositionControl.Kv = 10.0;
    a.data.PositionControl.Kpc = 0.0;
    a.data.PositioningMonitoring.MinDwellTime = 0.01;
  });
  rig.limiting.Enable = true;
  rig.run_v.Velocity = 100.0;
  rig.run_v.Execute = true;
  rig.run(2000);
  rig.halt.Execute = true;
  bool stood = false;
  ASSERT_TRUE(rig.run_until(
      [&] {
        if (rig.halt.Busy)
          stood = std::abs(rig.a.data.ActualVelocity) <= rig.a.data.StandstillSignal.VelocityThreshold;
        return rig.halt.Done;
      },
      4000));
  EXPECT_TRUE(stood);
}

TEST(TorqueLimiting, TakesItsDefaultAndChangesWithTheCall) {
  Press rig([](Axis& a) { a.data.TorqueLimiting.LimitDefaults.Torque = 7.0; });
  rig.limiting.Limit = -1.0;
  rig.limiting.Enable = true;
  rig.move.Execute = true;
  rig.run(4000);
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 7.0);
  rig.limiting.Limit = 3.5;
  rig.run(500);
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 3.5);
  rig.limiting.Limit = NAN;
  rig.run(10);
  EXPECT_TRUE(rig.limiting.Error);
  EXPECT_EQ(rig.limiting.ErrorID, static_cast<WORD>(ErrorId::torque_limit));
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 3.5) << "the last permitted limit goes on";
}

TEST(TorqueLimiting, AtTheLoadGoesThroughGearLeadScrewAndEfficiency) {
  Press rig([](Axis& a) {
    a.data.TorqueLimiting.LimitBase = 1;
    a.data.TorqueLimiting.LimitDefaults.Force = 1000.0;  // [N]
    a.data.LoadGear = {5, 1};
    a.data.Actor.Efficiency = 0.8;
    a.data.Mechanics.LeadScrew = 10.0;  // [mm]
    a.data.DynamicLimits.MaxAcceleration = 500.0;
  });
  rig.limiting.Limit = -1.0;
  rig.limiting.Enable = true;
  rig.move.Execute = true;
  rig.run(6000);
  EXPECT_NEAR(rig.a.data.StatusTorqueData.ActualTorque, 1000.0 * 0.010 / (2.0 * M_PI) / 5.0 / 0.8, 1e-9);
}

TEST(TorqueLimiting, IsOneFunctionOfOneInstance) {
  Press rig;
  auto& second = rig.block<MC_TorqueLimiting>();
  second.Axis = &rig.a;
  rig.limiting.Enable = true;
  rig.run(2);
  second.Enable = true;
  rig.run(2);
  EXPECT_TRUE(second.Error);
  EXPECT_EQ(second.ErrorID, static_cast<WORD>(ErrorId::one_instance_only));
  EXPECT_TRUE(rig.limiting.Busy);
  rig.limiting.Enable = false;
  rig.run(2);
  EXPECT_TRUE(second.Error) << "it needs a new edge";
  second.Enable = false;
  rig.run(1);
  second.Enable = true;
  rig.run(1);
  EXPECT_TRUE(second.Busy);
}

TEST(TorqueLimiting, OfAnAxisWithoutDriveIsRefused) {
  Rig rig;
  Axis& axis = rig.axis("Virtual");
  auto& limiting = rig.block<MC_TorqueLimiting>();
  auto& range = rig.block<MC_TorqueRange>();
  limiting.Axis = range.Axis = &axis;
  limiting.Enable = range.Enable = true;
  rig.run(2);
  EXPECT_EQ(limiting.ErrorID, static_cast<WORD>(ErrorId::no_torque_reduction));
  EXPECT_EQ(range.ErrorID, static_cast<WORD>(ErrorId::no_torque_data));
}

TEST(TorqueLimiting, NeedsAnEnabledAxisForTheFixedStopOnly) {
  Press rig;
  rig.power.Enable = false;
  rig.run(100);
  rig.limiting.Enable = true;
  rig.run(2);
  EXPECT_TRUE(rig.limiting.Busy);
  rig.limiting.Enable = false;
  rig.run(2);
  rig.limiting.Mode = 1;
  rig.limiting.Enable = true;
  rig.run(2);
  EXPECT_EQ(rig.limiting.ErrorID, static_cast<WORD>(ErrorId::locked));
}

// ---- Mode 1: the fixed stop
// --------------------------------------------------------------------------------------

TEST(FixedStop, EndsTheMotionAndClampsTheAxisWithTheFollowingErrorKept) {
  for (const int ratio : {1, 4}) {
    Press rig({}, ratio);
    rig.limiting.Mode = 1;
    rig.limiting.Enable = true;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.limiting.InClamping; }, 5000));
    EXPECT_TRUE(rig.move.CommandAborted);
    EXPECT_TRUE(bit(rig.a, StatusBit::InClamping));
    EXPECT_FALSE(rig.move.Error);
    const double frozen = rig.a.data.Position;
    rig.run(3000);
    EXPECT_EQ(rig.a.data.Position, frozen);
    EXPECT_EQ(rig.a.data.Velocity, 0.0);
    EXPECT_GT(rig.a.data.StatusPositioning.FollowingError, 1.9);
    EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 20.0);
    EXPECT_TRUE(rig.limiting.InClamping);
    EXPECT_TRUE(rig.limiting.InLimitation);
    EXPECT_EQ(rig.a.pending_alarm(), 0);
  }
}

TEST(FixedStop, OfANegativeMotionIsFoundAsWell) {
  Press rig([](Axis& a) { a.drive_settings.plant.stop = {-kStop, -1, kStiffness}; });
  rig.move.Position = -100.0;
  rig.clamp();
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, -20.0);
  rig.back.Distance = -1.0;
  rig.back.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.back.ErrorID, static_cast<WORD>(ErrorId::towards_fixed_stop));
}

TEST(FixedStop, LetsOnlyMotionsAwayFromItStart) {
  Press rig;
  rig.clamp();
  const auto refused = [&](auto& block, ErrorId error) {
    block.Execute = true;
    rig.run(2);
    EXPECT_TRUE(block.Error);
    EXPECT_EQ(block.ErrorID, static_cast<WORD>(error));
    block.Execute = false;
    rig.run(2);
    EXPECT_TRUE(rig.limiting.InClamping);
  };
  rig.back.Distance = 0.1;
  refused(rig.back, ErrorId::towards_fixed_stop);
  refused(rig.move, ErrorId::towards_fixed_stop);
  rig.run_v.Velocity = 5.0;
  refused(rig.run_v, ErrorId::towards_fixed_stop);
  rig.run_v.Velocity = -5.0;
  rig.run_v.PositionControlled = false;
  refused(rig.run_v, ErrorId::fixed_stop_position_control);
  rig.limiting.Enable = false;
  rig.run(2);
  EXPECT_TRUE(rig.limiting.Error);
  EXPECT_EQ(rig.limiting.ErrorID, static_cast<WORD>(ErrorId::clamping));
  EXPECT_TRUE(bit(rig.a, StatusBit::InClamping)) << "the function goes on";
  EXPECT_TRUE(rig.limiting.InClamping && rig.limiting.InLimitation) << "and says so";
  EXPECT_TRUE(rig.limiting.Busy);
  rig.limiting.Enable = true;
  rig.run(2);
  EXPECT_TRUE(rig.limiting.InClamping);
  rig.limiting.Limit = std::numeric_limits<double>::quiet_NaN();
  rig.run(2);
  EXPECT_TRUE(rig.limiting.Error);
  EXPECT_TRUE(bit(rig.a, StatusBit::InClamping));
  EXPECT_TRUE(rig.limiting.InClamping);
  EXPECT_TRUE(rig.limiting.Busy);
}

TEST(FixedStop, IsLeftByAMotionAwayFromItWithoutAnAlarm) {
  Press rig;
  rig.clamp();
  rig.back.Distance = -30.0;
  rig.back.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.back.Done; }, 5000));
  EXPECT_FALSE(rig.limiting.InClamping);
  EXPECT_TRUE(rig.limiting.Busy);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  rig.run(500);
  EXPECT_NEAR(rig.a.data.ActualPosition, rig.a.data.Position, 1e-3);
  rig.limiting.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.limiting.Error);
  EXPECT_FALSE(bit(rig.a, StatusBit::TorqueLimitingCommand));
  // And it can be found again.
  rig.back.Execute = false;
  rig.clamp();
}

/// The axis pushes already when the function is switched on.
TEST(FixedStop, IsNotFoundByAMotionThatBeginsAwayFromIt) {
  Press rig;
  rig.clamp();
  rig.limiting.Mode = 0;
  rig.run(10);
  ASSERT_FALSE(rig.limiting.InClamping);
  ASSERT_GT(rig.a.data.StatusPositioning.FollowingError, rig.a.data.Clamping.FollowingErrorDeviation);
  rig.limiting.Mode = 1;
  rig.run(10);
  EXPECT_FALSE(rig.limiting.InClamping) << "nothing moves";
  rig.back.Distance = -30.0;
  rig.back.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return !rig.back.Busy; }, 5000));
  EXPECT_TRUE(rig.back.Done);
  EXPECT_FALSE(rig.limiting.InClamping);
}

TEST(FixedStop, TurningTowardsItWhileClampedEndsTheJob) {
  Press rig;
  rig.clamp();
  rig.jog.Velocity = 1.0;
  rig.jog.JogBackward = true;
  rig.run(20);
  EXPECT_TRUE(rig.jog.Busy);
  EXPECT_TRUE(rig.limiting.InClamping);
  rig.jog.JogBackward = false;
  rig.jog.JogForward = true;
  rig.run(100);
  EXPECT_TRUE(rig.jog.Error);
  EXPECT_EQ(rig.jog.ErrorID, static_cast<WORD>(ErrorId::towards_fixed_stop));
  EXPECT_TRUE(rig.limiting.InClamping);
  EXPECT_EQ(rig.a.data.Velocity, 0.0);
}

TEST(FixedStop, ThatGivesWayRaisesAlarm542) {
  Press rig;
  rig.clamp();
  rig.limiting.Limit = 800.0;  // into the stop by 0.8, more than the tolerance
  rig.run(1000);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kClamping);
  EXPECT_FALSE(rig.limiting.InClamping);
  EXPECT_FALSE(rig.power.Status);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::UserFault));
}

TEST(FixedStop, EndsWithTheEnableOfTheAxis) {
  Press rig;
  rig.clamp();
  rig.power.Enable = false;
  rig.run(5);
  EXPECT_FALSE(rig.limiting.InClamping);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_TRUE(rig.limiting.Busy);
}

TEST(FixedStop, IsNotFoundByAMotionThatIsMerelyLate) {
  Press rig([](Axis& a) { a.drive_settings.plant.has_stop = false; });
  rig.limiting.Mode = 1;
  rig.limiting.Enable = true;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }, 5000));
  EXPECT_FALSE(rig.limiting.InClamping);
}

TEST(FixedStop, EndsAGearAsWell) {
  Press rig;
  auto& power = rig.block<MC_Power>();
  auto& lead = rig.block<MC_MoveVelocity>();
  auto& gear = rig.block<MC_GearIn>();
  power.Axis = lead.Axis = &rig.leading;
  power.Enable = true;
  gear.Master = &rig.leading;
  gear.Slave = &rig.a;
  lead.Velocity = 30.0;
  rig.run(5);
  lead.Execute = true;
  rig.limiting.Mode = 1;
  rig.limiting.Enable = true;
  gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.limiting.InClamping; }, 8000));
  EXPECT_TRUE(gear.CommandAborted);
  EXPECT_FALSE(bit(rig.a, StatusBit::Synchronous));
}

// ---- Torque data
// --------------------------------------------------------------------------------------------------

TEST(TorqueRange, KeepsBothLimitsAndExcludesTorqueLimiting) {
  Press rig;
  rig.range.UpperLimit = 12.0;
  rig.range.LowerLimit = -4.0;
  rig.range.Enable = true;
  rig.move.Execute = true;
  rig.run(4000);
  EXPECT_TRUE(rig.range.Busy);
  EXPECT_EQ(rig.a.data.StatusTorqueData.CommandTorqueRangeActive, 1);
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 12.0);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  rig.limiting.Enable = true;
  rig.run(2);
  EXPECT_EQ(rig.limiting.ErrorID, static_cast<WORD>(ErrorId::torque_limits_exclude));
  rig.limiting.Enable = false;
  rig.range.LowerLimit = 12.0;
  rig.run(2);
  EXPECT_EQ(rig.range.ErrorID, static_cast<WORD>(ErrorId::torque_limits_order));
  rig.range.Enable = false;
  rig.run(2);
  EXPECT_EQ(rig.a.data.StatusTorqueData.CommandTorqueRangeActive, 0);
  rig.limiting.Enable = true;
  rig.run(2);
  rig.range.LowerLimit = -12.0;
  rig.range.Enable = true;
  rig.run(2);
  EXPECT_EQ(rig.range.ErrorID, static_cast<WORD>(ErrorId::torque_limits_exclude));
}

TEST(TorqueRange, OfAMotorThatTurnsTheOtherWayRoundIsSwappedAndInverted) {
  Press rig([](Axis& a) {
    a.drive_settings.inverted = true;
    a.data.Actor.InverseDirection = true;
    a.data.Sensor[0].InverseDirection = true;
  });
  rig.range.UpperLimit = 12.0;
  rig.range.LowerLimit = -4.0;
  rig.range.Enable = true;
  rig.move.Execute = true;
  rig.run(4000);
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 12.0);
}

TEST(TorqueAdditive, CountsWhileTheAxisIsEnabled) {
  Press rig([](Axis& a) { a.drive_settings.plant.load_torque = -5.0; });
  rig.additive.Value = 5.0;
  rig.additive.Enable = true;
  rig.run(1000);
  EXPECT_TRUE(rig.additive.Busy);
  EXPECT_EQ(rig.a.data.StatusTorqueData.CommandAdditiveTorqueActive, 1);
  EXPECT_NEAR(rig.a.data.StatusTorqueData.ActualTorque, 5.0, 1e-6);
  rig.power.Enable = false;
  rig.run(200);
  EXPECT_TRUE(rig.additive.Error);
  EXPECT_EQ(rig.additive.ErrorID, static_cast<WORD>(ErrorId::locked));
  EXPECT_TRUE(rig.additive.Busy) << "it counts again by itself";
  rig.additive.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.additive.Busy);
  EXPECT_EQ(rig.a.data.StatusTorqueData.CommandAdditiveTorqueActive, 0);
}

TEST(TorqueData, HasToBeConfigured) {
  Press rig([](Axis& a) { a.data.Actor.Interface.EnableTorqueData = false; });
  rig.additive.Enable = rig.range.Enable = true;
  rig.move.Execute = true;
  rig.run(500);
  EXPECT_EQ(rig.additive.ErrorID, static_cast<WORD>(ErrorId::no_torque_data));
  EXPECT_EQ(rig.range.ErrorID, static_cast<WORD>(ErrorId::no_torque_data));
  EXPECT_EQ(rig.a.data.StatusTorqueData.ActualTorque, 0.0);
}

}  // namespace
}  // namespace lockstep::torque_test
