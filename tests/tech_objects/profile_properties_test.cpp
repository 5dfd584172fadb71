// What holds for every profile, on seeded random requests.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "tech_objects/profile/profile.hpp"
#include "tests/support/property.hpp"

namespace lockstep::profile_properties_test {
namespace {

int cases() {
  return test::cases(10'000, 1'000'000);
}

struct Request {
  MotionState start;
  double position, velocity;
  ProfileLimits limits;
};

std::string text(const Request& r) {
  char line[512];
  std::snprintf(
      line, sizeof line, "{%.17g, %.17g, %.17g} -> %.17g, %.17g; limits %.17g %.17g %.17g %.17g %.17g",
      r.start.position, r.start.velocity, r.start.acceleration, r.position, r.velocity, r.limits.velocity_max,
      r.limits.velocity_min, r.limits.acceleration, r.limits.deceleration, r.limits.jerk);
  return line;
}

class Requests {
 public:
  /// `decades`: units of way and time vary by so many powers of ten in either direction.
  explicit Requests(double decades) : decades_(decades) {}

  Request next() {
    const double length = power(-decades_, decades_), time = power(-0.6 * decades_, 0.6 * decades_);
    Request r{};
    r.limits.velocity_max = length / time * power(-1.0, 1.0);
    r.limits.velocity_min = one_of(3) ? -r.limits.velocity_max : -length / time * power(-1.0, 1.0);
    r.limits.acceleration = length / time / time * power(-1.0, 1.0);
    r.limits.deceleration = one_of(3) ? r.limits.acceleration : length / time / time * power(-1.0, 1.0);
    r.limits.jerk = one_of(8) ? 0.0 : length / time / time / time * power(-1.5, 2.5);
    r.start.position = one_of(3) ? 0.0 : 10.0 * length * between(-1.0, 1.0);
    r.start.velocity = within(std::max(r.limits.velocity_max, -r.limits.velocity_min));
    r.start.acceleration = within(std::max(r.limits.acceleration, r.limits.deceleration));
    r.position = r.start.position + distance(length);
    r.velocity = end_velocity(r);
    return r;
  }

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

 private:
  bool one_of(unsigned n) { return random_() % n == 0; }
  double power(double low, double high) { return std::pow(10.0, between(low, high)); }
  double sign() { return one_of(2) ? 1.0 : -1.0; }
  /// Nothing, the limit, within it, far within it, or beyond it.
  double within(double limit) {
    switch (random_() % 6) {
      case 0:
        return 0.0;
      case 1:
        return limit * sign();
      case 2:
        return limit * power(-12.0, 0.0) * sign();
      case 3:
        return limit * between(-3.0, 3.0);
      default:
        return limit * between(-1.0, 1.0);
    }
  }
  double distance(double distance) {
    if (one_of(6)) return 0.0;
    return distance * between(-1.0, 1.0) * (one_of(5) ? power(-12.0, 0.0) : power(-2.0, 2.0));
  }
  double end_velocity(const Request& r) {
    switch (random_() % 4) {
      case 0:
        return between(r.limits.velocity_min, r.limits.velocity_max);
      case 1:
        return one_of(2) ? r.limits.velocity_min : r.limits.velocity_max;
      case 2:
        return std::clamp(r.start.velocity, r.limits.velocity_min, r.limits.velocity_max);
      default:
        return 0.0;
    }
  }

  double decades_;
  std::mt19937_64 random_{test::seed_of_test(20240611)};
};

double end_of(const Profile& profile, std::size_t phase) {
  return phase + 1 < profile.phases().size() ? profile.phases()[phase + 1].begin : profile.duration();
}

/// The largest amounts that occur: what rounding is measured by.
struct Scale {
  double position, velocity, acceleration, time;

  Scale(const Request& r, const Profile& profile)
      : position(std::abs(r.start.position) + std::abs(profile.target().position)),
        velocity(std::max(r.limits.velocity_max, -r.limits.velocity_min)),
        acceleration(
            std::max({r.limits.acceleration, r.limits.deceleration, std::abs(r.start.acceleration)})),
        time(4.0 * std::numeric_limits<double>::epsilon() * profile.duration()) {
    for (const Profile::Phase& phase : profile.phases()) {
      velocity = std::max(velocity, std::abs(phase.state.velocity));
      position = std::max(position, std::abs(phase.state.position));
    }
    position += velocity * profile.duration();
  }
};

void expect_continuous(const Request& r, const Profile& profile, const Scale& scale) {
  for (std::size_t i = 0; i < profile.phases().size(); ++i) {
    const Profile::Phase& phase = profile.phases()[i];
    const double t = end_of(profile, i) - phase.begin;
    const MotionState& s = phase.state;
    const MotionState next =
        i + 1 < profile.phases().size() ? profile.phases()[i + 1].state : profile.target();
    ASSERT_GE(t, 0.0);
    ASSERT_LE(std::abs(phase.jerk), r.limits.jerk);
    ASSERT_NEAR(s.position + t * (s.velocity + t * (s.acceleration / 2 + t * phase.jerk / 6)), next.position,
                1e-13 * scale.position);
    ASSERT_NEAR(s.velocity + t * (s.acceleration + t * phase.jerk / 2), next.velocity,
                1e-13 * scale.velocity + scale.acceleration * scale.time);
    if (r.limits.jerk > 0.0) {
      ASSERT_NEAR(s.acceleration + t * phase.jerk, next.acceleration,
                  1e-13 * scale.acceleration + r.limits.jerk * scale.time);
    }
  }
}

/// To the last bit: 0 and -0 differ.
std::array<std::uint64_t, 3> bits(const MotionState& state) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(state);
}

void expect_exact_ends(const Request& r, const Profile& profile) {
  const MotionState first = profile.at(0.0);
  const MotionState last = profile.duration() > 0.0 ? profile.at(profile.duration()) : profile.target();
  ASSERT_EQ(bits(first), bits(r.start));
  ASSERT_EQ(last.position, profile.target().position);
  ASSERT_EQ(last.velocity, r.velocity);
  ASSERT_EQ(last.acceleration, 0.0);
}

void expect_velocity_in_limits(const Request& r, const Profile& profile, const Scale& scale) {
  const double a = r.start.acceleration;
  const double stop = r.start.velocity + (r.limits.jerk > 0.0 ? a * std::abs(a) / 2 / r.limits.jerk : 0.0);
  const double maximum = std::max({r.limits.velocity_max, r.start.velocity, stop});
  const double minimum = std::min({r.limits.velocity_min, r.start.velocity, stop});
  for (int i = 0; i <= 50; ++i) {
    const double v = profile.at(profile.duration() * i / 50).velocity;
    ASSERT_LE(v, maximum + 1e-12 * scale.velocity);
    ASSERT_GE(v, minimum - 1e-12 * scale.velocity);
  }
}

/// Beyond a limit of the acceleration only as long as full jerk has been taking it back since the start.
void expect_acceleration_in_limits(const Request& r, const Profile& profile, const Scale& scale) {
  bool unavoidable = true;
  for (std::size_t i = 0; i < profile.phases().size(); ++i) {
    const Profile::Phase& phase = profile.phases()[i];
    const double length = end_of(profile, i) - phase.begin;
    const bool brief = length * r.limits.jerk < 1e-7 * scale.acceleration;
    unavoidable = unavoidable && ((brief && r.limits.jerk > 0.0) || phase.jerk * r.start.acceleration < 0.0);
    for (int k = 0; k <= 10 && !unavoidable; ++k) {
      const double t = length * k / 10;
      const double a = phase.state.acceleration + t * phase.jerk;
      const double v = phase.state.velocity + t * (phase.state.acceleration + t * phase.jerk / 2);
      const bool standstill = std::abs(v) < 1e-9 * scale.velocity;
      const double limit = standstill ? std::max(r.limits.acceleration, r.limits.deceleration)
                                      : (a * v > 0.0 ? r.limits.acceleration : r.limits.deceleration);
      ASSERT_LE(std::abs(a), limit + 1e-12 * scale.acceleration + r.limits.jerk * scale.time);
    }
  }
}

void expect_valid(const Request& r, const Profile& profile) {
  ASSERT_LE(profile.phases().size(), static_cast<std::size_t>(Profile::kMaxPhases));
  const Scale scale{r, profile};
  expect_exact_ends(r, profile);
  if (testing::Test::HasFatalFailure()) return;
  expect_continuous(r, profile, scale);
  if (testing::Test::HasFatalFailure()) return;
  expect_velocity_in_limits(r, profile, scale);
  if (testing::Test::HasFatalFailure()) return;
  expect_acceleration_in_limits(r, profile, scale);
}

class ProfileProperties : public testing::TestWithParam<double> {};

TEST_P(ProfileProperties, EveryMotionToAPositionIsContinuousKeepsItsLimitsAndMeetsItsTarget) {
  Requests requests{GetParam()};
  for (int i = 0; i < cases(); ++i) {
    const Request r = requests.next();
    Profile profile;
    ASSERT_EQ(plan_position(r.start, r.position, r.velocity, r.limits, profile), PlanResult::ok) << text(r);
    ASSERT_EQ(profile.target().position, r.position);
    expect_valid(r, profile);
    if (HasFatalFailure()) FAIL() << "case " << i << ": " << text(r);
  }
}

TEST_P(ProfileProperties, EveryChangeOfVelocityIsContinuousKeepsItsLimitsAndIsNotSlowerThanToAPosition) {
  Requests requests{GetParam()};
  for (int i = 0; i < cases(); ++i) {
    const Request r = requests.next();
    Profile profile, there;
    ASSERT_EQ(plan_velocity(r.start, r.velocity, r.limits, profile), PlanResult::ok) << text(r);
    expect_valid(r, profile);
    if (HasFatalFailure()) FAIL() << "case " << i << ": " << text(r);
    ASSERT_EQ(plan_position(r.start, r.position, r.velocity, r.limits, there), PlanResult::ok);
    ASSERT_GE(there.duration(), profile.duration() * (1.0 - 1e-9)) << text(r);
  }
}

TEST_P(ProfileProperties, TheSameRequestGivesTheSameBits) {
  Requests requests{GetParam()};
  for (int i = 0; i < 1000; ++i) {
    const Request r = requests.next();
    Profile first, second;
    ASSERT_EQ(plan_position(r.start, r.position, r.velocity, r.limits, first), PlanResult::ok);
    ASSERT_EQ(plan_position(r.start, r.position, r.velocity, r.limits, second), PlanResult::ok);
    ASSERT_EQ(first.duration(), second.duration());
    for (int k = 0; k < 10; ++k) {
      const double t = requests.between(0.0, first.duration());
      ASSERT_EQ(bits(first.at(t)), bits(second.at(t))) << text(r);
    }
  }
}

TEST_P(ProfileProperties, AMotionPlannedAnewOnItsWayTakesTheTimeThatWasLeft) {
  Requests requests{GetParam()};
  for (int i = 0; i < cases() / 5; ++i) {
    const Request r = requests.next();
    if (r.velocity != 0.0) continue;
    Profile profile, anew;
    ASSERT_EQ(plan_position(r.start, r.position, 0.0, r.limits, profile), PlanResult::ok);
    const double t = profile.duration() * requests.between(0.0, 1.0);
    const MotionState s = profile.at(t);
    if (s.velocity > r.limits.velocity_max || s.velocity < r.limits.velocity_min || r.limits.jerk == 0.0)
      continue;
    ASSERT_EQ(plan_position(s, r.position, 0.0, r.limits, anew), PlanResult::ok)
        << text({s, r.position, 0.0, r.limits});
    // An error e of the position takes up to about (e / jerk)^(1/3) to be made good.
    const double error = 1e-14 * Scale(r, profile).position;
    const double allowed = 1e-6 * profile.duration() + 8.0 * std::cbrt(error / r.limits.jerk);
    ASSERT_NEAR(anew.duration(), profile.duration() - t, allowed)
        << "case " << i << ", t=" << t << ": " << text(r);
  }
}

INSTANTIATE_TEST_SUITE_P(OfMachines, ProfileProperties, testing::Values(2.0));
INSTANTIATE_TEST_SUITE_P(OfAnySize, ProfileProperties, testing::Values(9.0, 30.0));

}  // namespace
}  // namespace lockstep::profile_properties_test
