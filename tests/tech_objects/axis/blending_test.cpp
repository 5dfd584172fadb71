// Velocities at the junction of two blended motions, against what the formulas of uniform acceleration give.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::blending_test {
namespace {

using test::Rig;

enum : INT { kAborting, kBuffered, kLow, kPrevious, kNext, kHigh };

struct Motions : Rig {
  explicit Motions(double acceleration, double jerk, bool ring = false)
      : a(axis("Axis",
               [&](AxisData& data) {
                 data.DynamicLimits = {2000.0, 2000.0, 20000.0, 20000.0, 1e6};
                 data.DynamicDefaults = {100.0, acceleration, acceleration, jerk};
                 data.PositioningMonitoring.MinDwellTime = 0.0;
                 data.Modulo.Enable = ring;
               })),
        power(block<MC_Power>()),
        home(block<MC_Home>()) {
    power.Axis = home.Axis = &a;
    power.Enable = home.Execute = true;
    continuity[0] = {true, jerk > 0.0, 20000.0, 1e6};
    run(5);
  }
  MC_MoveRelative& by(double distance, double velocity, INT mode = kAborting) {
    auto& move = block<MC_MoveRelative>();
    move.Axis = &a;
    move.Distance = distance;
    move.Velocity = velocity;
    move.BufferMode = mode;
    move.Execute = true;
    return move;
  }
  MC_MoveAbsolute& to(double position, double velocity, INT mode = kAborting, INT direction = 3) {
    auto& move = block<MC_MoveAbsolute>();
    move.Axis = &a;
    move.Position = position;
    move.Velocity = velocity;
    move.BufferMode = mode;
    move.Direction = direction;
    move.Execute = true;
    return move;
  }
  double velocity() const { return a.data.Velocity; }
  double position() const { return a.data.Position; }

  Axis& a;
  MC_Power& power;
  MC_Home& home;
};

struct Junction {
  INT mode;
  double v1, v2, distance, expected;  // [u/s], [u/s], [u], [u/s] at the junction
};

class AtTheJunction : public testing::TestWithParam<std::tuple<Junction, double, double>> {};

TEST_P(AtTheJunction, HasTheVelocityOfTheModeOrTheHighestThatCanBeReached) {
  const auto [rule, side, jerk] = GetParam();
  Motions m(1000.0, jerk);
  auto& first = m.by(side * rule.distance, rule.v1);
  auto& second = m.by(side * 400.0, rule.v2, rule.mode);
  double before = 0.0, early = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    if (!first.Done) before = std::max(before, side * m.velocity());
    if (side * m.position() < 0.3 * rule.distance) early = std::max(early, side * m.velocity());
    return first.Done;
  }));
  // The rest of the cycle that passes the target belongs to the next motion.
  const double rest = 1000.0 * m.period() + 1e-6;
  EXPECT_NEAR(side * m.velocity(), rule.expected, rest);
  EXPECT_LE(before, std::max(rule.v1, rule.expected) + 1e-6);
  if (rule.distance >= 1000.0) {
    EXPECT_LE(early, rule.v1 + 1e-6) << "it speeds up as late as it can";
  }
  ASSERT_TRUE(m.run_until([&] { return second.Done; }));
  EXPECT_NEAR(m.position(), side * (rule.distance + 400.0), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Modes, AtTheJunction,
                         testing::Combine(testing::Values(Junction{kNext, 40.0, 80.0, 100.0, 80.0},
                                                          Junction{kHigh, 40.0, 80.0, 100.0, 80.0},
                                                          Junction{kLow, 40.0, 80.0, 100.0, 40.0},
                                                          Junction{kPrevious, 40.0, 80.0, 100.0, 40.0},
                                                          Junction{kNext, 80.0, 40.0, 100.0, 40.0},
                                                          Junction{kHigh, 80.0, 40.0, 100.0, 80.0},
                                                          Junction{kLow, 80.0, 40.0, 100.0, 40.0},
                                                          Junction{kPrevious, 80.0, 40.0, 100.0, 80.0},
                                                          Junction{kNext, 60.0, 60.0, 100.0, 60.0},
                                                          Junction{kNext, 250.0, 500.0, 1000.0, 500.0}),
                                          testing::Values(1.0, -1.0), testing::Values(0.0, 50000.0)));

// 250 and 500 u/s with 1000 u/s² over 100 u: v² = 2 a s.
TEST(Blending, OverTooShortADistanceIsAsFastAsCanBeReached) {
  for (const INT mode : {INT{kNext}, INT{kHigh}}) {
    Motions m(1000.0, 0.0);
    auto& first = m.by(100.0, 250.0);
    m.by(1000.0, 500.0, mode);
    ASSERT_TRUE(m.run_until([&] { return first.Done; }));
    EXPECT_NEAR(m.velocity(), std::sqrt(2.0 * 1000.0 * 100.0), 2.0);
  }
}

/// Whatever the numbers: the velocity at the junction is that of the mode, or less by the distance before it
/// or by what the next motion needs to come to rest.
TEST(Blending, AtRandomHasTheVelocityThatUniformAccelerationGives) {
  test::for_each_seed(300, 41, [](const test::Case& one) {
    std::mt19937 random(static_cast<std::mt19937::result_type>(one.seed));
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    const double a = between(200.0, 5000.0), v1 = between(20.0, 500.0), v2 = between(20.0, 500.0);
    const double s1 = between(1.0, 300.0), s2 = between(1.0, 300.0);
    const INT mode = static_cast<INT>(kLow + random() % 4);
    Motions m(a, 0.0);
    auto& first = m.by(s1, v1);
    auto& second = m.by(s2, v2, mode);
    double last = 0.0;
    ASSERT_TRUE(m.run_until([&] {
      EXPECT_GE(m.velocity(), -1e-9) << "it turns back";
      if (!first.Done) last = m.velocity();
      return first.Done;
    }));
    const double wanted = mode == kLow        ? std::min(v1, v2)
                          : mode == kPrevious ? v1
                          : mode == kNext     ? v2
                                              : std::max(v1, v2);
    const double expected = std::min({wanted, std::sqrt(2.0 * a * s1), std::sqrt(2.0 * a * s2)});
    // Two cycles: the next motion may begin up to one behind its start, and its first setpoint shows the end
    // of the cycle.
    EXPECT_NEAR(last, expected, 3.0 * a * m.period() + 2e-3 * expected)
        << "mode " << mode << ", " << v1 << " then " << v2 << " u/s, " << a << " u/s², " << s1 << " and "
        << s2 << " u";
    ASSERT_TRUE(m.run_until([&] { return second.Done; }));
    EXPECT_NEAR(m.position(), s1 + s2, 1e-9);
  });
}

// An absolute target is where the axis calls it so when the job begins, not where it did when the job came.
TEST(Blending, IntoAnAbsoluteTargetCountsFromTheNamesAtItsBeginning) {
  for (const INT mode : {INT{kBuffered}, INT{kNext}}) {
    Motions m(1000.0, 0.0);
    auto& first = m.by(100.0, 50.0);
    auto& second = m.to(200.0, 50.0, mode);
    m.run(500);
    m.continuity[0].homing = true;
    auto& again = m.block<MC_Home>();
    again.Axis = &m.a;
    again.Mode = 1;  // relative: every place is called 30 more
    again.Position = 30.0;
    again.Execute = true;
    ASSERT_TRUE(m.run_until([&] { return first.Done; }));
    EXPECT_NEAR(m.position(), 130.0, 0.1) << "the place of the first target has got another name";
    ASSERT_TRUE(m.run_until([&] { return second.Done; }));
    EXPECT_EQ(m.position(), 200.0);
  }
}

TEST(Blending, OfAJobThatIsTriggeredAnewWhileItWaitsKeepsOneJob) {
  Motions m(1000.0, 0.0);
  auto& first = m.by(100.0, 50.0);
  auto& second = m.by(50.0, 50.0, kBuffered);
  m.run(20);
  second.Execute = false;
  m.run(2);
  EXPECT_TRUE(second.Busy);
  second.Distance = 80.0;
  second.Execute = true;
  m.run(2);
  EXPECT_TRUE(second.Busy);
  EXPECT_FALSE(second.Error);
  ASSERT_TRUE(m.run_until([&] {
    EXPECT_TRUE(second.Busy || second.Done);
    return second.Done;
  }));
  EXPECT_EQ(m.position(), 180.0) << "the new one alone";
  EXPECT_FALSE(first.CommandAborted);
  m.run(1000);
  EXPECT_EQ(m.position(), 180.0);
}

/// Out of a motion that cannot stop in time: on to the next pass, never back.
TEST(DirectedPositioning, ThatCannotStopInTimeGoesOnToTheNextPass) {
  for (const INT direction : {INT{1}, INT{2}}) {
    const double side = direction == 1 ? 1.0 : -1.0;
    for (const double jerk : {0.0, 50000.0}) {
      Motions m(1000.0, jerk, true);
      auto& run_at = m.block<MC_MoveVelocity>();
      run_at.Axis = &m.a;
      run_at.Velocity = side * 200.0;
      run_at.Execute = true;
      ASSERT_TRUE(m.run_until([&] { return run_at.InVelocity; }));
      ASSERT_TRUE(m.run_until([&] { return std::abs(m.position() - 180.0) < 0.2; }));
      auto& move = m.to(180.0 + side * 10.0, 200.0, kAborting, direction);  // it needs 20 to stop
      double travelled = 0.0, before = m.position();
      ASSERT_TRUE(m.run_until([&] {
        EXPECT_GE(side * m.velocity(), -1e-9) << "it turns back";
        travelled += std::remainder(m.position() - before, 360.0);
        before = m.position();
        return move.Done;
      }));
      EXPECT_NEAR(m.position(), 180.0 + side * 10.0, 1e-9);
      EXPECT_NEAR(side * travelled, 370.0, 1.0);
    }
  }
}

TEST(DirectedPositioning, ThatCanStopInTimeDoesNotTurnOnceMore) {
  Motions m(1000.0, 0.0, true);
  auto& run_at = m.block<MC_MoveVelocity>();
  run_at.Axis = &m.a;
  run_at.Velocity = 200.0;
  run_at.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return run_at.InVelocity; }));
  ASSERT_TRUE(m.run_until([&] { return std::abs(m.position() - 180.0) < 0.2; }));
  auto& move = m.to(205.0, 200.0, kAborting, 1);
  ASSERT_TRUE(m.run_until([&] { return move.Done; }, 1000));
  EXPECT_EQ(m.position(), 205.0);
}

}  // namespace
}  // namespace lockstep::blending_test
