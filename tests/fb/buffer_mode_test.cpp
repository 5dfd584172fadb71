// BufferMode on the bench: jobs that wait for the one before them, and motions that blend into each other.
// The rig checks in every cycle that position, velocity and acceleration go on without a step.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/motion_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::buffer_mode_test {
namespace {

using test::Rig;

enum : INT { kAborting, kBuffered, kLow, kPrevious, kNext, kHigh };

struct Machine : Rig {
  explicit Machine(const std::function<void(AxisData&)>& configure = {})
      : leading(axis("Leading")),
        axis_(axis("Axis",
                   [&](AxisData& data) {
                     data.DynamicLimits = {500.0, 500.0, 5000.0, 5000.0, 100000.0};
                     data.DynamicDefaults.Jerk = 20000.0;
                     if (configure) configure(data);
                   })),
        power(block<MC_Power>()),
        power_leading(block<MC_Power>()),
        home(block<MC_Home>()),
        halt(block<MC_Halt>()),
        stop(block<MC_Stop>()),
        jog(block<MC_MoveJog>()),
        run_at(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()),
        given(block<MC_MotionInVelocity>()),
        superimposed(block<MC_MoveSuperimposed>()) {
    lead(axis_, leading);
    power.Axis = home.Axis = halt.Axis = stop.Axis = jog.Axis = run_at.Axis = gear.Slave = &axis_;
    given.Axis = superimposed.Axis = &axis_;
    gear.Master = power_leading.Axis = &leading;
    power.Enable = power_leading.Enable = home.Execute = true;
    continuity[1] = {true, true, 5000.0, 100000.0};
    Rig::run(5);
  }

  MC_MoveAbsolute& to(double position, double velocity, INT mode = kAborting) {
    auto& move = block<MC_MoveAbsolute>();
    move.Axis = &axis_;
    move.Position = position;
    move.Velocity = velocity;
    move.BufferMode = mode;
    move.Execute = true;
    return move;
  }
  MC_MoveRelative& by(double distance, double velocity, INT mode = kAborting) {
    auto& move = block<MC_MoveRelative>();
    move.Axis = &axis_;
    move.Distance = distance;
    move.Velocity = velocity;
    move.BufferMode = mode;
    move.Execute = true;
    return move;
  }

  double position() const { return axis_.data.Position; }
  double velocity() const { return axis_.data.Velocity; }

  Axis& leading;
  Axis& axis_;
  MC_Power& power;
  MC_Power& power_leading;
  MC_Home& home;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_MoveJog& jog;
  MC_MoveVelocity& run_at;
  MC_GearIn& gear;
  MC_MotionInVelocity& given;
  MC_MoveSuperimposed& superimposed;
};

TEST(BufferMode, BufferedBeginsWhenTheJobBeforeIsDone) {
  Machine m;
  auto& first = m.to(50.0, 100.0);
  m.run(20);
  auto& second = m.to(80.0, 50.0, kBuffered);
  ASSERT_TRUE(m.run_until([&] {
    EXPECT_TRUE(second.Busy || second.Done);
    return first.Done;
  }));
  EXPECT_EQ(m.position(), 50.0);
  EXPECT_EQ(m.velocity(), 0.0);
  EXPECT_TRUE(second.Busy);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_EQ(m.position(), 80.0);
  EXPECT_FALSE(first.CommandAborted);
}

TEST(BufferMode, BufferedBeginsAtOnceOnAnIdleAxis) {
  for (INT mode = kBuffered; mode <= kHigh; ++mode) {
    Machine m;
    auto& only = m.by(10.0, 100.0, mode);
    m.run(5);
    EXPECT_GT(m.velocity(), 0.0);
    ASSERT_TRUE(m.run_until([&] { return only.Done; }));
    EXPECT_EQ(m.position(), 10.0);
  }
}

struct BlendingCase {
  INT mode;
  double velocity;  // at the first target, of 100 and 60 u/s
};

class BlendsUpAndDown : public testing::TestWithParam<std::tuple<BlendingCase, bool>> {};

/// The first motion passes its target with the velocity that the mode asks for and is Done there.
TEST_P(BlendsUpAndDown, PassesTheFirstTargetWithTheVelocityOfTheMode) {
  const auto [rule, backwards] = GetParam();
  const double side = backwards ? -1.0 : 1.0;
  Machine m;
  auto& first = m.to(side * 100.0, 100.0);
  m.run(20);
  auto& second = m.to(side * 200.0, 60.0, rule.mode);
  double last = 0.0, lowest = 1e9;
  ASSERT_TRUE(m.run_until([&] {
    if (!first.Done) last = m.position();
    return first.Done;
  }));
  EXPECT_LE(side * last, 100.0);
  EXPECT_GE(side * m.position(), 100.0);
  EXPECT_LE(side * m.position(), 100.0 + rule.velocity * m.period());
  EXPECT_NEAR(side * m.velocity(), rule.velocity, 1e-6);
  EXPECT_TRUE(second.Busy) << "in the very cycle";
  ASSERT_TRUE(m.run_until([&] {
    if (side * m.position() < 190.0) lowest = std::min(lowest, side * m.velocity());
    return second.Done;
  }));
  EXPECT_NEAR(lowest, 60.0, 1e-6);
  EXPECT_EQ(m.position(), side * 200.0);
}

INSTANTIATE_TEST_SUITE_P(
    Modes, BlendsUpAndDown,
    testing::Combine(testing::Values(BlendingCase{kLow, 60.0}, BlendingCase{kPrevious, 100.0},
                                     BlendingCase{kNext, 60.0}, BlendingCase{kHigh, 100.0}),
                     testing::Bool()));

TEST(BufferMode, BlendsIntoAFasterMotionWithTheHighestVelocityOfBoth) {
  Machine m;
  auto& first = m.to(100.0, 60.0);
  m.run(20);
  m.to(300.0, 100.0, kHigh);
  ASSERT_TRUE(m.run_until([&] { return first.Done; }));
  EXPECT_NEAR(m.velocity(), 100.0, 1e-6) << "the first motion speeds up in front of its target";
}

TEST(BufferMode, BlendingIsExactForRelativeDistances) {
  Machine m;
  m.by(100.1, 100.0);
  m.run(20);
  auto& second = m.by(33.3, 80.0, kLow);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_NEAR(m.position(), 133.4, 3e-14);
}

TEST(BufferMode, BlendingThatWouldTurnBackTakesTheHighestVelocityThatDoesNot) {
  Machine m;
  auto& first = m.to(100.0, 200.0);
  m.run(20);
  auto& second = m.to(101.0, 200.0, kHigh);  // one unit to stop in
  double furthest = 0.0;
  double passing = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    furthest = std::max(furthest, m.position());
    if (first.Done && passing == 0.0) passing = m.velocity();
    EXPECT_GE(m.velocity(), 0.0);
    return second.Done;
  }));
  EXPECT_EQ(furthest, 101.0);
  EXPECT_GT(passing, 10.0);
  EXPECT_LT(passing, 40.0);
}

TEST(BufferMode, BlendingIntoTheOtherDirectionIsBuffered) {
  for (INT mode = kLow; mode <= kHigh; ++mode) {
    Machine m;
    auto& first = m.to(50.0, 100.0);
    m.run(20);
    auto& second = m.to(-20.0, 100.0, mode);
    double furthest = 0.0;
    ASSERT_TRUE(m.run_until([&] {
      furthest = std::max(furthest, m.position());
      return first.Done;
    }));
    EXPECT_EQ(m.velocity(), 0.0);
    EXPECT_EQ(furthest, 50.0);
    ASSERT_TRUE(m.run_until([&] { return second.Done; }));
    EXPECT_EQ(m.position(), -20.0);
  }
}

TEST(BufferMode, BlendingThatComesTooLateIsAsFastAsItCanBe) {
  Machine m;
  auto& first = m.to(50.0, 200.0);
  ASSERT_TRUE(m.run_until([&] { return m.position() > 40.0; }));  // it brakes already
  auto& second = m.to(100.0, 200.0, kHigh);
  double lowest = 1e9;
  ASSERT_TRUE(m.run_until([&] {
    lowest = std::min(lowest, m.velocity());
    return first.Done;
  }));
  EXPECT_GT(m.velocity(), 5.0);
  EXPECT_LT(m.velocity(), 200.0);
  EXPECT_GT(lowest, 0.0);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_EQ(m.position(), 100.0);
}

TEST(BufferMode, MC_MoveVelocityReleasesTheNextAfterInVelocity) {
  for (const INT mode : {INT{kBuffered}, INT{kLow}, INT{kHigh}}) {
    Machine m;
    m.run_at.Velocity = 100.0;
    m.run_at.Execute = true;
    m.run(20);
    auto& next = m.by(30.0, 50.0, mode);
    m.run(2);
    EXPECT_TRUE(next.Busy);
    EXPECT_TRUE(m.run_at.Busy);
    double fastest = 0.0;
    ASSERT_TRUE(m.run_until([&] {
      fastest = std::max(fastest, m.velocity());
      return m.run_at.CommandAborted;
    }));
    EXPECT_NEAR(fastest, 100.0, 1e-9);
    ASSERT_TRUE(m.run_until([&] { return next.Done; }));
  }
}

TEST(BufferMode, BlendsIntoAnEndlessMotionAndIntoAHalt) {
  Machine m;
  auto& first = m.to(100.0, 80.0);
  m.run(20);
  m.run_at.Velocity = 120.0;
  m.run_at.BufferMode = kPrevious;
  m.run_at.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return first.Done; }));
  EXPECT_NEAR(m.velocity(), 80.0, 1e-6);
  ASSERT_TRUE(m.run_until([&] { return m.run_at.InVelocity; }));
  EXPECT_EQ(m.velocity(), 120.0);
  m.halt.BufferMode = kBuffered;
  m.halt.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.halt.Done; }));
  auto& second = m.by(100.0, 80.0);
  m.run(20);
  m.halt.Execute = false;
  m.run(1);
  m.halt.BufferMode = kPrevious;
  m.halt.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_NEAR(m.velocity(), 80.0, 1e-6);
  ASSERT_TRUE(m.run_until([&] { return m.halt.Done; }));
}

TEST(BufferMode, OneJobWaitsAndAFurtherOneIsRejected) {
  Machine m;
  auto& first = m.to(100.0, 100.0);
  m.run(5);
  auto& second = m.to(150.0, 100.0, kLow);
  m.run(5);
  auto& third = m.to(200.0, 100.0, kBuffered);
  m.run(2);
  EXPECT_TRUE(third.Error);
  EXPECT_EQ(third.ErrorID, static_cast<WORD>(ErrorId::no_job_memory));
  EXPECT_TRUE(first.Busy && second.Busy);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_EQ(m.position(), 150.0);
}

TEST(BufferMode, AnAbortingJobEndsBoth) {
  Machine m;
  auto& first = m.to(100.0, 100.0);
  m.run(20);
  auto& second = m.to(150.0, 100.0, kLow);
  m.run(20);
  auto& last = m.to(20.0, 100.0);
  m.run(2);
  EXPECT_TRUE(first.CommandAborted && second.CommandAborted);
  ASSERT_TRUE(m.run_until([&] { return last.Done; }));
  EXPECT_EQ(m.position(), 20.0);
}

TEST(BufferMode, MC_StopAlarmAndDisablingEndBoth) {
  for (int end = 0; end < 3; ++end) {
    Machine m;
    m.axis_.data.DynamicDefaults.EmergencyDeceleration = 5000.0;
    auto& first = m.to(100.0, 100.0);
    m.run(20);
    auto& second = m.to(150.0, 100.0, kHigh);
    m.run(20);
    m.continuity[1].acceleration = false;  // emergency ramps have no jerk limit
    if (end == 0) m.stop.Execute = true;
    if (end == 1) m.axis_.raise(alarm::kVelocityLimitZero);
    if (end == 2) m.power.Enable = false;
    m.run(3);
    EXPECT_EQ(first.Error, end == 1);
    EXPECT_EQ(second.Error, end == 1);
    EXPECT_EQ(first.CommandAborted && second.CommandAborted, end != 1);
    ASSERT_TRUE(m.run_until([&] { return m.axis_.setpoint().standing(); }));
  }
}

TEST(BufferMode, ASynchronousJobOrGivenSetpointsBeforeAreRefused) {
  for (const bool gear : {true, false}) {
    Machine m;
    m.gear.Execute = gear;
    m.given.Enable = !gear;
    m.run(5);
    auto& next = m.to(10.0, 100.0, kBuffered);
    m.run(2);
    EXPECT_TRUE(next.Error);
    EXPECT_EQ(next.ErrorID, static_cast<WORD>(ErrorId::mode));
    EXPECT_TRUE(gear ? m.gear.Busy : m.given.Busy) << "goes on";
  }
}

TEST(BufferMode, AModeThatThereIsNotIsRefused) {
  for (const INT mode : {INT{-1}, INT{6}, INT{32767}}) {
    Machine m;
    auto& move = m.to(10.0, 100.0, mode);
    m.run(2);
    EXPECT_TRUE(move.Error);
    EXPECT_EQ(move.ErrorID, static_cast<WORD>(ErrorId::mode));
    EXPECT_EQ(m.velocity(), 0.0);
  }
}

TEST(BufferMode, TheOverrideChangesTheVelocityOfBoth) {
  Machine m;
  auto& first = m.to(100.0, 100.0);
  m.run(20);
  auto& second = m.to(200.0, 100.0, kLow);
  m.run(50);
  m.axis_.data.Override.Velocity = 50.0;
  ASSERT_TRUE(m.run_until([&] { return first.Done; }));
  EXPECT_NEAR(m.velocity(), 50.0, 1e-6);
  m.axis_.data.Override.Velocity = 0.0;
  m.run(500);
  EXPECT_EQ(m.velocity(), 0.0);
  EXPECT_TRUE(second.Busy);
  m.axis_.data.Override.Velocity = 100.0;
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_EQ(m.position(), 200.0);
}

TEST(BufferMode, BlendsOverTheEndOfARing) {
  Machine m([](AxisData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = 360.0;
  });
  auto& first = m.to(300.0, 200.0);
  m.run(20);
  auto& second = m.to(300.0, 200.0, kPrevious);  // a position that it is at then: no way to make
  ASSERT_TRUE(m.run_until([&] { return first.Done; }));
  EXPECT_EQ(m.velocity(), 0.0);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_EQ(m.axis_.data.ModuloCycle, 0);
  auto& third = m.to(350.0, 200.0);
  m.run(20);
  auto& fourth = m.to(100.0, 200.0, kPrevious);
  ASSERT_TRUE(m.run_until([&] { return third.Done; }));
  EXPECT_GT(m.velocity(), 50.0);
  ASSERT_TRUE(m.run_until([&] { return fourth.Done; }));
  EXPECT_EQ(m.position(), 100.0);
  EXPECT_EQ(m.axis_.data.ModuloCycle, 1);
}

TEST(BufferMode, TheNextMotionTakesOverWhatIsSuperimposed) {
  Machine m;
  auto& first = m.by(100.0, 100.0);
  m.run(20);
  m.superimposed.Distance = 1000.0;
  m.superimposed.VelocityDiff = 30.0;
  m.superimposed.Execute = true;
  auto& second = m.by(100.0, 100.0, kLow);
  ASSERT_TRUE(m.run_until([&] { return first.Done; }));
  EXPECT_TRUE(m.superimposed.Busy || m.superimposed.CommandAborted);
  m.run(1);
  EXPECT_TRUE(m.superimposed.CommandAborted);
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_GT(m.position(), 205.0);
  EXPECT_LT(m.position(), 240.0);
}

/// Chains of motions at random: every one ends where it should, none turns back on a way ahead, and nothing
/// steps.
TEST(BufferMode, ChainsOfMotionsAtRandomGoOnWithoutAStep) {
  int blended = 0;
  const test::Cases ran = test::for_each_seed(17, test::cases(150, 15'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    Machine m;
    MC_MoveRelative* moves[] = {&m.block<MC_MoveRelative>(), &m.block<MC_MoveRelative>()};
    double expected = 0.0;
    for (int i = 0; i < 12; ++i) {
      MC_MoveRelative& move = *moves[i % 2];
      MC_MoveRelative& before = *moves[(i + 1) % 2];
      move.Axis = &m.axis_;
      move.Execute = false;
      m.run(1);
      move.Distance = uniform(0.5, 60.0);
      move.Velocity = uniform(10.0, 300.0);
      move.Acceleration = uniform(500.0, 5000.0);
      move.Deceleration = uniform(500.0, 5000.0);
      move.Jerk = uniform(5000.0, 100000.0);
      move.BufferMode = static_cast<INT>(kBuffered + random() % 5);
      expected += move.Distance;
      move.Execute = true;
      if (i == 0) {
        m.run(static_cast<int>(random() % 40));
        continue;
      }
      ASSERT_TRUE(m.run_until([&] {
        EXPECT_GE(m.velocity(), -1e-9);
        return before.Done || testing::Test::HasFailure();
      }));
      blended += m.velocity() > 1.0;
      m.run(static_cast<int>(random() % 30));
      if (testing::Test::HasFailure()) return;
    }
    ASSERT_TRUE(m.run_until([&] { return moves[1]->Done; }));
    ASSERT_NEAR(m.position(), expected, 1e-10);
  });
  if (ran.alone) return;
  EXPECT_GT(blended, ran.count * 10 / 3);
}

}  // namespace
}  // namespace lockstep::buffer_mode_test
