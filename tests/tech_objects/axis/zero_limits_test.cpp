// Limits of the dynamics that are zero: before a job, and written while one moves the axis. No motion can
// keep them: alarms 304, 305, 306, and the emergency ramp.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::zero_limits_test {
namespace {

using test::Rig;
using Limits = TO_Struct_DynamicLimits;

/// A homed axis, and one that may lead it.
struct Machine : Rig {
  Machine()
      : leading(axis("Leading")),
        a(axis("Axis",
               [](AxisData& data) {
                 data.DynamicLimits = {500.0, 500.0, 5000.0, 5000.0, 100000.0};
                 data.PositioningMonitoring.MinDwellTime = 0.0;
               })),
        power_leading(block<MC_Power>()),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        run_leading(block<MC_MoveVelocity>()),
        run_v(block<MC_MoveVelocity>()),
        move(block<MC_MoveRelative>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()),
        stop(block<MC_Stop>()),
        superimposed(block<MC_MoveSuperimposed>()),
        gear(block<MC_GearIn>()),
        gear_in_pos(block<MC_GearInPos>()),
        gear_out(block<MC_GearOut>()) {
    lead(a, leading);
    power_leading.Axis = run_leading.Axis = &leading;
    power.Axis = run_v.Axis = move.Axis = jog.Axis = halt.Axis = stop.Axis = superimposed.Axis = &a;
    home.Axis = &a;
    gear.Master = gear_in_pos.Master = &leading;
    gear.Slave = gear_in_pos.Slave = gear_out.Slave = &a;
    power_leading.Enable = power.Enable = true;
    run(5);
    home.Execute = true;
    run(5);
    a.alarm_notes.acknowledged();
  }

  const Setpoint& now() const { return a.setpoint(); }

  /// The alarm has come with the emergency ramp, which has no jerk limit, and the axis comes to rest by it.
  void expect_emergency(int number) {
    EXPECT_EQ(a.pending_alarm(), number);
    EXPECT_EQ(a.data.ErrorDetail.Reaction, 3);
    EXPECT_TRUE(has_bit(a.data.ErrorWord, ErrorBit::UserFault));
    ASSERT_TRUE(run_until([this] { return now().standing(); }));
  }

  Axis& leading;
  Axis& a;
  MC_Power& power_leading;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run_leading;
  MC_MoveVelocity& run_v;
  MC_MoveRelative& move;
  MC_MoveJog& jog;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_MoveSuperimposed& superimposed;
  MC_GearIn& gear;
  MC_GearInPos& gear_in_pos;
  MC_GearOut& gear_out;
};

// ---- Before a job

TEST(ZeroLimit, OfTheJerkRaisesAlarm306WithAJobThatLimitsItsJerk) {
  Machine m;
  m.a.data.DynamicLimits.MaxJerk = 0.0;
  m.run_v.Velocity = 10.0;  // Jerk: DynamicDefaults.Jerk, 10,000 u/s³
  m.run_v.Execute = true;
  m.run(3);
  EXPECT_EQ(m.run_v.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  m.expect_emergency(alarm::kJerkLimitZero);
  EXPECT_EQ(m.a.data.Velocity, 0.0);
}

TEST(ZeroLimit, OfTheJerkDoesNotCountForAJobWithoutJerkLimit) {
  Machine m;
  m.continuity[1].acceleration = false;
  m.a.data.DynamicLimits.MaxJerk = 0.0;
  m.run_v.Velocity = 10.0;
  m.run_v.Jerk = 0.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  EXPECT_EQ(m.a.pending_alarm(), 0);
}

TEST(ZeroLimit, OfTheJerkCountsForCouplingsThatArePlannedWithTheirDynamics) {
  for (int kind = 0; kind < 3; ++kind) {
    Machine m;
    m.a.data.DynamicLimits.MaxJerk = 0.0;
    m.gear.Execute = kind == 0;
    m.gear_in_pos.SyncProfileReference = 0;
    m.gear_in_pos.Execute = kind == 1;
    m.superimposed.Distance = 5.0;
    m.superimposed.Execute = kind == 2;
    m.run(3);
    const WORD shown[] = {m.gear.ErrorID, m.gear_in_pos.ErrorID, m.superimposed.ErrorID};
    EXPECT_EQ(shown[kind], static_cast<WORD>(ErrorId::technology_alarm)) << kind;
    m.expect_emergency(alarm::kJerkLimitZero);
  }
}

TEST(ZeroLimit, OfTheJerkLeavesMC_StopItsEmergencyRamp) {
  Machine m;
  m.continuity[1].acceleration = false;
  m.run_v.Velocity = 100.0;
  m.run_v.Jerk = 0.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.a.data.DynamicLimits.MaxJerk = 0.0;
  m.stop.Mode = 0;
  m.stop.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.stop.Done; }));
  EXPECT_EQ(m.a.pending_alarm(), 0);
  EXPECT_TRUE(m.now().standing());
}

// ---- In motion

using Change = std::function<void(Limits&)>;
struct Zero {
  Change change;
  int number;
};
const Zero kZeros[] = {{[](Limits& limits) { limits.Velocity = 0.0; }, alarm::kVelocityLimitZero},
                       {[](Limits& limits) { limits.MaxAcceleration = 0.0; }, alarm::kAccelerationLimitZero},
                       {[](Limits& limits) { limits.MaxDeceleration = 0.0; }, alarm::kAccelerationLimitZero},
                       {[](Limits& limits) { limits.MaxJerk = 0.0; }, alarm::kJerkLimitZero}};

TEST(ZeroLimit, WrittenInMotionStopsThatWithItsAlarm) {
  using Start = void (*)(Machine&);
  const Start motions[] = {[](Machine& m) {
                             m.run_v.Velocity = 100.0;
                             m.run_v.Execute = true;
                           },
                           [](Machine& m) {
                             m.move.Distance = 1000.0;
                             m.move.Execute = true;
                           },
                           [](Machine& m) {
                             m.jog.Velocity = 100.0;
                             m.jog.JogForward = true;
                           },
                           [](Machine& m) {
                             m.superimposed.Distance = 1000.0;
                             m.superimposed.Execute = true;
                           },
                           [](Machine& m) {
                             m.run_v.Velocity = -50.0;
                             m.run_v.Execute = true;
                             m.superimposed.Distance = 1000.0;
                             m.superimposed.Jerk = 30000.0;
                             m.superimposed.Execute = true;
                           }};
  for (const Zero& zero : kZeros)
    for (std::size_t motion = 0; motion < std::size(motions); ++motion) {
      SCOPED_TRACE(testing::Message() << "alarm " << zero.number << ", motion " << motion);
      Machine m;
      m.continuity[1].acceleration = false;  // the emergency ramp has no jerk limit
      motions[motion](m);
      m.run(60);
      ASSERT_NE(m.now().velocity, 0.0);
      ASSERT_NE(m.now().acceleration, 0.0);
      zero.change(m.a.data.DynamicLimits);
      const double before = m.now().velocity;
      m.run(3);
      EXPECT_LT(std::abs(m.now().velocity), std::abs(before));
      m.expect_emergency(zero.number);
      const bool error = m.run_v.Error || m.move.Error || m.jog.Error || m.superimposed.Error;
      EXPECT_TRUE(error);
    }
}

TEST(ZeroLimit, WrittenWhileAHaltBrakesLeavesItAsItWasBegun) {
  for (const Zero& zero : kZeros) {
    Machine m;
    m.continuity[1].highest_jerk = 10000.0;
    m.run_v.Velocity = 300.0;
    m.run_v.Execute = true;
    ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
    m.halt.Execute = true;
    m.run(30);
    zero.change(m.a.data.DynamicLimits);
    ASSERT_TRUE(m.run_until([&] { return m.halt.Done; })) << zero.number;
    EXPECT_EQ(m.a.pending_alarm(), 0);
  }
}

TEST(ZeroLimit, WrittenWhileMC_GearOutWaitsStopsTheGearWithItsAlarm) {
  for (const Zero& zero : kZeros) {
    Machine m;
    m.continuity[1].acceleration = false;
    m.gear.Execute = true;
    m.run(5);
    m.run_leading.Velocity = 50.0;
    m.run_leading.Execute = true;
    ASSERT_TRUE(m.run_until([&] { return m.gear.InGear && m.run_leading.InVelocity; }));
    m.gear_out.SyncProfileReference = 0;
    m.gear_out.SlavePosition = 1000.0;
    m.gear_out.Execute = true;
    m.run(50);
    ASSERT_TRUE(m.gear_out.Busy);
    EXPECT_EQ(m.a.pending_alarm(), 0);
    zero.change(m.a.data.DynamicLimits);
    m.run(3);
    EXPECT_TRUE(m.gear_out.Error) << zero.number;
    m.expect_emergency(zero.number);
  }
}

TEST(ZeroLimit, DoesNotStopAGear) {
  for (const Zero& zero : kZeros) {
    Machine m;
    m.gear.Execute = true;
    m.run(5);
    m.run_leading.Velocity = 50.0;
    m.run_leading.Execute = true;
    ASSERT_TRUE(m.run_until([&] { return m.gear.InGear && m.run_leading.InVelocity; }));
    zero.change(m.a.data.DynamicLimits);
    m.run(100);
    EXPECT_EQ(m.a.data.Velocity, 50.0);
    EXPECT_EQ(m.a.pending_alarm(), 0) << "a synchronous motion is not limited by them";
  }
}

/// The step that was seen: 1,000 u/s² in a millisecond.
TEST(ZeroLimit, OfTheJerkTakesNoMotionItsJerkBeforeTheAlarm) {
  Machine m;
  m.move.Distance = 1000.0;
  m.move.Velocity = 300.0;
  m.move.Acceleration = m.move.Deceleration = 1000.0;
  m.move.Jerk = 10000.0;
  m.move.Execute = true;
  m.run(20);
  const double before = m.now().acceleration;
  ASSERT_GT(before, 0.0);
  ASSERT_LT(before, 500.0);
  m.continuity[1].acceleration = false;
  m.a.data.DynamicLimits.MaxJerk = 0.0;
  m.tick();
  EXPECT_LE(m.now().acceleration, 0.0) << "it does not go on with its acceleration at once";
  m.expect_emergency(alarm::kJerkLimitZero);
}

}  // namespace
}  // namespace lockstep::zero_limits_test
