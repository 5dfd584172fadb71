// Limited jerk, trapezoid and S-ramp in counts: formulas of the published example, and what holds for any
// motion.
#include "tech_objects/profile/four_slope_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lockstep {
namespace {

/// 3000 RPM, 500 PPR, 500 ms, 200 ms.
constexpr double kVelocity = 100.0, kAcceleration = 0.2, kSlope = 1000.0;

FourSlopeLimits limited_jerk() {
  return {kVelocity, kAcceleration, kAcceleration, {kSlope, kSlope, kSlope, kSlope}, false, true};
}
FourSlopeLimits trapezoid() {
  return {kVelocity, kAcceleration, kAcceleration, {}, false, true};
}

struct Seen {
  int steps = 0;
  double peak = 0.0, steepest = 0.0, sharpest = 0.0;
  std::vector<SlopePhase> phases;
};

Seen seen_of(FourSlopeProfile& profile, int maximum = 100'000) {
  Seen seen;
  FourSlopeState before = profile.state();
  while (!profile.over() && seen.steps < maximum) {
    const FourSlopeState now = profile.step(1.0);
    ++seen.steps;
    seen.peak = std::max(seen.peak, std::abs(now.velocity));
    seen.steepest = std::max(seen.steepest, std::abs(now.velocity - before.velocity));
    seen.sharpest = std::max(seen.sharpest, std::abs(now.acceleration - before.acceleration));
    if (seen.phases.empty() || seen.phases.back() != profile.phase()) seen.phases.push_back(profile.phase());
    before = now;
  }
  return seen;
}

TEST(FourSlopeProfile, StopsAsInThePublishedExample) {
  // v·t - D·t²/6 + (v - D·t/2)·tc - D·tc²/2 + D·t²/6 with t = 200 ms, tc = 100/0.2 - 200 = 300 ms.
  EXPECT_NEAR(FourSlopeProfile::stop_path(kVelocity, 0.0, limited_jerk()), 35'000.0, 1e-6);
  FourSlopeProfile profile;
  profile.to_velocity({0.0, kVelocity, 0.0}, 0.0, limited_jerk());
  EXPECT_NEAR(seen_of(profile).steps, 700, 1);
  EXPECT_NEAR(profile.state().position, 35'000.0, 1e-6);
}

TEST(FourSlopeProfile, PositionsInTheTimeOfItsSlopes) {
  FourSlopeProfile profile;
  profile.to_position({}, 200'000.0, limited_jerk());
  const Seen seen = seen_of(profile);
  EXPECT_NEAR(seen.steps, 2700, 1);  // 700 + 1300 + 700
  EXPECT_EQ(profile.state().position, 200'000.0);
  EXPECT_LE(seen.peak, kVelocity * (1.0 + 1e-12));
  EXPECT_LE(seen.steepest, kAcceleration * (1.0 + 1e-9));
  EXPECT_LE(seen.sharpest, (1.0 + 1e-9) / kSlope);
  std::vector<int> phases;
  for (const SlopePhase phase : seen.phases) phases.push_back(static_cast<int>(phase));
  EXPECT_EQ(phases, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(FourSlopeProfile, OfSlopesZeroIsATrapezoid) {
  FourSlopeProfile profile;
  profile.to_position({}, 200'000.0, trapezoid());
  // 500 ms up, 150,000 counts at 100 per ms, 500 ms down.
  EXPECT_NEAR(seen_of(profile).steps, 2500, 1);
  EXPECT_EQ(profile.state().position, 200'000.0);
}

TEST(FourSlopeProfile, OfAShortDistanceIsATriangle) {
  FourSlopeProfile profile;
  profile.to_position({}, 20.0, trapezoid());
  // √(20·0.2) = 2 counts per ms after 10 ms.
  const Seen seen = seen_of(profile);
  EXPECT_EQ(seen.steps, 20);
  EXPECT_NEAR(seen.peak, 2.0, 1e-9);
}

TEST(FourSlopeProfile, RampsAsAHalfSineInTheSameTime) {
  FourSlopeLimits limits = trapezoid();
  limits.sinusoidal = true;
  FourSlopeProfile profile;
  profile.to_position({}, 200'000.0, limits);
  double largest = 0.0;
  int steps = 0;
  for (; !profile.over() && steps < 10'000; ++steps)
    largest = std::max(largest, profile.step(1.0).acceleration);
  EXPECT_NEAR(steps, 2500, 1);
  EXPECT_NEAR(largest, kAcceleration * 1.5707963267948966, 1e-6);
  EXPECT_EQ(profile.state().position, 200'000.0);
}

TEST(FourSlopeProfile, LetsABrakingThatIsTooHardFallIntoTheOtherDirectionAndComesBack) {
  FourSlopeProfile profile;
  // Falling from -0.2 with 0.001 takes 20 qc/ms: at 5 the velocity passes through 0.
  profile.to_velocity({0.0, 5.0, -0.2}, 0.0, limited_jerk());
  const Seen seen = seen_of(profile);
  EXPECT_LE(seen.sharpest, (1.0 + 1e-9) / kSlope);
  EXPECT_EQ(profile.state().velocity, 0.0);
  EXPECT_LT(profile.state().position, 0.0);
}

/// Any state, any limits: what a motion may do holds, and its end is met.
TEST(FourSlopeProfile, KeepsItsLimitsAndMeetsItsEndFromAnyState) {
  std::mt19937_64 random(20261123);  // NOLINT: a seed that is known
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20'000; ++i) {
    FourSlopeLimits limits;
    limits.velocity = 20.0 + 200.0 * unit(random);
    limits.acceleration = 0.05 + unit(random);
    limits.deceleration = 0.05 + unit(random);
    for (double& slope : limits.slopes) slope = unit(random) < 0.3 ? 0.0 : 300.0 * unit(random);
    const bool moves = unit(random) < 0.5;
    FourSlopeState from{1000.0 * unit(random), 0.0, 0.0};
    if (moves) {
      from.velocity = limits.velocity * (2.0 * unit(random) - 1.0);
      from.acceleration = 3.0 * unit(random) - 1.5;  // it may be more than the new limits allow
    }
    FourSlopeProfile profile;
    const bool to_target = unit(random) < 0.7;
    const double target = from.position + 40'000.0 * (2.0 * unit(random) - 1.0);
    const double velocity = limits.velocity * (2.0 * unit(random) - 1.0);
    if (to_target)
      profile.to_position(from, target, limits);
    else
      profile.to_velocity(from, velocity, limits);
    const double limit = std::max(limits.acceleration, limits.deceleration);
    const double steepest = std::max(limit, std::abs(from.acceleration)) * (1.0 + 1e-6) + 1e-9;
    FourSlopeState before = from;
    int steps = 0;
    while (!profile.over() && steps < 400'000) {
      const FourSlopeState now = profile.step(1.0);
      ++steps;
      ASSERT_LE(std::abs(now.velocity - before.velocity), steepest) << "case " << i << " step " << steps;
      const double mean = (now.velocity + before.velocity) / 2.0;
      ASSERT_LE(std::abs(now.position - before.position - mean), steepest) << "case " << i;
      before = now;
    }
    ASSERT_TRUE(profile.over()) << "case " << i;
    if (to_target)
      ASSERT_EQ(profile.state().position, target) << "case " << i;
    else
      ASSERT_NEAR(profile.state().velocity, velocity, 1e-9) << "case " << i;
  }
}

}  // namespace
}  // namespace lockstep
