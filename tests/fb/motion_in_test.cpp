// Setpoints from the program on the bench. What is given counts as it is: steps of the given size are
// published.
#include "fb/motion_in.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::motion_in_test {
namespace {

using test::Rig;

constexpr double kNone[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};

struct Machine : Rig {
  explicit Machine(const std::function<void(AxisData&)>& configure = {})
      : axis_(axis("Axis",
                   [&](AxisData& data) {
                     data.DynamicLimits = {500.0, 500.0, 5000.0, 5000.0, 100000.0};
                     if (configure) configure(data);
                   })),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        relative(block<MC_MoveRelative>()),
        halt(block<MC_Halt>()),
        stop(block<MC_Stop>()),
        superimposed(block<MC_MoveSuperimposed>()),
        velocity(block<MC_MotionInVelocity>()),
        position(block<MC_MotionInPosition>()) {
    power.Axis = home.Axis = relative.Axis = halt.Axis = stop.Axis = superimposed.Axis = &axis_;
    velocity.Axis = position.Axis = &axis_;
    power.Enable = home.Execute = true;
    Rig::run(5);
  }

  void let_step(bool on) { continuity[0].velocity = !on; }
  bool shows(StatusBit bit) const { return has_bit(axis_.data.StatusWord, bit); }

  Axis& axis_;
  MC_Power& power;
  MC_Home& home;
  MC_MoveRelative& relative;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_MoveSuperimposed& superimposed;
  MC_MotionInVelocity& velocity;
  MC_MotionInPosition& position;
};

/// The product of such values is 0.
TEST(MC_MotionInVelocity, ShowsWhetherItSpeedsUpHoweverSmallTheValuesAre) {
  for (const double side : {1.0, -1.0}) {
    Machine m;
    m.velocity.Velocity = 1e-170;
    m.velocity.Acceleration = side * 1e-170;
    m.velocity.Enable = true;
    m.run(3);
    EXPECT_EQ(m.shows(StatusBit::Accelerating), side > 0.0);
    EXPECT_EQ(m.shows(StatusBit::Decelerating), side < 0.0);
  }
}

TEST(MC_MotionInVelocity, MovesTheAxisAsGivenInEveryCall) {
  Machine m;
  m.velocity.Enable = true;
  m.run(1);
  EXPECT_TRUE(m.velocity.Busy);
  double expected = 0.0, last = 0.0;
  m.run(1);
  for (int i = 1; i <= 300; ++i) {
    m.velocity.Velocity = 40.0 * std::sin(0.01 * i);
    m.velocity.Acceleration = 400.0 * std::cos(0.01 * i);
    const double counts = i == 1 ? 0.0 : 40.0 * std::sin(0.01 * (i - 1));
    m.tick();
    expected += 0.5 * (last + counts) * 0.001;
    last = counts;
    ASSERT_EQ(m.axis_.data.Velocity, counts);
    ASSERT_NEAR(m.axis_.data.Position, expected, 1e-12);
  }
  EXPECT_TRUE(m.shows(StatusBit::MotionInCommand));
  EXPECT_EQ(m.axis_.data.StatusMotionIn.FunctionState, 1);
}

TEST(MC_MotionInVelocity, StepsByWhatIsGivenAndToZeroAtOnceWithoutEnable) {
  Machine m;
  m.let_step(true);
  m.velocity.Velocity = 700.0;
  m.velocity.Enable = true;
  m.run(2);
  EXPECT_EQ(m.axis_.data.Velocity, 700.0) << "beyond the limits, in one cycle";
  EXPECT_TRUE(has_bit(m.axis_.data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded));
  m.velocity.Enable = false;
  m.run(1);
  EXPECT_FALSE(m.velocity.Busy);
  m.run(1);
  EXPECT_EQ(m.axis_.data.Velocity, 0.0);
  const double rest = m.axis_.data.Position;
  EXPECT_FALSE(m.shows(StatusBit::MotionInCommand));
  EXPECT_FALSE(has_bit(m.axis_.data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded));
  EXPECT_EQ(m.axis_.data.StatusMotionIn.FunctionState, 0);
  m.let_step(false);
  m.run(20);
  EXPECT_EQ(m.axis_.data.Position, rest);
  EXPECT_TRUE(m.axis_.setpoint().standing());
}

TEST(MC_MotionInVelocity, SetsThePositionControlThatOutlivesIt) {
  Machine m;
  m.velocity.PositionControlled = false;
  m.velocity.Enable = true;
  m.run(3);
  EXPECT_TRUE(m.shows(StatusBit::NonPositionControlled));
  m.velocity.Enable = false;
  m.run(3);
  EXPECT_TRUE(m.shows(StatusBit::NonPositionControlled));
  m.position.Enable = true;
  m.run(3);
  EXPECT_FALSE(m.shows(StatusBit::NonPositionControlled)) << "MC_MotionInPosition needs it";
}

TEST(MC_MotionInVelocity, HandsVelocityAndAccelerationOverWithoutAStep) {
  Machine m;
  m.continuity[0] = {true, true, 5000.0, 2e5};
  m.velocity.Enable = true;
  double v = 0.0;
  for (int i = 0; i < 100; ++i) {
    m.velocity.Acceleration = std::min(1000.0, 100.0 * i);
    v += 0.001 * m.velocity.Acceleration;
    m.velocity.Velocity = v;
    m.tick();
  }
  const double before = m.axis_.data.Velocity;
  m.halt.Execute = true;
  m.run(2);
  EXPECT_TRUE(m.velocity.CommandAborted);
  EXPECT_GT(m.axis_.data.Velocity, before) << "the acceleration that was given is run down first";
  ASSERT_TRUE(m.run_until([&] { return m.halt.Done; }));
  EXPECT_TRUE(m.velocity.CommandAborted) << "while Enable is TRUE";
  m.velocity.Enable = false;
  m.run(1);
  EXPECT_FALSE(m.velocity.CommandAborted);
}

TEST(MC_MotionInVelocity, StopsWithMaximumDynamicsOnAValueThatIsNone) {
  for (const double none : kNone)
    for (const bool at_acceleration : {false, true}) {
      Machine m;
      m.let_step(true);
      m.velocity.Velocity = 200.0;
      m.velocity.Enable = true;
      m.run(20);
      m.let_step(false);
      (at_acceleration ? m.velocity.Acceleration : m.velocity.Velocity) = none;
      m.tick();
      EXPECT_TRUE(m.velocity.Error);
      EXPECT_FALSE(m.velocity.Busy);
      EXPECT_EQ(m.velocity.ErrorID,
                static_cast<WORD>(at_acceleration ? ErrorId::acceleration : ErrorId::velocity));
      int ticks = 0;
      ASSERT_TRUE(m.run_until([&] {
        ++ticks;
        return m.axis_.setpoint().standing();
      }));
      EXPECT_GE(ticks, 89) << "200 / 5000 + 5000 / 100000 s";
      EXPECT_LE(ticks, 93);
      EXPECT_FALSE(m.shows(StatusBit::MotionInCommand));
      EXPECT_EQ(m.axis_.data.ErrorDetail.Number, 0u);
      m.velocity.Velocity = m.velocity.Acceleration = 0.0;
      m.run(3);
      EXPECT_TRUE(m.velocity.Error) << "a new start needs a new edge";
      m.velocity.Enable = false;
      m.run(1);
      EXPECT_FALSE(m.velocity.Error);
      m.velocity.Enable = true;
      m.run(3);
      EXPECT_TRUE(m.velocity.Busy);
    }
}

TEST(MC_MotionInVelocity, IsRefusedWithABadValueAtTheStartAndMovesNothing) {
  for (const double none : kNone) {
    Machine m;
    m.velocity.Velocity = none;
    m.velocity.Enable = true;
    m.run(5);
    EXPECT_TRUE(m.velocity.Error);
    EXPECT_TRUE(m.axis_.setpoint().standing());
  }
}

TEST(MC_MotionInVelocity, IsHeldByASoftwareLimit) {
  Machine m([](AxisData& data) {
    data.PositionLimits_SW.Active = true;
    data.PositionLimits_SW.MinPosition = -100.0;
    data.PositionLimits_SW.MaxPosition = 60.0;
  });
  m.let_step(true);
  m.velocity.Velocity = 100.0;
  m.velocity.Enable = true;
  m.run(10);
  m.let_step(false);
  m.run(2000);
  EXPECT_EQ(m.axis_.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kSoftwareLimitReached));
  EXPECT_EQ(m.axis_.data.Position, 60.0);
  EXPECT_TRUE(m.velocity.Error);
}

TEST(MC_MotionInVelocity, IsRejectedWhileMC_StopHoldsTheAxis) {
  Machine m;
  m.stop.Execute = true;
  m.run(10);
  m.velocity.Enable = true;
  m.run(2);
  EXPECT_TRUE(m.velocity.Error);
  EXPECT_EQ(m.velocity.ErrorID, static_cast<WORD>(ErrorId::locked));
}

TEST(MC_MotionInPosition, PutsTheAxisWhereItIsGiven) {
  Machine m;
  m.let_step(true);
  m.position.Position = 3.25;
  m.position.Enable = true;
  m.run(2);
  EXPECT_EQ(m.axis_.data.Position, 3.25) << "in one cycle";
  EXPECT_EQ(m.axis_.data.StatusMotionIn.FunctionState, 2);
  EXPECT_TRUE(m.shows(StatusBit::MotionInCommand));
  m.let_step(false);
  for (int i = 1; i <= 500; ++i) {
    const double w = 0.0125 * i;
    m.position.Position = 3.25 + 5.0 * (1.0 - std::cos(w));
    m.position.Velocity = 62.5 * std::sin(w);
    m.tick();
  }
  m.run(1);
  EXPECT_EQ(m.axis_.data.Position, m.position.Position);
  EXPECT_EQ(m.axis_.data.Velocity, m.position.Velocity);
  m.relative.Distance = 100.0;
  m.relative.Execute = true;
  m.run(2);
  EXPECT_TRUE(m.position.CommandAborted);
  ASSERT_TRUE(m.run_until([&] { return m.relative.Done; }));
}

TEST(MC_MotionInPosition, CountsTheTurnsOfARing) {
  Machine m([](AxisData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = 360.0;
  });
  m.position.Enable = true;
  m.position.Velocity = 100.0;
  m.let_step(true);
  m.run(2);
  m.let_step(false);
  const double start = 0.1;
  for (int i = 0; i < 7500; ++i) {
    m.position.Position = start + 0.1 * i;  // a position beyond the ring is one on it
    m.tick();
  }
  m.run(1);
  EXPECT_EQ(m.axis_.data.ModuloCycle, 2);
  EXPECT_NEAR(m.axis_.data.Position, start + 749.9 - 720.0, 1e-9);
}

TEST(MC_MotionIn, IsBaseOfASuperimposedMotion) {
  Machine m;
  m.let_step(true);
  m.velocity.Velocity = 100.0;
  m.velocity.Enable = true;
  m.run(10);
  m.let_step(false);
  m.superimposed.Distance = 20.0;
  m.superimposed.VelocityDiff = 50.0;
  m.superimposed.Execute = true;
  double fastest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    fastest = std::max(fastest, m.axis_.data.Velocity);
    return m.superimposed.Done;
  }));
  EXPECT_NEAR(fastest, 150.0, 1.0);
  EXPECT_TRUE(m.velocity.Busy);
  EXPECT_EQ(m.axis_.data.StatusPositioning.SuperimposedDistance, 20.0);
}

TEST(MC_MotionIn, EndsWithTheEnable) {
  Machine m;
  m.let_step(true);
  m.velocity.Velocity = 50.0;
  m.velocity.Enable = true;
  m.run(10);
  m.let_step(false);
  m.power.StopMode = 2;
  m.power.Enable = false;
  m.run(2);
  EXPECT_TRUE(m.velocity.CommandAborted);
  ASSERT_TRUE(m.run_until([&] { return m.axis_.off(); }));
  EXPECT_TRUE(m.axis_.setpoint().standing());
}

}  // namespace
}  // namespace lockstep::motion_in_test
