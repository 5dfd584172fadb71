// Superimposed motion on the bench: on top of no motion, of a single-axis motion and of a gear.
#include "fb/superimposed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "fb/leading_value.hpp"
#include "tests/support/property.hpp"
#include "tests/support/superimposing.hpp"

namespace lockstep::superimposed_test {
namespace {

using Machine = test::Superimposing;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double ulp(double value) {
  return std::nextafter(std::abs(value), std::numeric_limits<double>::infinity()) - std::abs(value);
}

// ---- MC_MoveSuperimposed on motions of the axis' own
// --------------------------------------------------------------------------

TEST(MC_MoveSuperimposed, RunsLikeARelativePositioningWithoutABaseMotion) {
  Machine m;
  m.move.Distance = 12.5;
  m.move.Execute = true;
  m.run(10);
  EXPECT_TRUE(m.move.Busy);
  EXPECT_TRUE(m.shows(StatusBit::MoveSuperimposedCommand));
  EXPECT_FALSE(m.shows(StatusBit::Done));
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  m.run(2);
  EXPECT_EQ(m.position(), 12.5);
  EXPECT_TRUE(m.resting());
  EXPECT_FALSE(m.shows(StatusBit::MoveSuperimposedCommand));
  EXPECT_EQ(m.superimposed(), 0.0) << "base and superimposed motion are both complete";
}

TEST(MC_MoveSuperimposed, IsAddedToAnEndlessMotionThatGoesOn) {
  Machine m, without;
  m.run_at(100.0);
  without.run_at(100.0);
  const double ahead = m.position() - without.position();
  EXPECT_EQ(ahead, 0.0);
  m.move.Distance = -30.0;
  m.move.VelocityDiff = 40.0;
  m.move.Execute = true;
  double slowest = 100.0;
  for (int i = 0; i < 3000 && !m.move.Done; ++i) {
    m.tick();
    without.tick();
    slowest = std::min(slowest, m.velocity());
    EXPECT_TRUE(m.run_velocity.InVelocity);
    if (i < 2) continue;
    ASSERT_NEAR(without.position() - m.position(), m.superimposed(), 1e-9) << i;
  }
  EXPECT_TRUE(m.move.Done);
  EXPECT_NEAR(slowest, 60.0, 1e-9);
  EXPECT_NEAR(m.position() - without.position(), -30.0, 4 * ulp(without.position()));
  EXPECT_EQ(m.velocity(), 100.0);
  EXPECT_EQ(m.superimposed(), 30.0) << "until the base motion ends as well";
}

TEST(MC_MoveSuperimposed, AddsUpExactlyOverManyDistances) {
  Machine m;
  m.run_at(1.0);
  m.continuity[1].acceleration = false;
  m.move.Acceleration = m.move.Deceleration = 5000.0;
  m.move.Jerk = 0.0;
  __extension__ __float128 sum = 0;
  for (int i = 0; i < 50; ++i) {
    m.move.Distance = 0.1;
    m.move.Execute = true;
    ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
    m.move.Execute = false;
    m.run(1);
    sum += 0.1;
  }
  EXPECT_EQ(m.superimposed(), static_cast<double>(sum));
}

TEST(MC_MoveSuperimposed, EndsByItselfAndSoDoesThePositioningBelowIt) {
  for (const double distance : {20.0, 400.0, -400.0}) {
    Machine m;
    m.absolute.Position = 100.0;
    m.absolute.Execute = true;
    m.run(20);
    m.move.Distance = distance;
    m.move.Execute = true;
    bool base_first = false;
    ASSERT_TRUE(m.run_until([&] {
      base_first |= m.absolute.Done && m.move.Busy;
      return m.absolute.Done && m.move.Done;
    }));
    EXPECT_EQ(base_first, std::abs(distance) > 100.0);
    m.run(2);
    EXPECT_EQ(m.position(), 100.0 + distance);
    EXPECT_EQ(m.superimposed(), 0.0);
    EXPECT_EQ(m.axis_.data.ErrorDetail.Number, 0u);
  }
}

TEST(MC_MoveSuperimposed, CountsAFurtherDistanceFromThePresentPoint) {
  Machine m;
  m.run_at(10.0);
  auto& second = m.block<MC_MoveSuperimposed>();
  second.Axis = &m.axis_;
  m.move.Distance = 100.0;
  m.move.Execute = true;
  m.run(200);
  second.Distance = 50.0;
  second.Execute = true;
  m.run(1);
  const double here = m.superimposed();  // the new job starts here, with the next tick
  m.run(1);
  EXPECT_TRUE(m.move.CommandAborted);
  EXPECT_TRUE(second.Busy);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_NEAR(m.superimposed(), here + 50.0, 1e-12);
}

/// The sum is limited, and the superimposed motion gets what the base motion leaves; the rig checks sum of
/// accelerations and jerks.
TEST(MC_MoveSuperimposed, KeepsTheSumWithinTheLimits) {
  Machine m;
  for (test::Continuity& rule : m.continuity) rule = {true, true, 1000.0, 20000.0};
  m.axis_.data.DynamicLimits = {150.0, 150.0, 1000.0, 1000.0, 20000.0};
  m.relative.Distance = 150.0;
  m.relative.Velocity = 100.0;
  m.relative.Acceleration = m.relative.Deceleration = 800.0;
  m.relative.Jerk = 15000.0;
  m.relative.Execute = true;
  m.run(5);
  m.move.Distance = 60.0;
  m.move.VelocityDiff = 150.0;
  m.move.Acceleration = m.move.Deceleration = 1000.0;
  m.move.Jerk = 20000.0;
  m.move.Execute = true;
  double fastest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    fastest = std::max(fastest, m.velocity());
    return m.relative.Done && m.move.Done;
  }));
  EXPECT_LE(fastest, 150.0 * (1 + 1e-12));
  EXPECT_GT(fastest, 149.0) << "it uses what is left";
  m.run(2);
  EXPECT_EQ(m.position(), 210.0);
}

TEST(MC_MoveSuperimposed, WaitsWhileTheBaseMotionLeavesNothing) {
  Machine m;
  m.relative.Distance = 300.0;
  m.relative.Velocity = 500.0;
  m.relative.Acceleration = m.relative.Deceleration = 5000.0;
  m.relative.Jerk = 100000.0;
  m.relative.Execute = true;
  m.run(5);
  m.move.Distance = 60.0;
  m.move.Execute = true;
  m.run(10);
  EXPECT_TRUE(m.move.Busy);
  EXPECT_EQ(m.superimposed(), 0.0);
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  m.run(2);
  EXPECT_TRUE(m.relative.Done);
  EXPECT_EQ(m.position(), 360.0);
}

/// An axis at its velocity limit can still become slower.
TEST(MC_MoveSuperimposed, DoesNotWaitAgainstABaseMotionAtTheVelocityLimit) {
  for (const double side : {1.0, -1.0}) {
    Machine m;
    m.continuity[1].acceleration = false;
    m.run_at(side * 500.0);
    m.move.Distance = -side * 60.0;
    m.move.VelocityDiff = 200.0;
    m.move.Acceleration = m.move.Deceleration = 2000.0;
    m.move.Jerk = 0.0;
    m.move.Execute = true;
    m.run(200);
    EXPECT_NEAR(m.velocity(), side * 300.0, 1e-9);
    // Planned anew, the base motion keeps what it has.
    m.axis_.data.Override.Velocity = 90.0;
    m.run(100);
    EXPECT_NEAR(m.velocity(), side * (450.0 - 180.0), 1e-9);
    ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
    m.run(100);
    EXPECT_EQ(m.superimposed(), 60.0);
    EXPECT_NEAR(m.velocity(), side * 450.0, 1e-9);
  }
}

/// A jog that turns round is left what the superimposed motion, now in its direction, does not use.
TEST(MC_MoveSuperimposed, AgainstAJogKeepsTheLimitWhenThatTurnsRound) {
  Machine m;
  m.jog.Velocity = 500.0;
  m.jog.Acceleration = m.jog.Deceleration = 2500.0;
  m.jog.JogForward = true;
  m.run(400);
  m.move.Distance = -600.0;
  m.move.VelocityDiff = 300.0;
  m.move.Execute = true;
  m.run(300);
  EXPECT_LT(m.velocity(), 400.0);
  m.jog.JogForward = false;
  m.jog.JogBackward = true;
  double fastest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    fastest = std::max(fastest, std::abs(m.velocity()));
    return m.move.Done;
  }));
  EXPECT_LE(fastest, 500.0 * (1 + 1e-12));
  EXPECT_GT(fastest, 499.0) << "and uses it";
  m.run(700);
  EXPECT_NEAR(m.velocity(), -500.0, 1e-9);
}

TEST(MC_MoveSuperimposed, FollowsTheOverrideWithinTheLimits) {
  Machine m;
  m.run_at(200.0);
  m.move.Distance = 500.0;
  m.move.VelocityDiff = 250.0;
  m.move.Execute = true;
  m.run(700);
  EXPECT_NEAR(m.velocity(), 450.0, 1e-9);
  m.axis_.data.Override.Velocity = 0.0;
  m.run(700);
  EXPECT_TRUE(m.resting());
  EXPECT_TRUE(m.move.Busy);
  m.axis_.data.Override.Velocity = 200.0;
  double fastest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    fastest = std::max(fastest, m.velocity());
    return m.move.Done;
  }));
  EXPECT_LE(fastest, 500.0 * (1 + 1e-12));
  EXPECT_EQ(m.superimposed(), 500.0);
  m.run(700);
  EXPECT_NEAR(m.velocity(), 400.0, 1e-9) << "the base motion has again what was left to the other";
}

TEST(MC_MoveSuperimposed, GoesOverIntoTheMotionThatEndsBoth) {
  for (int distance = 0; distance < 4; ++distance) {
    Machine m;
    m.run_at(100.0);
    m.move.Distance = 1000.0;
    m.move.Execute = true;
    m.run(60);
    const Setpoint before = m.axis_.setpoint();
    EXPECT_GT(before.velocity, 110.0);
    EXPECT_NE(before.acceleration, 0.0) << "in the middle of it, so that a step would show";
    if (distance == 0) m.relative.Distance = 300.0, m.relative.Execute = true;
    if (distance == 1) m.halt.Execute = true;
    if (distance == 2) m.stop.Execute = true, m.stop.Mode = 2;
    if (distance == 3) m.jog.JogBackward = true;
    m.run(2);
    EXPECT_TRUE(m.move.CommandAborted);
    EXPECT_TRUE(m.run_velocity.CommandAborted);
    EXPECT_FALSE(m.shows(StatusBit::MoveSuperimposedCommand));
    EXPECT_EQ(m.superimposed(), 0.0);
    m.run(5000);
    EXPECT_EQ(m.resting(), distance != 3);
    EXPECT_TRUE(distance != 0 || m.position() == m.axis_.data.StatusPositioning.TargetPosition);
  }
}

TEST(MC_MoveSuperimposed, EndsWithTheEnableAndByAnAlarmFromTheWholeVelocity) {
  for (const bool alarm : {false, true}) {
    Machine m;
    m.run_at(100.0);
    m.move.Distance = 1000.0;
    m.move.Execute = true;
    m.run(400);
    const double fast = m.velocity();
    EXPECT_NEAR(fast, 200.0, 1e-9);
    m.continuity[1].acceleration = false;  // the emergency ramp has no jerk limit
    m.axis_.data.DynamicDefaults.EmergencyDeceleration = 5000.0;
    if (alarm) {
      m.axis_.raise(alarm::kVelocityLimitZero);
    } else {
      m.power.StopMode = 2;
      m.power.Enable = false;
    }
    ASSERT_TRUE(m.run_until([&] { return m.resting(); }));
    EXPECT_EQ(m.move.CommandAborted, !alarm);
    EXPECT_EQ(m.move.Error, alarm);
    EXPECT_EQ(m.superimposed(), 0.0);
  }
}

TEST(MC_MoveSuperimposed, IsHeldBySoftwareLimitsInAll) {
  Machine m;
  m.axis_.data.PositionLimits_SW = {};
  m.axis_.data.PositionLimits_SW.Active = true;
  m.axis_.data.PositionLimits_SW.MinPosition = -1000.0;
  m.axis_.data.PositionLimits_SW.MaxPosition = 150.0;
  m.absolute.Position = 100.0;
  m.absolute.Execute = true;
  m.run(20);
  m.move.Distance = 100.0;
  m.move.Execute = true;
  double furthest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    m.tick();
    furthest = std::max(furthest, m.position());
  }
  EXPECT_EQ(m.axis_.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kSoftwareLimitReached));
  EXPECT_LE(furthest, 150.0);
  EXPECT_EQ(m.position(), 150.0);
  EXPECT_TRUE(m.move.Error);
}

TEST(MC_MoveSuperimposed, PassesASoftwareLimitByNothingThatTheSumKeeps) {
  Machine m;
  m.axis_.data.PositionLimits_SW = {};
  m.axis_.data.PositionLimits_SW.Active = true;
  m.axis_.data.PositionLimits_SW.MinPosition = -1000.0;
  m.axis_.data.PositionLimits_SW.MaxPosition = 150.0;
  m.absolute.Position = 100.0;
  m.absolute.Execute = true;
  m.run(20);
  m.move.Distance = 50.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.absolute.Done && m.move.Done; }));
  EXPECT_EQ(m.axis_.data.ErrorDetail.Number, 0u);
  EXPECT_EQ(m.position(), 150.0);
}

TEST(MC_MoveSuperimposed, IsShiftedByHomingWithoutMotion) {
  Machine m;
  m.run_at(50.0);
  m.move.Distance = 100.0;
  m.move.Execute = true;
  m.run(100);
  const double velocity = m.velocity();
  m.home.Mode = 1;
  m.home.Position = 1000.0;
  m.home.Execute = false;
  m.continuity[1].velocity = false;
  const double before = m.position();
  m.run(1);
  m.home.Execute = true;
  m.run(2);
  EXPECT_NEAR(m.position() - before, 1000.0 + 3 * 0.001 * velocity, 0.1);
  m.continuity[1].velocity = true;
  m.run(1);
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
}

TEST(MC_MoveSuperimposed, TakesUpPositionControlWhereTheAxisIs) {
  Machine m;
  m.run_velocity.PositionControlled = false;
  m.run_at(50.0);
  EXPECT_TRUE(m.shows(StatusBit::NonPositionControlled));
  m.move.Distance = 10.0;
  m.move.Execute = true;
  m.run(3);
  EXPECT_FALSE(m.shows(StatusBit::NonPositionControlled));
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
}

// ---- MC_HaltSuperimposed
// ---------------------------------------------------------------------------------------

TEST(MC_HaltSuperimposed, StopsTheSuperimposedPartAlone) {
  Machine m;
  m.run_at(100.0);
  m.move.Distance = 1000.0;
  m.move.Execute = true;
  m.run(400);
  m.halt_superimposed.Deceleration = 500.0;
  m.halt_superimposed.Execute = true;
  m.run(3);
  EXPECT_TRUE(m.halt_superimposed.Busy);
  EXPECT_TRUE(m.move.CommandAborted);
  EXPECT_TRUE(m.shows(Status2Bit::HaltSuperimposedCommand));
  EXPECT_FALSE(m.shows(StatusBit::MoveSuperimposedCommand));
  ASSERT_TRUE(m.run_until([&] { return m.halt_superimposed.Done; }));
  EXPECT_EQ(m.velocity(), 100.0);
  EXPECT_TRUE(m.run_velocity.InVelocity);
  EXPECT_FALSE(m.shows(Status2Bit::HaltSuperimposedCommand));
  EXPECT_GT(m.superimposed(), 0.0);
}

TEST(MC_HaltSuperimposed, IsDoneAtOnceWhenNothingIsSuperimposed) {
  Machine m;
  m.run_at(100.0);
  m.halt_superimposed.Execute = true;
  m.run(2);
  EXPECT_TRUE(m.halt_superimposed.Done);
  EXPECT_TRUE(m.run_velocity.InVelocity);
}

TEST(MC_HaltSuperimposed, KeepsTheVelocityLimitWhateverJerkItIsGiven) {
  Machine m;
  m.move.Distance = 1000.0;
  m.move.Jerk = 0.0;
  m.continuity[1].acceleration = false;
  m.move.Execute = true;
  m.run(20);
  EXPECT_GT(m.axis_.data.Acceleration, 0.0);
  m.halt_superimposed.Jerk = 1e-3;
  m.halt_superimposed.Execute = true;
  for (int i = 0; i < 5000 && !m.halt_superimposed.Done; ++i) {
    m.tick();
    ASSERT_LE(m.velocity(), 500.0);
  }
}

/// Halts beside a base motion that speeds up with nearly all of the acceleration, which the sum keeps.
void halt_beside_a_hard_base_motion(Machine& m) {
  ASSERT_NE(m.axis_.data.StatusPositioning.SuperimposedDistance, 0.0);
  ASSERT_GT(std::abs(m.axis_.data.Acceleration), 4500.0);
  m.halt_superimposed.Execute = true;
  int braking = 0;
  for (int i = 0; i < 1000 && !m.halt_superimposed.Done; ++i, ++braking) {
    m.tick();
    ASSERT_LE(std::abs(m.axis_.data.Acceleration), 5000.0 * (1 + 1e-12)) << i;
  }
  EXPECT_TRUE(m.halt_superimposed.Done);
  EXPECT_GT(braking, 3);
}

TEST(MC_HaltSuperimposed, KeepsTheAccelerationOfTheSumBesideABaseMotionThatLeavesNoJerk) {
  Machine m;
  m.continuity[1].acceleration = false;
  m.relative.Distance = -189.0;
  m.relative.Velocity = 465.0;
  m.relative.Acceleration = 4800.0;
  m.relative.Jerk = 100000.0;
  m.relative.Execute = true;
  m.run(5);
  m.move.Distance = 190.0;
  m.move.Jerk = 0.0;
  m.move.Execute = true;
  m.run(60);
  halt_beside_a_hard_base_motion(m);
}

TEST(MC_HaltSuperimposed, IsLeftHalfOfTheAccelerationBehindValuesThatWereGiven) {
  Machine m;
  m.continuity[1] = {false, false, 5000.0, 100000.0};
  m.run_velocity.Velocity = 500.0;
  m.run_velocity.Acceleration = 5000.0;
  m.run_velocity.Jerk = 100000.0;
  m.run_velocity.Execute = true;
  m.given.Enable = true;
  m.given.VelocityDiff = -40.0;
  for (int i = 1; i <= 70; ++i) {
    m.given.Distance = -0.04 * i;
    m.tick();
  }
  m.halt_superimposed.Deceleration = 5000.0;
  m.halt_superimposed.Jerk = 100000.0;
  halt_beside_a_hard_base_motion(m);
  ASSERT_TRUE(m.run_until([&] { return m.run_velocity.InVelocity; }));
  EXPECT_EQ(m.velocity(), 500.0);
}

TEST(MC_HaltSuperimposed, TakesWhatABaseMotionLeavesOfWhichItTakesNothing) {
  Machine m, without;
  for (Machine* machine : {&m, &without}) {
    machine->continuity[1] = {false, false, 5000.0, 100000.0};
    machine->relative.Distance = 300.0;
    machine->relative.Velocity = 400.0;
    machine->relative.Acceleration = machine->relative.Deceleration = 4000.0;
    machine->relative.Jerk = 80000.0;
    machine->relative.Execute = true;
  }
  m.given.Enable = true;
  m.given.VelocityDiff = 40.0;
  int moving = 0;
  for (int i = 0; i < 1500; ++i) {
    if (i < 100) m.given.Distance = 0.04 * (i + 1);
    if (i == 100) m.halt_superimposed.Execute = true;
    m.tick();
    without.tick();
    if (i < 102 || m.relative.Done) continue;  // when both are complete, they are one
    ASSERT_NEAR(m.position() - without.position(), m.superimposed(), 1e-9) << i;
    moving += m.halt_superimposed.Busy;
  }
  EXPECT_GT(moving, 40) << "40 u/s with 1000 u/s²";
  EXPECT_TRUE(m.relative.Done);
}

/// A halt from full velocity with all of the limits, and values that are given on top of it.
void give_on_a_halt(Machine& m, double velocity) {
  m.run_at(500.0);
  m.continuity[1] = {false, false, 5000.0, 100000.0};
  m.halt.Deceleration = 5000.0;
  m.halt.Jerk = 100000.0;
  m.halt.Execute = true;
  m.given.Enable = true;
  m.given.VelocityDiff = velocity;
  for (int i = 1; i <= 60; ++i) {
    m.given.Distance = 0.001 * velocity * i;
    m.tick();
  }
  ASSERT_TRUE(m.given.Busy);
  ASSERT_TRUE(m.halt.Busy);
}

TEST(MC_HaltSuperimposed, IsLeftHalfOfTheAccelerationByAHaltToo) {
  Machine m;
  give_on_a_halt(m, 40.0);
  m.halt_superimposed.Deceleration = 5000.0;
  m.halt_superimposed.Jerk = 100000.0;
  halt_beside_a_hard_base_motion(m);
  m.halt_superimposed.Execute = false;
  double last = m.position();
  ASSERT_TRUE(m.run_until([&] {
    EXPECT_GE(m.position(), last) << "a halt does not turn back";
    last = m.position();
    return m.halt.Done;
  }));
}

TEST(MC_HaltSuperimposed, LeavesTheEndOfAHaltItsJerkSoThatItDoesNotTurnBack) {
  Machine m;
  give_on_a_halt(m, 40.0);
  ASSERT_TRUE(m.run_until([&] { return std::abs(m.axis_.data.Acceleration) < 4000.0; }));
  const double rest = m.velocity() - 40.0;  // of the halt, which runs its deceleration down
  EXPECT_NEAR(rest, 0.5 * 4000.0 * 4000.0 / 100000.0, 5.0);
  m.halt_superimposed.Deceleration = 5000.0;
  m.halt_superimposed.Jerk = 100000.0;
  m.halt_superimposed.Execute = true;
  double last = m.position();
  ASSERT_TRUE(m.run_until([&] {
    EXPECT_LE(std::abs(m.axis_.data.Acceleration), 5000.0 * (1 + 1e-12));
    EXPECT_GE(m.position(), last);
    last = m.position();
    return m.halt.Done && m.halt_superimposed.Done;
  }));
}

TEST(MC_HaltSuperimposed, IsLeftHalfByAStopThatNoJobAsksForAnyMore) {
  Machine m;
  auto& base = m.block<MC_MotionInVelocity>();
  base.Axis = &m.axis_;
  m.continuity[1] = {false, false, 5000.0, 100000.0};
  base.Velocity = 500.0;
  base.Enable = true;
  m.run(5);
  base.Velocity = kNaN;  // which stops it with maximum dynamics
  m.run(2);
  m.given.Enable = true;
  m.given.VelocityDiff = 40.0;
  for (int i = 1; i <= 60; ++i) {
    m.given.Distance = 0.04 * i;
    m.tick();
  }
  ASSERT_TRUE(base.Error);
  halt_beside_a_hard_base_motion(m);
}

TEST(MC_MotionInSuperimposed, StopsOnAValueThatIsNoneWithWhatTheBaseMotionLeaves) {
  for (const bool halts : {true, false}) {
    Machine m;
    if (halts) {
      give_on_a_halt(m, 40.0);
    } else {
      m.continuity[1] = {false, false, 5000.0, 100000.0};
      m.run_velocity.Velocity = 500.0;
      m.run_velocity.Acceleration = 5000.0;
      m.run_velocity.Jerk = 100000.0;
      m.run_velocity.Execute = true;
      m.given.Enable = true;
      m.given.VelocityDiff = -40.0;
      m.run(70);
    }
    m.given.VelocityDiff = kNaN;
    for (int i = 0; i < 1000; ++i) {
      m.tick();
      ASSERT_LE(std::abs(m.axis_.data.Acceleration), 5000.0 * (1 + 1e-12)) << i;
    }
    EXPECT_TRUE(m.given.Error);
    EXPECT_EQ(m.velocity(), halts ? 0.0 : 500.0);
  }
}

/// Whatever the base motion does when values that were given come to rest.
TEST(MC_HaltSuperimposed, KeepsTheAccelerationOfTheSumAtRandom) {
  int braked = 0;
  const test::Cases ran = test::for_each_seed(43, test::cases(300, 30'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    Machine m;
    m.continuity[1] = {false, false, 5000.0, 100000.0};
    const double maximum = uniform(1000.0, 5000.0);
    m.axis_.data.DynamicLimits.MaxAcceleration = m.axis_.data.DynamicLimits.MaxDeceleration = maximum;
    const bool halts = one.seed % 2 == 0;
    if (halts) m.run_at(uniform(50.0, 450.0));
    auto set = [&](auto& job) {
      job.Deceleration = uniform(500.0, 8000.0);
      job.Jerk = uniform(10000.0, 100000.0);
      job.Execute = true;
    };
    if (halts) {
      set(m.halt);
    } else {
      m.relative.Distance = uniform(-200.0, 200.0);
      m.relative.Velocity = uniform(10.0, 450.0);
      m.relative.Acceleration = uniform(500.0, 8000.0);
      set(m.relative);
    }
    m.given.Enable = true;
    m.given.VelocityDiff = uniform(-300.0, 300.0);
    const int ticks = static_cast<int>(uniform(3.0, 150.0));
    for (int i = 1; i <= ticks; ++i) {
      m.given.Distance = 0.001 * m.given.VelocityDiff * i;
      m.tick();
    }
    if (one.seed % 4 < 2) {
      set(m.halt_superimposed);
    } else {
      m.given.VelocityDiff = kNaN;
    }
    for (int i = 0; i < 1500; ++i) {
      m.tick();
      ASSERT_LE(std::abs(m.axis_.data.Acceleration), maximum * (1 + 1e-9)) << i;
    }
    braked += m.halt_superimposed.Done || m.given.Error;
  });
  EXPECT_EQ(braked, ran.count);
}

// ---- MC_MotionInSuperimposed
// -----------------------------------------------------------------------------------

/// A smooth way of 10 u in 1 s, given tick by tick.
struct Sine {
  explicit Sine(double t) : w{3.14159265358979 * std::clamp(t, 0.0, 1.0)}, on{t > 0.0 && t < 1.0} {}
  double w;
  bool on;
  double distance() const { return 5.0 * (1.0 - std::cos(w)); }
  double velocity() const { return on ? 5.0 * 3.14159265358979 * std::sin(w) : 0.0; }
};

TEST(MC_MotionInSuperimposed, AddsTheGivenValuesInEveryCycle) {
  Machine m;
  m.run_at(100.0);
  const double start = m.position();
  m.given.Enable = true;
  m.tick();
  for (int i = 1; i <= 1200; ++i) {
    const Sine given(0.001 * i);
    m.given.Distance = given.distance();
    m.given.VelocityDiff = given.velocity();
    m.tick();  // seen by the next cycle
    const Sine counts(0.001 * (i - 1));
    ASSERT_NEAR(m.position(), start + 0.1 * (i + 1) + counts.distance(), 1e-9);
    ASSERT_NEAR(m.velocity(), 100.0 + counts.velocity(), 1e-9);
    ASSERT_TRUE(m.given.Busy);
  }
  EXPECT_TRUE(m.shows(Status2Bit::MotionInSuperimposedCommand));
  EXPECT_EQ(m.superimposed(), 10.0);
  m.given.Enable = false;
  m.run(2);
  EXPECT_FALSE(m.given.Busy);
  EXPECT_FALSE(m.shows(Status2Bit::MotionInSuperimposedCommand));
  EXPECT_EQ(m.velocity(), 100.0);
  EXPECT_EQ(m.superimposed(), 10.0) << "the distance stays";
}

TEST(MC_MotionInSuperimposed, StepsByWhatIsGivenAndGoesToZeroAtOnce) {
  Machine m;
  m.given.Enable = true;
  m.run(2);
  m.continuity[1].velocity = false;
  m.given.Distance = 7.0;
  m.given.VelocityDiff = 600.0;
  m.run(2);
  EXPECT_EQ(m.position(), 7.0);
  EXPECT_EQ(m.velocity(), 600.0);
  EXPECT_TRUE(has_bit(m.axis_.data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded));
  m.given.Enable = false;
  m.run(1);
  EXPECT_EQ(m.velocity(), 600.0) << "until the next cycle";
  m.run(1);
  EXPECT_EQ(m.velocity(), 0.0);
  EXPECT_EQ(m.position(), 7.0);
  EXPECT_FALSE(has_bit(m.axis_.data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded));
}

TEST(MC_MotionInSuperimposed, StopsWithMaximumDynamicsOnAValueThatIsNone) {
  for (int pin = 0; pin < 3; ++pin) {
    Machine m;
    m.run_at(50.0);
    m.given.Enable = true;
    m.run(2);
    m.continuity[1].velocity = false;
    m.given.VelocityDiff = 200.0;
    for (int i = 1; i <= 20; ++i) {
      m.given.Distance = 0.2 * i;
      m.tick();
    }
    m.tick();
    const double velocity = m.velocity();
    EXPECT_EQ(velocity, 250.0);
    LREAL* pins[] = {&m.given.Distance, &m.given.VelocityDiff, &m.given.AccelerationDiff};
    *pins[pin] = kNaN;
    m.tick();
    m.continuity[1].velocity = true;
    EXPECT_TRUE(m.given.Error);
    EXPECT_FALSE(m.given.Busy);
    constexpr ErrorId kErrors[] = {ErrorId::distance, ErrorId::velocity, ErrorId::acceleration};
    EXPECT_EQ(m.given.ErrorID, static_cast<WORD>(kErrors[pin]));
    int ticks = 0;
    ASSERT_TRUE(m.run_until([&] {
      ++ticks;
      return m.velocity() == 50.0;
    }));
    EXPECT_GT(ticks, 40) << "200 u/s with 5000 u/s²";
    EXPECT_LT(ticks, 120);
    EXPECT_TRUE(m.run_velocity.InVelocity);
    *pins[pin] = 0.0;
    m.run(5);
    EXPECT_TRUE(m.given.Error) << "until Enable falls";
    m.given.Enable = false;
    m.run(1);
    EXPECT_FALSE(m.given.Error);
  }
}

TEST(MC_MotionInSuperimposed, CountsFromWhereAFinishedDistanceHasLeftTheAxis) {
  Machine m;
  m.run_at(20.0);
  m.move.Distance = 30.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  m.given.Enable = true;  // with a distance of 0: no step, as the rig checks
  m.run(10);
  EXPECT_EQ(m.superimposed(), 30.0);
}

TEST(MC_MotionInSuperimposed, NeedsPositionControl) {
  Machine m;
  m.run_velocity.PositionControlled = false;
  m.run_at(20.0);
  m.given.Enable = true;
  m.run(2);
  EXPECT_TRUE(m.given.Error);
  EXPECT_EQ(m.given.ErrorID, static_cast<WORD>(ErrorId::not_position_controlled));
}

// ---- On a gear
// -------------------------------------------------------------------------------------------------

/// Position = F(EffectiveLeadingValue + PhaseShift) + Offset + superimposed part, every term of the same
/// cycle.
TEST(SuperimposedOnAGear, IsExactlyTheLastTermOfTheChain) {
  Machine m;
  m.gear.RatioNumerator = 7;
  m.gear.RatioDenominator = 3;
  m.couple(37.0);
  m.offset.Offset = 3.3;
  m.offset.OffsetDistance = 20.0;
  m.offset.Execute = true;
  std::mt19937 random(test::seed_of_test(20261));
  std::uniform_real_distribution<double> distances(-20.0, 20.0);
  double worst = 0.0;
  int moving = 0;
  for (int job = 0; job < 60; ++job) {
    m.move.Distance = distances(random);
    m.move.VelocityDiff = 60.0;
    m.move.Acceleration = m.move.Deceleration = 2000.0;
    m.move.Execute = true;
    for (int i = 0; i < 700; ++i) {
      m.tick();
      const auto& status = m.axis_.data.StatusSynchronizedMotion;
      const double sum = status.FunctionFollowingValue.Position + status.Offset;
      const double distance = m.position() - sum;
      const double permitted = 4.0 * ulp(std::max(std::abs(m.position()), std::abs(sum)));
      worst = std::max(worst, std::abs(std::abs(distance) - m.superimposed()) / permitted);
      moving += m.move.Busy;
    }
    ASSERT_TRUE(m.move.Done);
    m.move.Execute = false;
    m.run(1);
    EXPECT_TRUE(m.gear.InGear);
  }
  EXPECT_GT(moving, 5000);
  EXPECT_LE(worst, 1.0);
  EXPECT_TRUE(m.offset.Done);
}

TEST(SuperimposedOnAGear, IsNotLimitedByWhatTheGearLeaves) {
  Machine m;
  m.gear.RatioNumerator = 2;
  m.couple(240.0);
  m.move.Distance = 100.0;
  m.move.VelocityDiff = 100.0;
  m.move.Execute = true;
  m.run(400);
  EXPECT_NEAR(m.velocity(), 580.0, 1e-9) << "beyond the limit of the axis' own motion";
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
}

TEST(SuperimposedOnAGear, StaysPartOfThePositionWhenTheGearIsLeftAndMetAnew) {
  Machine m;
  m.couple(50.0);
  m.move.Distance = 10.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  EXPECT_EQ(m.superimposed(), 10.0);
  m.gear.Execute = false;
  m.run(1);
  m.gear.Execute = true;  // a new gear begins where the axis is
  ASSERT_TRUE(m.run_until([&] { return m.gear.InGear; }));
  EXPECT_EQ(m.superimposed(), 0.0);
  m.halt.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.halt.Done; }));
}

TEST(SuperimposedOnAGear, CountsForTheStopPositionOfMC_GearOut) {
  for (const DINT profile : {0, 1}) {
    Machine m;
    m.couple(50.0);
    m.move.Distance = 2000.0;
    m.move.VelocityDiff = 25.0;
    m.move.Execute = true;
    m.run(200);
    m.gear_out.SyncProfileReference = profile;
    m.gear_out.MasterStopDistance = 20.0;
    m.gear_out.SlavePosition = m.position() + 100.0;
    m.gear_out.Deceleration = 1000.0;
    m.gear_out.Execute = true;
    for (auto& rule : m.continuity) rule.acceleration = false;  // braked early enough not to pass it
    double furthest = 0.0;
    ASSERT_TRUE(m.run_until([&] {
      furthest = std::max(furthest, m.position());
      return m.gear_out.Done;
    }));
    EXPECT_LE(furthest, m.gear_out.SlavePosition + 1e-9);
    EXPECT_TRUE(m.move.CommandAborted);
    EXPECT_EQ(m.position(), m.gear_out.SlavePosition);
  }
}

TEST(SuperimposedOnAGear, IsNotSeenByTheLeadingAxisButMovesWhatItFollows) {
  Machine m;
  m.couple(50.0);
  auto& on_leading = m.block<MC_MoveSuperimposed>();
  on_leading.Axis = &m.leading;
  on_leading.Distance = 10.0;
  on_leading.Execute = true;
  const double apart = m.position() - m.leading.data.Position;
  for (int i = 0; i < 300; ++i) {
    m.tick();
    ASSERT_NEAR(m.position() - m.leading.data.Position, apart, 1e-10) << "in the same cycle";
  }
  EXPECT_TRUE(on_leading.Busy || on_leading.Done);
  m.move.Distance = 5.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.move.Done && on_leading.Done; }));
  EXPECT_NEAR(m.position() - m.leading.data.Position, apart + 5.0, 1e-10);
}

// ---- At random
// -------------------------------------------------------------------------------------------------

/// Jobs, override and jogging at random on an axis of its own: the sum keeps within the limits in every
/// cycle.
TEST(Superimposed, KeepsTheSumWithinTheLimitsUnderJobsAtRandom) {
  int superimposed_ticks = 0;
  const test::Cases ran = test::for_each_seed(41, test::cases(60, 6000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    Machine m;
    for (test::Continuity& rule : m.continuity) rule = {true, true, 5000.0 * 1.0001, 2e5};
    for (int action = 0; action < 25; ++action) {
      m.relative.Execute = m.move.Execute = m.run_velocity.Execute = m.halt_superimposed.Execute = false;
      m.jog.JogForward = false;
      m.run(1);
      switch (random() % 8) {
        case 0:
          m.relative.Distance = uniform(-200.0, 200.0);
          m.relative.Velocity = uniform(10.0, 600.0);
          m.relative.Acceleration = m.relative.Deceleration = uniform(500.0, 6000.0);
          m.relative.Execute = true;
          break;
        case 1:
          m.run_velocity.Velocity = uniform(-600.0, 600.0);
          m.run_velocity.Acceleration = m.run_velocity.Deceleration = uniform(500.0, 6000.0);
          m.run_velocity.Execute = true;
          break;
        case 2:
          m.jog.Velocity = uniform(10.0, 600.0);
          m.jog.Acceleration = m.jog.Deceleration = uniform(500.0, 6000.0);
          m.jog.JogForward = true;
          break;
        case 3:
          m.axis_.data.Override.Velocity = uniform(0.0, 200.0);
          break;
        case 4:
          m.halt_superimposed.Execute = true;
          break;
        default:
          m.move.Distance = uniform(-100.0, 100.0);
          m.move.VelocityDiff = uniform(10.0, 600.0);
          m.move.Acceleration = m.move.Deceleration = uniform(500.0, 6000.0);
          m.move.Execute = true;
          break;
      }
      for (int i = static_cast<int>(random() % 150); i >= 0; --i) {
        m.tick();
        superimposed_ticks += m.shows(StatusBit::MoveSuperimposedCommand) && m.superimposed() > 0.0;
        ASSERT_LE(std::abs(m.velocity()), 500.0 * (1 + 1e-9));
        ASSERT_LE(std::abs(m.axis_.data.Acceleration), 5000.0 * (1 + 1e-9));
      }
    }
  });
  if (ran.alone) return;
  EXPECT_GT(superimposed_ticks, ran.count * 10'000 / 60);
}

}  // namespace
}  // namespace lockstep::superimposed_test
