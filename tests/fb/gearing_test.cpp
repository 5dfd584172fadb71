// Gearing on virtual axes, through MC_GearIn.
#include <gtest/gtest.h>

#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/motion_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/fb/gear_pair.hpp"

namespace lockstep::gearing_test {
namespace {

using test::bit;
using test::GearPair;
using test::Rig;

TEST(MC_GearIn, SynchronizesToAMovingLeadingAxisAndThenKeepsTheRatioExactly) {
  GearPair rig;
  rig.continuity[1].highest_acceleration = 1000.0;
  rig.continuity[1].highest_jerk = 10000.0;
  rig.start_leading(50.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_l.InVelocity; }));
  rig.gear.RatioNumerator = -3;
  rig.gear.RatioDenominator = 2;
  rig.gear.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.gear.Busy);
  EXPECT_FALSE(rig.gear.InGear);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronizing));
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.FunctionState, 1);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.ActualMaster, rig.l.number);
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  EXPECT_FALSE(bit(rig.f, StatusBit::Synchronizing));
  const double l0 = rig.l.setpoint().position.value;
  const double f0 = rig.f.setpoint().position.value;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.following_minus_function(-3, 2, l0, f0), 0.0, 1e-11);
    ASSERT_EQ(rig.f.data.Velocity, -1.5 * rig.l.data.Velocity);
  }
}

TEST(MC_GearIn, IsAtOnceInGearWhenBothAxesStand) {
  GearPair rig;
  rig.gear.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.gear.InGear);
}

TEST(MC_GearIn, FollowsAccelerationAndStandstillOfTheLeadingAxisInTheSameTick) {
  GearPair rig;
  rig.gear.RatioNumerator = 5;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.start_leading(80.0);
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    ASSERT_EQ(rig.f.data.Position, 5.0 * rig.l.data.Position);
    ASSERT_EQ(rig.f.data.Acceleration, 5.0 * rig.l.data.Acceleration);
  }
}

TEST(MC_GearIn, IgnoresTheOverrideOfTheFollowingAxisWhichCountsForItsOwnMotionOnly) {
  GearPair plain;
  GearPair slowed;
  slowed.f.data.Override.Velocity = 20.0;
  for (GearPair* const rig : {&plain, &slowed}) {
    rig->start_leading(50.0);
    rig->gear.RatioNumerator = 3;
    rig->gear.Execute = true;
  }
  for (int i = 0; i < 2000; ++i) {
    plain.tick();
    slowed.tick();
    if (i == 1000) slowed.f.data.Override.Velocity = 0.0;
    ASSERT_EQ(slowed.f.data.Position, plain.f.data.Position) << "tick " << i;
  }
  EXPECT_TRUE(slowed.gear.InGear);
  EXPECT_EQ(slowed.f.data.Velocity, 150.0);
}

TEST(MC_GearInPos, IgnoresTheOverrideOfTheFollowingAxisWhileItSynchronizesToo) {
  GearPair plain;
  GearPair slowed;
  slowed.f.data.Override.Velocity = 20.0;
  for (GearPair* const rig : {&plain, &slowed}) {
    rig->pos.MasterSyncPosition = 100.0;
    rig->pos.SlaveSyncPosition = 80.0;
    rig->pos.SyncProfileReference = 1;
    rig->pos.MasterStartDistance = 60.0;
    rig->pos.Execute = true;
    rig->start_leading(50.0);
  }
  bool synchronized_in_motion = false;
  for (int i = 0; i < 4000; ++i) {
    plain.tick();
    slowed.tick();
    ASSERT_EQ(slowed.f.data.Position, plain.f.data.Position) << "tick " << i;
    synchronized_in_motion |= bit(slowed.f, StatusBit::Synchronizing) && slowed.f.data.Velocity != 0.0;
  }
  EXPECT_TRUE(synchronized_in_motion);
  EXPECT_TRUE(slowed.pos.InSync);
}

/// Function diagram GearIn-1: a second job with another leading axis overrides the first.
TEST(MC_GearIn, SwitchesTheLeadingValueOnTheFly) {
  Rig rig;
  Axis& one = rig.axis("One");
  Axis& two = rig.axis("Two");
  Axis& f = rig.axis("Following");
  rig.lead(f, one);
  rig.lead(f, two);
  for (Axis* axis : {&one, &two, &f}) {
    auto& power = rig.block<MC_Power>();
    power.Axis = axis;
    power.Enable = true;
  }
  auto& run_one = rig.block<MC_MoveVelocity>();
  auto& run_two = rig.block<MC_MoveVelocity>();
  run_one.Axis = &one;
  run_two.Axis = &two;
  run_one.Velocity = 30.0;
  run_two.Velocity = 70.0;
  auto& a1 = rig.block<MC_GearIn>();
  auto& a2 = rig.block<MC_GearIn>();
  a1.Master = &one;
  a2.Master = &two;
  a1.Slave = a2.Slave = &f;
  rig.run(3);
  run_one.Execute = run_two.Execute = true;
  rig.run(500);

  a1.Execute = true;
  rig.run(2);
  EXPECT_TRUE(a1.Busy);
  EXPECT_FALSE(a1.InGear);
  EXPECT_TRUE(bit(f, StatusBit::Synchronizing));
  EXPECT_EQ(f.data.StatusSynchronizedMotion.FunctionState, 1);
  EXPECT_EQ(f.data.StatusSynchronizedMotion.ActualMaster, one.number);
  ASSERT_TRUE(rig.run_until([&] { return a1.InGear; }));
  EXPECT_TRUE(bit(f, StatusBit::Synchronous));
  EXPECT_FALSE(bit(f, StatusBit::Synchronizing));

  a2.Execute = true;
  rig.run(2);
  EXPECT_TRUE(a1.CommandAborted);
  EXPECT_FALSE(a1.InGear);
  EXPECT_FALSE(a1.Busy);
  EXPECT_TRUE(a2.Busy);
  EXPECT_FALSE(a2.InGear);
  EXPECT_TRUE(bit(f, StatusBit::Synchronizing));
  EXPECT_FALSE(bit(f, StatusBit::Synchronous));
  EXPECT_EQ(f.data.StatusSynchronizedMotion.ActualMaster, two.number);
  ASSERT_TRUE(rig.run_until([&] { return a2.InGear; }));
  EXPECT_TRUE(bit(f, StatusBit::Synchronous));
  EXPECT_EQ(f.data.Velocity, 70.0);
}

TEST(MC_GearIn, ReversalWhileSynchronizingRaisesAlarm608AndStopsWithMaximumDynamics) {
  GearPair rig;
  rig.start_leading(500.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_l.InVelocity; }));
  rig.gear.Acceleration = 100.0;
  rig.gear.Execute = true;
  rig.run(100);
  rig.start_leading(-500.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.Error; }));
  EXPECT_EQ(rig.gear.ErrorID, static_cast<WORD>(0x8001));
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 608u);
  EXPECT_EQ(rig.f.data.ErrorDetail.Reaction, 2);
  EXPECT_TRUE(has_bit(rig.f.data.ErrorWord, 14));
  ASSERT_TRUE(rig.run_until([&] { return rig.f.data.Velocity == 0.0; }));
}

TEST(MC_GearIn, RejectsARatioThatIsNotPermitted) {
  GearPair rig;
  rig.gear.RatioNumerator = 0;
  rig.gear.Execute = true;
  rig.run(1);
  EXPECT_EQ(rig.gear.ErrorID, static_cast<WORD>(0x8017));
  rig.gear.Execute = false;
  rig.run(1);
  rig.gear.RatioNumerator = 1;
  rig.gear.RatioDenominator = -2;
  rig.gear.Execute = true;
  rig.run(1);
  EXPECT_EQ(rig.gear.ErrorID, static_cast<WORD>(0x8018));
}

TEST(MC_GearIn, ALeadingAxisThatIsNotInterconnectedShowsInErrorWord) {
  GearPair rig;
  rig.f.leading_values.clear();
  rig.gear.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.gear.Error);
  EXPECT_TRUE(has_bit(rig.f.data.ErrorWord, ErrorBit::SynchronousError));
}

TEST(MC_GearIn, ARecursiveCouplingIsRejectedWhenItWouldBecomeEffective) {
  GearPair rig;
  rig.lead(rig.l, rig.f);
  auto& back = rig.block<MC_GearIn>();
  back.Master = &rig.f;
  back.Slave = &rig.l;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  back.Execute = true;
  rig.run(2);
  EXPECT_EQ(back.ErrorID, static_cast<WORD>(0x8019));
  EXPECT_TRUE(rig.gear.InGear);
}

TEST(MC_GearIn, DisablingTheFollowingAxisAbortsDisablingTheLeadingOneDoesNot) {
  GearPair rig;
  rig.continuity[0].acceleration = rig.continuity[1].acceleration = false;
  rig.start_leading(50.0);
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.power_l.Enable = false;
  ASSERT_TRUE(rig.run_until([&] { return !rig.power_l.Busy; }));
  EXPECT_TRUE(rig.gear.InGear);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  rig.power_f.Enable = false;
  rig.run(2);
  EXPECT_TRUE(rig.gear.CommandAborted);
}

TEST(MC_GearIn, ChainsFollowInTheSameTickWhateverTheOrderOfTheObjects) {
  Rig rig;
  Axis& last = rig.axis("Last");
  Axis& middle = rig.axis("Middle");
  Axis& first = rig.axis("First");
  rig.lead(last, middle);
  rig.lead(middle, first);
  for (Axis* axis : {&first, &middle, &last}) {
    auto& power = rig.block<MC_Power>();
    power.Axis = axis;
    power.Enable = true;
  }
  auto& g1 = rig.block<MC_GearIn>();
  auto& g2 = rig.block<MC_GearIn>();
  auto& run = rig.block<MC_MoveVelocity>();
  g1.Master = &first;
  g1.Slave = &middle;
  g2.Master = &middle;
  g2.Slave = &last;
  g1.RatioNumerator = 2;
  g2.RatioNumerator = 3;
  run.Axis = &first;
  rig.run(3);
  g1.Execute = g2.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return g1.InGear && g2.InGear; }));
  run.Execute = true;
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    ASSERT_EQ(last.data.Position, 6.0 * first.data.Position);
  }
}

TEST(MC_GearIn, HomingTheFollowingAxisRenamesItsPositionWithoutMotion) {
  GearPair rig;
  rig.start_leading(50.0);
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear && rig.run_l.InVelocity; }));
  rig.home_f.Execute = false;
  rig.run(2);
  rig.continuity[1].velocity = false;
  rig.home_f.Position = 5000.0;
  rig.home_f.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.home_f.Done);
  EXPECT_TRUE(rig.gear.InGear);
  const double renamed = rig.f.data.Position;
  EXPECT_GE(renamed, 5000.0);
  EXPECT_LE(renamed, 5000.2);
  EXPECT_EQ(rig.f.data.Velocity, 50.0);
  rig.continuity[1].velocity = true;
  rig.run(100);
  EXPECT_NEAR(rig.f.data.Position, renamed + 5.0, 1e-9);
}

/// What led the axis until then may have had any acceleration; its jerk alone would take seconds to run it
/// down.
TEST(MC_GearIn, DropsAnAccelerationThatWouldCarryTheAxisBeyondItsVelocityLimit) {
  for (const bool velocity_only : {false, true}) {
    GearPair rig;
    auto& given = rig.block<MC_MotionInVelocity>();
    auto& follow = rig.block<MC_GearInVelocity>();
    given.Axis = &rig.f;
    follow.Master = &rig.l;
    follow.Slave = &rig.f;
    rig.start_leading(20.0);
    given.Velocity = 40.0;
    given.Acceleration = 1e5;
    given.Enable = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.f.setpoint().velocity == 40.0; }));
    (velocity_only ? follow.Execute : rig.gear.Execute) = true;
    ASSERT_TRUE(rig.run_until([&] {
      EXPECT_LE(rig.f.setpoint().velocity, rig.f.data.DynamicLimits.MaxVelocity);
      return velocity_only ? static_cast<bool>(follow.InSync) : static_cast<bool>(rig.gear.InGear);
    }));
    EXPECT_TRUE(given.CommandAborted);
  }
}

}  // namespace
}  // namespace lockstep::gearing_test
