// DynamicLimits that a program writes in motion, several at once: each change counts, whatever the numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <unordered_map>
#include <vector>

#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::changed_limits_test {
namespace {

using test::Rig;
using Limits = TO_Struct_DynamicLimits;

struct Machine : Rig {
  Machine() : a(axis("Axis")), power(block<MC_Power>()), run_v(block<MC_MoveVelocity>()) {
    power.Axis = run_v.Axis = &a;
    power.Enable = true;
    run_v.Velocity = 1500.0;
    run_v.Acceleration = run_v.Deceleration = 100000.0;
    run_v.Jerk = 0.0;
    continuity[0].acceleration = false;
    run(10);
  }

  /// The velocity once the axis has followed these limits, from rest with others.
  double velocity_after(const Limits& before, const Limits& after) {
    run_v.Execute = false;
    a.data.DynamicLimits = {10000.0, 10000.0, 100000.0, 100000.0, 1e6};
    tick();
    a.data.DynamicLimits = before;
    run_v.Execute = true;
    tick();
    tick();
    a.data.DynamicLimits = after;
    // From here on as quickly as it may: what is looked at is whether it follows, not how.
    const double highest = std::max(before.Velocity, 1500.0);
    const double slowest = std::min(after.MaxAcceleration, after.MaxDeceleration);
    run(static_cast<int>(highest / slowest / period()) + 10);
    return a.setpoint().velocity;
  }

  Axis& a;
  MC_Power& power;
  MC_MoveVelocity& run_v;
};

TEST(ChangedLimits, OfVelocityAndAccelerationInOneTickBothCount) {
  Machine m;
  m.a.data.DynamicLimits = {10000.0, 2000.0, 2000.0, 2000.0, 1e6};
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  ASSERT_EQ(m.a.setpoint().velocity, 1500.0);
  m.a.data.DynamicLimits.Velocity = 21.0;
  m.a.data.DynamicLimits.MaxAcceleration = 90.0;
  m.run(2);
  EXPECT_LT(m.a.setpoint().velocity, 1500.0);
  m.run(1000);
  EXPECT_EQ(m.a.setpoint().velocity, 21.0);
}

/// Round numbers leave most bits of a double 0: any word that the limits are folded into takes many of them
/// for the same. These are pairs that products with an odd number and sums, of 64 bits, do not tell apart.
std::vector<std::array<Limits, 2>> pairs_of_one_word(std::mt19937_64& random, std::size_t count) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const auto round = [&random] { return std::uniform_int_distribution<int>(1, 2000)(random) * 1.0; };
  std::unordered_map<std::uint64_t, Limits> seen;
  std::vector<std::array<Limits, 2>> pairs;
  while (pairs.size() < count) {
    const Limits limits{10000.0, round(), 1000.0 + round(), 5000.0, 1e6};
    const auto [at, first] =
        seen.try_emplace(bits(limits.Velocity) * kOdd + bits(limits.MaxAcceleration), limits);
    if (!first && at->second.Velocity != limits.Velocity) pairs.push_back({at->second, limits});
  }
  return pairs;
}

TEST(ChangedLimits, CountWhateverTheirBitsAreLike) {
  std::mt19937_64 random(test::seed_of_test(20241));
  Machine m;
  for (const auto& [before, after] : pairs_of_one_word(random, 20))
    ASSERT_EQ(m.velocity_after(before, after), std::min(1500.0, after.Velocity))
        << before.Velocity << ", " << before.MaxAcceleration << " -> " << after.Velocity << ", "
        << after.MaxAcceleration;
}

TEST(ChangedLimits, CountWhicheverOfThemChange) {
  test::for_each_seed(1, 60, [](const test::Case& with) {
    std::mt19937_64 random(with.seed);
    const auto one_of = [&random](double lowest, double highest) {
      const double exponent =
          std::uniform_real_distribution<double>(std::log10(lowest), std::log10(highest))(random);
      const double value = std::pow(10.0, exponent);
      return random() % 2 == 0 ? value : std::round(value);
    };
    Machine m;
    for (int i = 0; i < 5; ++i) {
      std::array<Limits, 2> limits;
      for (Limits& set : limits)
        set = {10000.0, one_of(1.0, 3000.0), one_of(500.0, 1e5), one_of(500.0, 1e5), one_of(1e3, 1e6)};
      const auto keep = random();
      if ((keep & 1) != 0) limits[1].Velocity = limits[0].Velocity;
      if ((keep & 2) != 0) limits[1].MaxAcceleration = limits[0].MaxAcceleration;
      if ((keep & 4) != 0) limits[1].MaxDeceleration = limits[0].MaxDeceleration;
      ASSERT_NEAR(m.velocity_after(limits[0], limits[1]), std::min(1500.0, limits[1].Velocity), 1e-9);
    }
  });
}

}  // namespace
}  // namespace lockstep::changed_limits_test
