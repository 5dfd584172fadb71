// What is computed by a shorter way than its definition, against the definition.
#include "tech_objects/arithmetic/nearest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tech_objects/arithmetic/seldom_cut.hpp"
#include "tech_objects/mco305/units.hpp"
#include "tech_objects/synchronous/braking_speed.hpp"

namespace lockstep {
namespace {

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

// Whole numbers, halves and quarters of all sizes, and what lies beside them.
std::vector<double> near_edges() {
  std::vector<double> values{0.0, -0.0, 0.49999999999999994, std::numeric_limits<double>::denorm_min()};
  for (int power = -3; power <= 62; ++power)
    for (int part = 0; part < 64; ++part) {
      const double value = std::ldexp(1.0 + part / 64.0, power);
      for (const double edge : {value, std::floor(value) + 0.5, std::floor(value) + 0.49})
        for (const double one : {std::nextafter(edge, 0.0), edge, std::nextafter(edge, 1e300)}) {
          values.push_back(one);
          values.push_back(-one);
        }
    }
  return values;
}

TEST(Nearest, IsTheWholeNumberThatIsNearest) {
  constexpr double kFar = 2251799813685248.0;  // 2⁵¹
  for (const double value : near_edges())
    if (std::abs(value) <= kFar) {
      EXPECT_EQ(nearest(value), std::nearbyint(value)) << value;
    }
}

TEST(Nearest, CountIsTheSameAsADouble) {
  std::mt19937_64 random(1);
  std::vector<double> values = near_edges();
  for (int i = 0; i < 100'000; ++i)
    values.push_back(std::ldexp(std::uniform_real_distribution<double>(-1.0, 1.0)(random), i % 64));
  for (const double value : values)
    EXPECT_EQ(mco305::nearest_whole(value), static_cast<double>(mco305::nearest_count(value))) << value;
  for (const double value : {1e300, -1e300, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(mco305::nearest_whole(value), static_cast<double>(mco305::nearest_count(value))) << value;
}

TEST(SeldomCut, IsAClampToTheBit) {
  const std::vector<double> values = near_edges();
  for (const double bound : {0.0, 0.5, 1.0, 4096.0, 1e30})
    for (const double value : values)
      EXPECT_EQ(bits(seldom_cut(value, bound)), bits(std::clamp(value, -bound, bound)))
          << value << " within " << bound;
  EXPECT_TRUE(std::isnan(seldom_cut(std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

// Whole steps of braking, of which the last one ends at the distance: k of them are k(k + 1)/2 brakings long.
TEST(BrakingSpeed, IsThatOfWholeSteps) {
  const auto defined = [](double distance, double braking) {
    const double whole = std::floor(std::sqrt(0.25 + 2.0 * distance / braking) - 0.5);
    return whole < 1.0 ? distance : whole * braking;
  };
  std::mt19937_64 random(2);
  for (int i = 0; i < 200'000; ++i) {
    const double braking = std::ldexp(std::uniform_real_distribution<double>(0.5, 1.0)(random), i % 40 - 20);
    const double distance = std::ldexp(std::uniform_real_distribution<double>(0.0, 1.0)(random), i % 60 - 10);
    ASSERT_EQ(bits(braking_speed(distance, braking)), bits(defined(distance, braking)))
        << distance << " by " << braking;
  }
  for (const double braking : {0.001, 0.03, 1.0, 3.0, 1000.0})
    for (double k = 1.0; k < 3000.0; k += 1.0) {
      const double edge = k * (k + 1.0) / 2.0 * braking;
      for (const double distance : {std::nextafter(edge, 0.0), edge, std::nextafter(edge, 1e300)})
        ASSERT_EQ(bits(braking_speed(distance, braking)), bits(defined(distance, braking)))
            << distance << " by " << braking;
    }
  for (const double distance : {0.0, 1e290, 1e300})
    EXPECT_EQ(bits(braking_speed(distance, 1e-6)), bits(defined(distance, 1e-6))) << distance;
}

}  // namespace
}  // namespace lockstep
