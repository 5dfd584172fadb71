// Is a motion to a position the quickest one? Any motion that keeps the limits ends at some position with
// some velocity; the profile planned to there must not take longer. The motions to compare with are built
// here, arc by arc, without the planner; many have the structure of the quickest ones, but differ from it at
// random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>

#include "tech_objects/profile/profile.hpp"
#include "tests/support/property.hpp"

namespace lockstep::profile_oracle_test {
namespace {

constexpr double kShortest = 0.01;  // below it rounding of the velocity is felt in the comparison

int cases() {
  return test::cases(20'000, 1'000'000);
}

/// A motion by hand: arcs of constant jerk, exactly integrated, and watched for the limits.
class HandMadeMotion {
 public:
  HandMadeMotion(const MotionState& start, const ProfileLimits& limits) : limits_(limits), state_(start) {}

  void run(double duration, double jerk) {
    watch(duration, jerk);
    const double t = duration;
    state_.position += t * (state_.velocity + t * (state_.acceleration / 2 + t * jerk / 6));
    state_.velocity += t * (state_.acceleration + t * jerk / 2);
    state_.acceleration += t * jerk;
    time_ += t;
    minimum_ = std::min(minimum_, state_.velocity);
    maximum_ = std::max(maximum_, state_.velocity);
  }

  /// With full jerk to an acceleration, and then along it.
  void accelerate(double acceleration, double along) {
    const double change = acceleration - state_.acceleration;
    run(std::abs(change) / limits_.jerk, std::copysign(limits_.jerk, change));
    state_.acceleration = acceleration;
    run(along, 0.0);
  }

  bool keeps_limits() const { return keeps_; }
  const MotionState& state() const { return state_; }
  double time() const { return time_; }
  double fastest() const { return std::max(maximum_, -minimum_); }

 private:
  // Within an arc the acceleration is monotone, and the velocity has at most one extremum, where it is 0.
  void watch(double duration, double jerk) {
    const double start_velocity = state_.velocity, a = state_.acceleration;
    const auto velocity = [&](double t) { return start_velocity + t * (a + t * jerk / 2); };
    const double still = jerk != 0.0 ? -a / jerk : -1.0;
    if (still > 0.0 && still < duration) keep_velocity(velocity(still));
    keep_velocity(velocity(duration));
    for (int i = 0; i <= 40; ++i) {
      const double t = duration * i / 40;
      keep_acceleration(velocity(t), a + t * jerk);
    }
    const double root = jerk != 0.0 ? a * a - 2 * jerk * start_velocity : -1.0;
    for (const double sign : {-1.0, 1.0}) {  // next to standstill both sides' limits hold
      const double t = jerk != 0.0 && root >= 0.0 ? (-a + sign * std::sqrt(root)) / jerk
                                                  : (a != 0.0 && jerk == 0.0 ? -start_velocity / a : -1.0);
      if (t <= 0.0 || t >= duration) continue;
      const double minimum = std::min(limits_.acceleration, limits_.deceleration);
      if (std::abs(a + t * jerk) > minimum * (1 + 1e-12)) keeps_ = false;
    }
  }
  void keep_velocity(double v) {
    if (v > limits_.velocity_max || v < limits_.velocity_min) keeps_ = false;
  }
  void keep_acceleration(double v, double a) {
    const double limit = a * v >= 0.0 ? limits_.acceleration : limits_.deceleration;
    if (std::abs(a) > limit * (1 + 1e-12)) keeps_ = false;
  }

  ProfileLimits limits_;
  MotionState state_;
  double time_{}, minimum_{}, maximum_{};
  bool keeps_{true};
};

class Oracle {
 public:
  explicit Oracle(bool equal) : equal_(equal) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double power(double low, double high) { return std::pow(10.0, between(low, high)); }

  ProfileLimits limits() {
    ProfileLimits l{power(-1, 1), -power(-1, 1), power(-1, 1), power(-1, 1), power(-1, 1.5)};
    if (random_() % 2 == 0) l.velocity_max = 100.0, l.velocity_min = -100.0;
    if (equal_) l.deceleration = l.acceleration;
    return l;
  }

  /// A start inside the limits, often next to standstill; its acceleration may have to be released.
  MotionState start(const ProfileLimits& l) {
    MotionState s{0.0, between(std::max(l.velocity_min, -10.0), std::min(l.velocity_max, 10.0)), 0.0};
    if (random_() % 2 == 0) s.velocity *= power(-3, 0);
    if (random_() % 3 != 0) {
      const double up = s.velocity > 0.0 ? l.acceleration : l.deceleration;
      const double down = s.velocity > 0.0 ? l.deceleration : l.acceleration;
      s.acceleration = random_() % 3 == 0 ? (random_() % 2 == 0 ? up : -down) : between(-down, up);
    }
    return s;
  }

  /// Two to four accelerations, each held for a while or not at all, then none.
  HandMadeMotion motion(const MotionState& s, const ProfileLimits& l) {
    HandMadeMotion motion{s, l};
    const std::uint64_t arcs = 1 + random_() % 4;
    for (std::uint64_t i = 0; i < arcs; ++i) {
      const double levels[] = {l.acceleration, l.deceleration, std::min(l.acceleration, l.deceleration), 0.0,
                               between(0.0, 1.0) * std::max(l.acceleration, l.deceleration)};
      const double level = levels[random_() % 5] * (random_() % 2 == 0 ? 1.0 : -1.0);
      motion.accelerate(level, random_() % 2 == 0 ? 0.0 : power(-3, 0.5));
    }
    motion.accelerate(0.0, 0.0);
    return motion;
  }

 private:
  bool equal_;
  std::mt19937_64 random_{test::seed_of_test(5318008)};
};

/// Duration of the planned motion. A target next to it counts as well: the quickest motions end at an edge of
/// what can be reached in their time, and the hand-made one ends where rounding takes it.
double planned_duration(const MotionState& s, const HandMadeMotion& to, const ProfileLimits& l) {
  const double nearby = 1e-9 * (std::abs(to.state().position) + to.fastest() * to.time());
  const double v = std::clamp(to.state().velocity, l.velocity_min, l.velocity_max);
  double shortest = std::numeric_limits<double>::infinity();
  for (const double by : {0.0, -nearby, nearby}) {
    Profile profile;
    if (plan_position(s, to.state().position + by, v, l, profile) == PlanResult::ok)
      shortest = std::min(shortest, profile.duration());
    if (shortest <= to.time()) break;
  }
  return shortest;
}

class ProfileOracle : public testing::TestWithParam<bool> {};

TEST_P(ProfileOracle, NoMotionThatKeepsTheLimitsIsQuicker) {
  Oracle oracle{GetParam()};
  int compared = 0, equal = 0;
  for (int i = 0; i < cases(); ++i) {
    const ProfileLimits l = oracle.limits();
    const MotionState s = oracle.start(l);
    const HandMadeMotion motion = oracle.motion(s, l);
    if (!motion.keeps_limits() || motion.time() < kShortest) continue;
    ++compared;
    const double duration = planned_duration(s, motion, l);
    if (duration >= motion.time() * (1 - 1e-9)) ++equal;
    char text[512];
    std::snprintf(text, sizeof text,
                  "{0, %.17g, %.17g} -> %.17g, %.17g; limits %.17g %.17g %.17g %.17g %.17g", s.velocity,
                  s.acceleration, motion.state().position, motion.state().velocity, l.velocity_max,
                  l.velocity_min, l.acceleration, l.deceleration, l.jerk);
    ASSERT_LE(duration, motion.time() * (1 + 1e-6)) << "case " << i << ": " << text;
  }
  // The comparison means something only if it is made, and met, often.
  EXPECT_GT(compared, cases() / 10);
  EXPECT_GT(equal, compared / 50);
  RecordProperty("compared", compared);
  RecordProperty("equal", equal);
}

INSTANTIATE_TEST_SUITE_P(AccelerationAndDeceleration, ProfileOracle, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Equal" : "Unequal"; });

}  // namespace
}  // namespace lockstep::profile_oracle_test
