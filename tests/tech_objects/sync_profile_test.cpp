#include "tech_objects/synchronous/sync_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tech_objects/synchronous/gear_function.hpp"
#include "tests/support/property.hpp"

namespace lockstep::sync_profile_test {
namespace {

constexpr Modulo kLine{};
constexpr Modulo kRing{true, 360.0, 0.0};

/// Least slope of the following position x = F + y over the profile, times `to`.
double minimum_slope(const SyncProfile& profile, double end_slope, double to) {
  double minimum = INFINITY;
  for (int i = 0; i <= 2000; ++i)
    minimum = std::min(minimum, to * (end_slope + profile.value(profile.distance() * i / 2000.0).slope));
  return minimum;
}

TEST(SyncProfile, BeginsWithTheMotionOfTheAxisAndEndsOnTheFunctionToTheLastBit) {
  test::for_each_seed(3, test::cases(2000, 200'000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    SyncStart start;
    const bool backward = one.seed % 2 == 0;
    start.leading = {0, any(random) * 1000.0};
    start.leading_velocity = (backward ? -1.0 : 1.0) * (1.0 + 99.0 * std::abs(any(random)));
    start.leading_acceleration = any(random) * 100.0;
    start.following = {0, any(random) * 500.0};
    start.velocity = any(random) * 100.0;
    start.acceleration = any(random) * 100.0;
    const SyncTarget target{{0, any(random) * 500.0}, any(random) * 5.0};
    const double distance = 1.0 + 100.0 * std::abs(any(random));
    SyncProfile profile;
    ASSERT_EQ(profile.plan(start, target, distance, backward, SyncDirection::kShortestPath, kLine, kLine),
              SyncPlan::kReady);
    const double distance_velocity = std::abs(start.leading_velocity);
    const double distance_acceleration = (backward ? -1.0 : 1.0) * start.leading_acceleration;
    const SyncOffset begin = profile.value(0.0);
    EXPECT_EQ(begin.position, start.following.value - target.at_start.value);
    EXPECT_NEAR(target.slope * start.leading_velocity + begin.velocity(distance_velocity), start.velocity,
                1e-9);
    EXPECT_NEAR(target.slope * start.leading_acceleration +
                    begin.acceleration(distance_velocity, distance_acceleration),
                start.acceleration, 1e-6);
    for (const double covered : {distance, distance * 1.5}) {
      const SyncOffset end = profile.value(covered);
      EXPECT_TRUE(end.position == 0.0 && end.slope == 0.0 && end.curvature == 0.0);
    }
    const double step = distance * 1e-6;  // joins with position, slope and curvature
    const SyncOffset near = profile.value(distance - step);
    const double scale = 1e4 * (1.0 + std::abs(begin.position) + distance * std::abs(begin.slope) +
                                distance * distance * std::abs(begin.curvature));
    EXPECT_LE(std::abs(near.position), scale * 1e-18);
    EXPECT_LE(std::abs(near.slope) * distance, scale * 1e-12);
    EXPECT_LE(std::abs(near.curvature) * distance * distance, scale * 1e-6);
  });
}

TEST(SyncProfile, SlopeAndCurvatureAreTheDerivatives) {
  SyncStart start;
  start.leading_velocity = 10.0;
  start.velocity = -30.0;
  start.acceleration = 50.0;
  start.following = {0, 12.0};
  SyncProfile profile;
  profile.plan(start, {{0, 3.0}, 1.5}, 40.0, false, SyncDirection::kShortestPath, kLine, kLine);
  for (double distance = 1.0; distance < 39.0; distance += 0.7) {
    constexpr double kStep = 1e-3;
    const SyncOffset low = profile.value(distance - kStep);
    const SyncOffset high = profile.value(distance + kStep);
    EXPECT_NEAR((high.position - low.position) / (2.0 * kStep), profile.value(distance).slope, 1e-6);
    EXPECT_NEAR((high.slope - low.slope) / (2.0 * kStep), profile.value(distance).curvature, 1e-6);
  }
}

TEST(SyncProfile, AStandingLeadingAxisStartsTheProfileWithSlopeZero) {
  SyncStart start;
  start.velocity = 20.0;
  SyncProfile profile;
  profile.plan(start, {{0, 5.0}, 2.0}, 10.0, false, SyncDirection::kShortestPath, kLine, kLine);
  EXPECT_EQ(2.0 + profile.value(0.0).slope, 0.0);
  EXPECT_EQ(profile.value(0.0).curvature, 0.0);
}

TEST(SyncProfile, ALeadingAxisThatHardlyMovesLeavesTheProfileFinite) {
  SyncStart start;
  start.velocity = 20.0;
  start.acceleration = 5.0;
  for (const double creep : {1e-320, 1e-200, 1e-9}) {
    start.leading_velocity = creep;
    SyncProfile profile;
    profile.plan(start, {{0, 5.0}, 2.0}, 10.0, false, SyncDirection::kShortestPath, kLine, kLine);
    EXPECT_TRUE(std::isfinite(profile.value(3.0).position)) << creep;
    EXPECT_TRUE(std::isfinite(profile.value(3.0).curvature)) << creep;
  }
}

TEST(SyncProfile, TheShortestPathIsAtMostHalfATurn) {
  // 100 units of leading distance into a function that ends at 90.
  const SyncTarget target{{0, 350.0}, 1.0};
  const struct {
    double start;
    double distance;
  } rows[] = {{350.0, 100.0}, {100.0, -10.0}, {200.0, -110.0}, {269.0, -179.0}, {271.0, 179.0}};
  for (const auto& row : rows) {
    SyncStart start;
    start.following = {0, row.start};
    SyncProfile profile;
    ASSERT_EQ(profile.plan(start, target, 100.0, false, SyncDirection::kShortestPath, kLine, kRing),
              SyncPlan::kReady);
    EXPECT_DOUBLE_EQ(100.0 - profile.value(0.0).position, row.distance) << "from " << row.start;
  }
}

TEST(SyncProfile, OneWaySynchronizingTakesTheFewestTurnsThatNeverReverse) {
  int more_than_one = 0;
  int refused = 0;
  const test::Cases ran = test::for_each_seed(5, test::cases(1000, 100'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    const bool backward = one.seed % 2 == 0;
    const double to = one.seed % 4 < 2 ? 1.0 : -1.0;
    SyncStart start;
    start.leading_velocity = (backward ? -1.0 : 1.0) * 10.0;
    start.following = {7, 360.0 * any(random)};
    start.velocity = one.seed % 3 == 0 ? 0.0 : to * 200.0 * any(random);
    start.acceleration = one.seed % 3 == 0 ? 0.0 : 400.0 * (any(random) - 0.5);
    const double end_slope = to * (0.01 + 10.0 * any(random));  // along the way
    const SyncTarget target{{-3, 360.0 * any(random)}, backward ? -end_slope : end_slope};
    const double distance = 1.0 + 200.0 * any(random);
    const auto direction = to > 0.0 ? SyncDirection::kPositive : SyncDirection::kNegative;
    SyncProfile profile;
    if (profile.plan(start, target, distance, backward, direction, kLine, kRing) != SyncPlan::kReady) {
      // One that all but stands and brakes hard: it would have to go for hundreds of turns.
      EXPECT_LT(to * start.acceleration / std::abs(start.velocity), -5.0);
      ++refused;
      return;
    }
    const double scale = std::abs(end_slope) + std::abs(start.velocity) / 10.0;
    EXPECT_GE(minimum_slope(profile, end_slope, to), -1e-9 * scale);
    // With one turn less it would reverse, or there would be no way left to go.
    SyncStart shifted = start;
    shifted.following.turns += static_cast<std::int64_t>(to) - profile.turns();
    SyncProfile shorter;
    const double ahead = difference(shifted.following, target.at_start, kRing).rounded();
    SyncStart on_line = start;
    on_line.following = {0, ahead};
    shorter.plan(on_line, {{0, 0.0}, target.slope}, distance, backward, direction, kLine, kLine);
    EXPECT_LT(minimum_slope(shorter, end_slope, to), 1e-3 * scale);
    more_than_one += std::abs(end_slope * distance - profile.value(0.0).position) > 720.0 ? 1 : 0;
  });
  if (ran.alone) return;
  EXPECT_GT(more_than_one, ran.count / 20);
  EXPECT_LT(refused, ran.count / 50);
}

/// What the end asks for is as large as what rounding leaves of a slope: catching up has a limit.
TEST(SyncProfile, OneWaySynchronizingDoesNotShootIntoAFunctionThatAllButTurnsBack) {
  for (const double slope : {0.0, 1e-300, 1e-17, 1e-9, 1e-5, 1e-3, 0.1})
    for (const double curvature : {-0.5, -0.01, -1e-17, 0.0, 1e-17, 0.01, 0.5}) {
      SyncStart start;
      start.leading_velocity = 10.0;
      SyncProfile profile;
      const SyncTarget target{{0, 5.0}, slope, curvature};
      if (profile.plan(start, target, 50.0, false, SyncDirection::kPositive, kLine, kRing) !=
          SyncPlan::kReady)
        continue;
      const double distance = 50.0 * slope - 0.5 * curvature * 2500.0 - profile.value(0.0).position;
      EXPECT_GE(distance, -1e-9) << slope << ' ' << curvature;
      EXPECT_LT(distance, 2.0 * (50.0 * slope + 2500.0 * std::abs(curvature)) + 720.0)
          << slope << ' ' << curvature;
    }
}

TEST(SyncProfile, OneWaySynchronizingIsRejectedWhereItIsImpossible) {
  SyncStart start;
  start.leading_velocity = 10.0;
  SyncProfile profile;
  const auto plan = [&](double velocity, double acceleration, double slope, SyncDirection direction) {
    start.velocity = velocity;
    start.acceleration = acceleration;
    return profile.plan(start, {{0, 5.0}, slope}, 50.0, false, direction, kLine, kRing);
  };
  EXPECT_EQ(plan(-1.0, 0.0, 1.0, SyncDirection::kPositive), SyncPlan::kAxisMovesInOppositeDirection);
  EXPECT_EQ(plan(0.0, -1.0, 1.0, SyncDirection::kPositive), SyncPlan::kAxisMovesInOppositeDirection);
  EXPECT_EQ(plan(1.0, 0.0, -1.0, SyncDirection::kNegative), SyncPlan::kAxisMovesInOppositeDirection);
  EXPECT_EQ(plan(0.0, 0.0, -1.0, SyncDirection::kPositive), SyncPlan::kFunctionRunsInOppositeDirection);
  EXPECT_EQ(plan(0.0, 0.0, 1.0, SyncDirection::kNegative), SyncPlan::kFunctionRunsInOppositeDirection);
  EXPECT_EQ(plan(0.0, 0.0, 1.0, SyncDirection::kPositive), SyncPlan::kReady);
}

TEST(SyncProfile, TheAxisRunsIntoTheGearWithoutAStepAcrossModuloWraps) {
  GearFunction gear;
  AxisPosition sync{2, 40.0};
  gear.set(-3, 2, sync, {5, 10.0}, kRing, kRing);
  SyncStart start;
  start.leading = advanced(sync, -200.0, kRing);
  start.leading_velocity = 100.0;
  start.following = {9, 250.0};
  start.velocity = -35.0;
  SyncProfile profile;
  ASSERT_EQ(profile.plan(start, {gear.value(start.leading), -1.5}, 200.0, false, SyncDirection::kNegative,
                         kRing, kRing),
            SyncPlan::kReady);
  gear.set(-3, 2, sync, {5 + profile.turns(), 10.0}, kRing, kRing);
  AxisPosition leading = start.leading;
  AxisPosition before = start.following;
  double step_before = start.velocity * 0.001;
  for (int i = 0; i < 2500; ++i) {
    leading = advanced(leading, 0.1, kRing);
    const double distance = profile.covered(leading);
    const AxisPosition now = advanced(gear.value(leading), profile.value(distance).position, kRing);
    const double step = difference(now, before, kRing).rounded();
    ASSERT_LE(step, 1e-12);
    ASSERT_NEAR(step, step_before, 0.01) << i;
    if (profile.complete(distance)) {
      ASSERT_EQ(now, gear.value(leading));
    }
    before = now;
    step_before = step;
  }
  EXPECT_TRUE(profile.complete(profile.covered(leading)));
}

}  // namespace
}  // namespace lockstep::sync_profile_test
