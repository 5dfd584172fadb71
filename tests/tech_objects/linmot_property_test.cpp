// A LinMot controller by chance: states against a model of their own, the V/A limiter, curves that run for
// long.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "tech_objects/linmot/curve.hpp"
#include "tech_objects/linmot/curve_player.hpp"
#include "tech_objects/linmot/limiter.hpp"
#include "tech_objects/linmot/states.hpp"
#include "tests/support/property.hpp"

namespace lockstep::linmot_property_test {
namespace {

using linmot::State;
using linmot::StateFacts;

// ---- States: the table as it is written in words, in a form of its own

struct Facts {
  bool run, init, stop, error, cause, homed, homing_over, automatic, warning;
};

State expected_state(State from, const Facts& facts) {
  const bool clear = !facts.run && !facts.init && !facts.stop;
  if (facts.error && from != State::error) return State::error;
  switch (from) {
    case State::error:
      return clear && !facts.cause ? State::disable : State::error;
    case State::stop:
    case State::wait_for_disable:
      return clear ? State::disable : from;
    case State::disable:
      if (facts.stop) return from;
      if (facts.init) return State::init;
      return facts.run && facts.homed ? State::run : from;
    case State::init:
      if (facts.stop) return State::stop;
      if (facts.homing_over && facts.homed) {
        if (facts.run && !facts.init) return State::run;
        if (facts.automatic && clear && !facts.warning) return State::run;
      }
      return !facts.init && !facts.run && !facts.automatic ? State::disable : from;
    case State::run:
      if (facts.stop) return State::stop;
      return facts.run || facts.automatic ? from : State::disable;
  }
  return from;
}

constexpr int kFacts = 9;

Facts facts_of(int bits) {
  const auto has = [bits](int bit) { return (bits >> bit & 1) != 0; };
  return {.run = has(0),
          .init = has(1),
          .stop = has(2),
          .error = has(3),
          .cause = has(4),
          .homed = has(5),
          .homing_over = has(6),
          .automatic = has(7),
          .warning = has(8)};
}

StateFacts word_of(const Facts& facts) {
  using namespace linmot::fact;
  const std::pair<bool, StateFacts> all[] = {{facts.run, kRun},
                                             {facts.init, kInit},
                                             {facts.stop, kStop},
                                             {facts.error, kError},
                                             {facts.cause, kCause},
                                             {facts.homed, kHomed},
                                             {facts.homing_over, kHomingOver},
                                             {facts.automatic, kAutomatic},
                                             {facts.warning, kWarning}};
  unsigned word = 0;
  for (const auto& [so, bit] : all) word |= so ? bit : 0u;
  return static_cast<StateFacts>(word);
}

TEST(LinMotStates, FollowTheTable) {
  int changes = 0;
  for (int bits = 0; bits < 1 << kFacts; ++bits)
    for (int state = 0; state < 6; ++state) {
      const auto from = static_cast<State>(state);
      const State to = linmot::next_state(from, word_of(facts_of(bits)));
      EXPECT_EQ(to, expected_state(from, facts_of(bits))) << state << " with " << bits;
      changes += to != from ? 1 : 0;
    }
  EXPECT_GT(changes, 1000);
}

TEST(LinMotStates, BeginWithWhatIsRequested) {
  for (int bits = 0; bits < 1 << kFacts; ++bits) {
    const Facts facts = facts_of(bits);
    const State state = linmot::first_state(word_of(facts));
    const bool requested = facts.run || facts.init || facts.stop;
    const State otherwise = requested ? State::wait_for_disable : State::disable;
    EXPECT_EQ(state, facts.automatic ? State::init : otherwise);
  }
}

// ---- The V/A limiter

// Retargeted at random, in motion: it keeps to velocity and acceleration, and does not step.
TEST(LinMotLimiterProperty, KeepsItsLimitsAndArrives) {
  std::mt19937_64 random(test::seed_of_test(20261124));
  const auto between = [&random](double lowest, double highest) {
    return std::uniform_real_distribution<double>(lowest, highest)(random);
  };
  constexpr double kCycle = 1e-4;
  linmot::Limiter limiter;
  limiter.configure(kCycle);
  limiter.begin(0.0);
  LoopSetpoint last{};
  double acceleration = 0.0;  // of the motion before
  const int retargets = test::cases(10'000, 1'000'000);
  for (int i = 0; i < retargets; ++i) {
    const linmot::Limits limits{between(10.0, 1000.0), between(500.0, 50'000.0)};
    const double target = between(-300.0, 300.0);
    limiter.go_to(target, limits);
    // A velocity beyond the limit comes down to it.
    const double fastest = std::max(limits.velocity, std::abs(last.velocity) + acceleration * kCycle);
    acceleration = limits.acceleration;
    for (int k = 0; k < 20; ++k) {
      const LoopSetpoint now = limiter.step();
      ASSERT_TRUE(std::isfinite(now.position)) << i;
      ASSERT_LE(std::abs(now.velocity), fastest * (1.0 + 1e-9)) << i;
      if (k > 0) {
        ASSERT_LE(std::abs(now.velocity - last.velocity), limits.acceleration * kCycle * (1.0 + 1e-6) + 1e-9)
            << i;
      }
      ASSERT_LE(std::abs(now.position - last.position), fastest * kCycle * (1.0 + 1e-6) + 1e-9) << i;
      last = now;
    }
    if (i % 1000 != 0) continue;
    for (int k = 0; k < 1'000'000 && !limiter.at_end(); ++k) last = limiter.step();
    EXPECT_EQ(limiter.step().position, target) << i;
    last = limiter.step();
  }
}

// The limiter is the profile of the kernel, begun where the set-point is: the same figures, whatever came
// before.
TEST(LinMotLimiterProperty, IsTheProfileOfTheKernel) {
  std::mt19937_64 random(test::seed_of_test(3));
  const auto between = [&random](double lowest, double highest) {
    return std::uniform_real_distribution<double>(lowest, highest)(random);
  };
  constexpr double kCycle = 1e-4;
  linmot::Limiter limiter;
  limiter.configure(kCycle);
  limiter.begin(0.0);
  Profile before;  // that of the last demand
  bool moved = false;
  int cycles = 0;
  for (int i = 0; i < test::cases(10'000, 1'000'000); ++i) {
    const linmot::Limits limits{between(10.0, 1000.0), between(500.0, 50'000.0)};
    const double target = between(-300.0, 300.0);
    MotionState start = moved ? before.at(cycles * kCycle) : MotionState{};
    start.acceleration = 0.0;
    if (moved && cycles * kCycle >= before.duration()) start = {before.target().position, 0.0, 0.0};
    Profile profile;
    ASSERT_EQ(
        plan_position(start, target, 0.0,
                      {limits.velocity, -limits.velocity, limits.acceleration, limits.acceleration, 0.0},
                      profile),
        PlanResult::ok);
    limiter.go_to(target, limits);
    const int until = 1 + static_cast<int>(between(0.0, 40.0));
    for (cycles = 0; cycles < until; ++cycles) {
      const LoopSetpoint now = limiter.step();
      const double time = cycles * kCycle;
      ASSERT_EQ(now.position, time < profile.duration() ? profile.at(time).position : target) << i;
    }
    before = profile;
    moved = true;
  }
}

TEST(LinMotLimiter, TakesTheTimeOfTheFormula) {
  constexpr double kCycle = 1e-4;
  for (const double distance : {0.1, 1.0, 19.0, 21.0, 100.0, 600.0}) {
    linmot::Limiter limiter;
    limiter.configure(kCycle);
    limiter.begin(0.0);
    const linmot::Limits limits;  // the basic setting
    limiter.go_to(distance, limits);
    const double ramps = limits.velocity * limits.velocity / limits.acceleration;
    const double time = distance >= ramps ? limits.velocity / limits.acceleration + distance / limits.velocity
                                          : 2.0 * std::sqrt(distance / limits.acceleration);
    EXPECT_NEAR(limiter.duration(), time, 1e-12) << distance;
  }
}

// ---- Curves

// The k-th run of a cyclic curve begins at k times its duration, however many there were.
TEST(LinMotCurvePlayer, DoesNotDrift) {
  linmot::CurvePart part;
  part.end = 30.0;
  part.time = 0.0004;  // four control cycles: a million of runs are four million of them
  linmot::Curve curve;
  ASSERT_TRUE(curve.make({&part, 1}));
  constexpr double kCycle = 1e-4;
  linmot::CurvePlayer player;
  player.configure(kCycle);
  player.start(curve, true, 1.0);
  const std::int64_t runs = test::cases(10'000, 1'000'000);
  std::int64_t cycle = 0;
  for (std::int64_t run = 0; run < runs; ++run) {
    while (player.runs() < run) {
      player.step(0.0, 1.0);
      ++cycle;
    }
    // The cycle in which a run is seen to have begun is the first at or behind its begin.
    const double begin = static_cast<double>(run) * curve.duration();
    const double now = static_cast<double>(run == 0 ? cycle : cycle - 1) * kCycle;
    const double ulp = std::nextafter(begin, 1e9) - begin;
    ASSERT_GE(now, begin - 1e-12 - ulp) << run;
    ASSERT_LT(now, begin + kCycle - 1e-12 + ulp) << run;
  }
}

TEST(LinMotCurvePlayer, BrakesAndGoesOnAlongTheCurve) {
  linmot::CurvePart part;
  part.end = 30.0;
  part.time = 0.4;
  linmot::Curve curve;
  ASSERT_TRUE(curve.make({&part, 1}));
  linmot::CurvePlayer player;
  player.configure(1e-4);
  player.start(curve, false, 1.0);
  for (int i = 0; i < 2000; ++i) player.step(0.0, 1.0);
  constexpr double kAcceleration = 30517.578125;  // [mm/s²]
  const double velocity = curve.function().value(player.time()).first_derivative;
  player.ramp_to(0.0, velocity / kAcceleration);
  const double from = curve.function().value(player.time()).position;
  LoopSetpoint last{}, now{};
  int cycles = 0;
  double fastest = velocity;
  do {
    last = now;
    now = player.step(0.0, 1.0);
    EXPECT_LE(now.velocity, fastest + 1e-9);
    fastest = now.velocity;
    ++cycles;
  } while (now.velocity > 0.0 && cycles < 10'000);
  EXPECT_NEAR(cycles * 1e-4, velocity / kAcceleration, 3e-4);
  EXPECT_NEAR(now.position - from, 0.5 * velocity * velocity / kAcceleration, 0.02);
  player.ramp_to(1.0, velocity / kAcceleration);
  for (int i = 0; i < 10'000 && player.running(); ++i) now = player.step(0.0, 1.0);
  EXPECT_EQ(now.position, 30.0);
}

TEST(LinMotCurve, LowersASpeedThatCannotBeReached) {
  linmot::CurvePart part;
  part.type = linmot::CurveType::limited_jerk;
  part.end = 5.0;
  part.speed = 2.0;
  part.acceleration = 20.0;
  part.jerk = 1000.0;
  linmot::Curve curve;
  ASSERT_TRUE(curve.make({&part, 1}));
  const linmot::CurvePeaks peaks = curve.peaks();
  EXPECT_LT(peaks.velocity, 0.5);
  EXPECT_LE(peaks.acceleration, 20.0 * (1.0 + 1e-9));
  EXPECT_NEAR(peaks.jerk, 1000.0, 1e-6);
  EXPECT_EQ(curve.end(), 5.0);
}

}  // namespace
}  // namespace lockstep::linmot_property_test
