#include "tech_objects/profile/velocity_tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "tests/support/property.hpp"

namespace lockstep::velocity_tracking_test {
namespace {

/// The target's motion over time.
using Target = std::function<TrackingMotion(double time)>;

struct Chase {
  int synchronous_at = -1;  // tick
  TrackingMotion last;
  double distance = 0.0;
};

/// Follows the target for `ticks` and asserts in each that limits and continuity hold and that the axis, once
/// synchronous, stays so when `stays` says it must.
Chase follow(TrackingMotion own, const Target& target, const TrackingLimits& limits, double period, int ticks,
             bool stays = true) {
  Chase run;
  for (int tick = 1; tick <= ticks; ++tick) {
    const TrackingMotion goal = target(tick * period);
    const TrackingStep step = track_velocity(own, goal, limits, period);
    const double maximum = std::max(limits.acceleration, limits.deceleration) * (1.0 + 1e-12);
    EXPECT_LE(std::abs(step.acceleration), maximum) << tick;
    const double bound = step.velocity * step.acceleration > 0.0   ? limits.acceleration
                         : step.velocity * step.acceleration < 0.0 ? limits.deceleration
                                                                   : maximum;
    EXPECT_LE(std::abs(step.acceleration), bound * (1.0 + 1e-12))
        << "at " << step.velocity << " in tick " << tick;
    EXPECT_LE(std::abs(step.velocity - own.velocity), maximum * period + 1e-12 * std::abs(step.velocity))
        << tick;
    if (step.velocity * own.velocity > 0.0 && std::abs(step.velocity) > std::abs(own.velocity)) {
      EXPECT_LE(std::abs(step.velocity - own.velocity),
                limits.acceleration * (1.0 + 1e-12) * period + 1e-12 * std::abs(step.velocity))
          << "speeds up harder than it may in tick " << tick;
    }
    if (limits.jerk > 0.0) {
      EXPECT_LE(std::abs(step.acceleration - own.acceleration),
                limits.jerk * period * (1.0 + 1e-12) + 1e-13 * maximum)
          << tick;
      const double trapezoid = 0.5 * (own.velocity + step.velocity) * period;
      EXPECT_NEAR(step.distance, trapezoid,
                  limits.jerk * period * period * period / 6.0 + 1e-13 * std::abs(trapezoid))
          << "way and velocity part in tick " << tick;
    }
    if (step.synchronous) {
      EXPECT_EQ(step.velocity, goal.velocity);
      EXPECT_EQ(step.acceleration, goal.acceleration);
      if (run.synchronous_at < 0) run.synchronous_at = tick;
    } else if (stays) {
      EXPECT_LT(run.synchronous_at, 0) << "lost again in tick " << tick;
    }
    if (run.synchronous_at < 0) {  // what was synchronous may have to leave its limits behind
      EXPECT_LE(std::abs(step.velocity), std::max(limits.velocity, std::abs(own.velocity)) * (1.0 + 1e-12))
          << tick;
    }
    own = {step.velocity, step.acceleration};
    run.distance += step.distance;
    if (::testing::Test::HasFailure()) break;
  }
  run.last = own;
  return run;
}

/// Leading motion with trapezoidal acceleration: jerk up, hold, jerk down to rest at the end velocity.
Target s_curve(double velocity, double acceleration, double jerk) {
  return [=](double time) -> TrackingMotion {
    const double ramp = acceleration / jerk;
    const double hold = velocity / acceleration - ramp;
    if (time < ramp) return {0.5 * jerk * time * time, jerk * time};
    if (time < ramp + hold) return {0.5 * jerk * ramp * ramp + acceleration * (time - ramp), acceleration};
    const double rest = 2.0 * ramp + hold - time;
    if (rest > 0.0) return {velocity - 0.5 * jerk * rest * rest, jerk * rest};
    return {velocity, 0.0};
  };
}

const TrackingLimits kLimits{500.0, 1000.0, 1500.0, 20000.0};

TEST(VelocityTracking, AConstantVelocityIsReachedInTheTimeOptimalTime) {
  for (const double period : {0.00025, 0.0005, 0.001, 0.002, 0.004}) {
    const Chase run = follow(
        {},
        [](double) {
          return TrackingMotion{100.0, 0.0};
        },
        kLimits, period, 2000);
    // 50 ms up, 50 ms hold, 50 ms down.
    EXPECT_NEAR(run.synchronous_at * period, 0.15, 1.001 * period) << period;
    EXPECT_NEAR(run.distance, 100.0 * 2000 * period - 7.5, 1e-9) << period;
  }
}

TEST(VelocityTracking, ARunningAxisComesToRestWithAStandingTarget) {
  const Chase run = follow(
      {300.0, 500.0}, [](double) { return TrackingMotion{}; }, kLimits, 0.001, 1000);
  EXPECT_GT(run.synchronous_at, 0);
  EXPECT_EQ(run.last.velocity, 0.0);
  EXPECT_EQ(run.last.acceleration, 0.0);
}

TEST(VelocityTracking, AConstantAccelerationInsideTheLimitsIsReachedAndHeld) {
  const Target ramp = [](double time) { return TrackingMotion{50.0 + 300.0 * time, 300.0}; };
  const Chase run = follow({}, ramp, kLimits, 0.001, 1000);
  EXPECT_GT(run.synchronous_at, 0);
  EXPECT_LT(run.synchronous_at, 300);
}

TEST(VelocityTracking, OnceSynchronousItFollowsAnyJerkUpToItsOwnWithoutLosingIt) {
  for (const double period : {0.00025, 0.001, 0.004})
    for (const double share : {0.1, 0.5, 0.999}) {
      const Chase run = follow({}, s_curve(300.0, 700.0, share * kLimits.jerk), kLimits, period,
                               static_cast<int>(2.0 / period));
      EXPECT_EQ(run.synchronous_at, 1) << period << " " << share;
      EXPECT_EQ(run.last.velocity, 300.0);
    }
}

TEST(VelocityTracking, ASteeperTargetIsCaughtAfterItsRamp) {
  const Chase run = follow({}, s_curve(400.0, 5000.0, 500000.0), kLimits, 0.001, 1500, false);
  EXPECT_EQ(run.last.velocity, 400.0);
  EXPECT_EQ(run.last.acceleration, 0.0);
}

TEST(VelocityTracking, ATargetBeyondTheVelocityLimitIsNotSynchronous) {
  for (const double slope : {100.0, 900.0})
    for (const double from : {0.0, 400.0}) {
      const Target ramp = [slope](double time) { return TrackingMotion{450.0 + slope * time, slope}; };
      const Chase run = follow({from, 0.0}, ramp, kLimits, 0.001, 2000, false);
      EXPECT_EQ(run.last.velocity, 500.0);
      EXPECT_EQ(run.last.acceleration, 0.0);
    }
  const Chase run = follow(
      {},
      [](double) {
        return TrackingMotion{-600.0, 0.0};
      },
      kLimits, 0.001, 2000);
  EXPECT_EQ(run.last.velocity, -500.0);
  EXPECT_LT(run.synchronous_at, 0);
}

TEST(VelocityTracking, AReversalKeepsSpeedingUpAndSlowingDownApart) {
  for (const TrackingLimits& limits :
       {TrackingLimits{500.0, 500.0, 2000.0, 20000.0}, TrackingLimits{500.0, 2000.0, 500.0, 20000.0},
        TrackingLimits{500.0, 500.0, 2000.0, 0.0}, TrackingLimits{500.0, 2000.0, 500.0, 0.0}}) {
    for (const double from : {300.0, -300.0}) {
      const Chase run = follow(
          {from, 0.0},
          [from](double) {
            return TrackingMotion{-from, 0.0};
          },
          limits, 0.001, 2000);
      const double minimum = 300.0 / limits.acceleration + 300.0 / limits.deceleration;
      const double corners = limits.jerk > 0.0 ? 2500.0 / limits.jerk : 0.0;
      EXPECT_GE(run.synchronous_at * 0.001, minimum - 0.001);
      EXPECT_LE(run.synchronous_at * 0.001, minimum + corners + 0.003);
    }
  }
}

TEST(VelocityTracking, WithoutJerkTheWayIsExactAcrossTheMeeting) {
  const TrackingLimits limits{500.0, 1000.0, 1000.0, 0.0};
  const Chase run = follow(
      {},
      [](double) {
        return TrackingMotion{99.7, 0.0};
      },
      limits, 0.001, 200);
  EXPECT_EQ(run.synchronous_at, 100);
  EXPECT_NEAR(run.distance, 99.7 * 0.2 - 99.7 * 99.7 / 2000.0, 1e-12);
  const Chase reversal = follow(
      {100.0, 0.0},
      [](double) {
        return TrackingMotion{-50.0, 0.0};
      },
      limits, 0.0007, 400);
  EXPECT_NEAR(reversal.distance, 5.0 - 1.25 - 50.0 * (0.28 - 0.15), 1e-12);
}

TEST(VelocityTracking, TakesTheTimeAndTheWayOfAnIndependentTimeOptimalGenerator) {
  std::ifstream file(LOCKSTEP_TEST_DATA "/otg_velocity.csv");
  ASSERT_TRUE(file.is_open());
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    double v0, a0, v1, amax, jmax, duration, distance;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &v0, &a0, &v1, &amax, &jmax, &duration,
                    &distance) != 7)
      continue;
    ++rows;
    // Replanned in every one of some hundred ticks; velocity limit out of the way.
    const double period = duration / 173.3;
    const TrackingLimits limits{1e9, amax, amax, jmax};
    const Chase run = follow(
        {v0, a0},
        [v1](double) {
          return TrackingMotion{v1, 0.0};
        },
        limits, period, 180);
    EXPECT_NEAR(run.synchronous_at * period, duration, 1.001 * period) << line;
    EXPECT_GE(run.synchronous_at * period, duration * (1.0 - 1e-6)) << line;
    EXPECT_NEAR(run.distance, distance + v1 * (180 * period - duration), 1e-6 * (1.0 + std::abs(distance)))
        << line;
  }
  EXPECT_GT(rows, 1900);
}

TEST(VelocityTracking, RandomSituationsConvergeInsideTheirLimits) {
  test::for_each_seed(17, test::cases(1500, 150'000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto size = [&](double low, double high) {
      return low * std::pow(high / low, 0.5 + 0.5 * any(random));
    };
    TrackingLimits limits{1000.0, size(100.0, 1e5), size(100.0, 1e5), 0.0};
    limits.jerk = one.seed % 5 == 0 ? 0.0 : size(1e3, 1e8);
    const double period = size(0.00025, 0.004);
    const double gentle = std::min(limits.acceleration, limits.deceleration);
    TrackingMotion own{600.0 * any(random), 0.0};
    if (one.seed % 2 == 0) {  // moving, with an acceleration that is not bound to pass the velocity limit
      const double maximum =
          std::min({limits.acceleration, limits.deceleration, std::sqrt(600.0 * limits.jerk)});
      own.acceleration = maximum * any(random);
      if (own.velocity * own.acceleration < 0.0) own.acceleration = -own.acceleration;
    }
    const double end = 800.0 * any(random);
    const double slope = one.seed % 3 == 0 ? 0.0 : 0.5 * gentle * any(random);
    const double start = end - slope * 0.2;
    // A ramp for 0.2 s, then constant: the step in acceleration is beyond any jerk.
    const Target target = [=](double time) {
      return time < 0.2 ? TrackingMotion{std::clamp(start + slope * time, -900.0, 900.0), slope}
                        : TrackingMotion{std::clamp(end, -900.0, 900.0), 0.0};
    };
    const double longest = 0.2 + 6.0 * 1900.0 / gentle + (limits.jerk > 0.0 ? 6.0 * 1e5 / limits.jerk : 0.0);
    const int ticks = std::min(20000, static_cast<int>(longest / period) + 2);
    const Chase run = follow(own, target, limits, period, ticks, false);
    if (ticks < 20000) {
      EXPECT_EQ(run.last.velocity, end);
      EXPECT_EQ(run.last.acceleration, 0.0);
    }
  });
}

}  // namespace
}  // namespace lockstep::velocity_tracking_test
