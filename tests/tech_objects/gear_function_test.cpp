#include "tech_objects/synchronous/gear_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/property.hpp"

namespace lockstep::gear_function_test {
namespace {

constexpr Modulo kLine{false, 1.0, 0.0};
constexpr Modulo kRing{true, 360.0, 0.0};

double ulp(double value) {
  const double size = std::abs(value);
  return std::nextafter(size, INFINITY) - size;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

std::int64_t integer(const std::string& text) {
  return std::strtoll(text.c_str(), nullptr, 10);
}
double real(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}
Modulo modulo(const std::vector<std::string>& row, std::size_t first) {
  return {row[first] == "1", real(row[first + 1]), real(row[first + 2])};
}
AxisPosition position(const std::vector<std::string>& row, std::size_t first) {
  return {integer(row[first]), real(row[first + 1])};
}

TEST(GearFunction, AgreesWithExactRationalArithmetic) {
  std::ifstream file(LOCKSTEP_TEST_DATA "/gear_reference.csv");
  ASSERT_TRUE(file.is_open());
  GearFunction gear;
  Modulo following;
  double largest_term = 0.0;
  int points = 0;
  int rounded_right = 0;
  double worst = 0.0;  // in units of the permitted 4 ulp
  std::string gear_line;
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> row = cells(line);
    if (row[0] == "G") {
      gear_line = line;
      following = modulo(row, 6);
      gear.set(static_cast<std::int32_t>(integer(row[1])), static_cast<std::int32_t>(integer(row[2])),
               position(row, 9), position(row, 11), modulo(row, 3), following);
      largest_term = std::abs(real(row[12]));
    } else if (row[0] == "P") {
      const AxisPosition expected = position(row, 3);
      const AxisPosition result = gear.value(position(row, 1));
      double permitted = 4.0 * ulp(std::max(largest_term, std::abs(expected.value)));
      if (following.enabled) permitted = 4.0 * std::max(ulp(following.length), ulp(expected.value));
      const double error = std::abs(difference(result, expected, following).rounded());
      EXPECT_LE(error, permitted) << gear_line << "\n"
                                  << line << "\nresult " << result.turns << " " << result.value;
      EXPECT_TRUE(following.contains(result.value)) << gear_line << "\n" << line;
      worst = std::max(worst, error / permitted);
      rounded_right += result == expected ? 1 : 0;
      ++points;
    }
  }
  EXPECT_GT(points, 5000);
  EXPECT_LE(worst, 0.25) << "more than one ulp";
  EXPECT_GT(rounded_right, points * 98 / 100);
  std::printf("%d points, %d rounded to nearest, worst %.3f ulp\n", points, rounded_right, 4.0 * worst);
}

/// A gear led over a path must be where a fresh one is that jumps there.
void expect_path_does_not_matter(const Modulo& leading, const Modulo& following, std::int32_t numerator,
                                 std::int32_t denominator, std::mt19937_64& random) {
  const AxisPosition leading_start{3, leading.start + 0.3 * leading.length};
  const AxisPosition following_start{-5, following.start + 0.7 * following.length};
  GearFunction walker;
  walker.set(numerator, denominator, leading_start, following_start, leading, following);
  AxisPosition at = leading_start;
  std::uniform_real_distribution<double> step(-0.9, 1.0);
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    at = advanced(at, step(random) * leading.length * (i % 1000 == 0 ? 1e6 : 1.0), leading);
    const AxisPosition walked = walker.value(at);
    GearFunction jumper;
    jumper.set(numerator, denominator, leading_start, following_start, leading, following);
    const AxisPosition jumped = jumper.value(at);
    ASSERT_LE(std::abs(difference(walked, jumped, following).rounded()), ulp(following.length))
        << "step " << i;
  }
}

TEST(GearFunction, IsAFunctionOfTheLeadingPositionAndNotOfItsPath) {
  std::mt19937_64 random(test::seed_of_test(1));
  expect_path_does_not_matter(kRing, kRing, 355, 113, random);
  expect_path_does_not_matter(kRing, {true, 2.0 * 3.141592653589793, -1.0}, -355, 113, random);
  expect_path_does_not_matter({true, 0.001, 0.0}, {true, 1e12, -5e11}, 2147483647, 2147483646, random);
  expect_path_does_not_matter({true, 1e12, 0.0}, {true, 0.001, 0.0}, 2147483647, 1, random);
}

TEST(GearFunction, AChainOfGearsReturnsToItsStartAfterAWholeNumberOfTurns) {
  GearFunction first;
  GearFunction second;
  first.set(355, 113, {}, {}, kRing, kRing);
  second.set(-113, 355, {}, {}, kRing, kRing);
  for (const std::int64_t turns : {113LL, 113000LL, 113000000000LL}) {
    const AxisPosition middle = first.value({turns, 0.0});
    EXPECT_EQ(middle, (AxisPosition{turns / 113 * 355, 0.0}));
    EXPECT_EQ(second.value(middle), (AxisPosition{-turns, 0.0}));
  }
}

TEST(GearFunction, TheExamplesOfTheManualHold) {
  GearFunction gear;
  gear.set(5, 1, {}, {}, kLine, kLine);
  EXPECT_EQ(gear.value({0, 10.0}), (AxisPosition{0, 50.0}));
  gear.set(-3, 1, {}, {}, kLine, kLine);
  EXPECT_EQ(gear.value({0, 10.0}), (AxisPosition{0, -30.0}));
  EXPECT_EQ(gear.velocity(100.0), -300.0);
  EXPECT_EQ(gear.acceleration(-2.0), 6.0);
}

TEST(GearFunction, VelocityAndAccelerationAreWithinOneUlpOfTheExactRatio) {
  std::mt19937_64 random(test::seed_of_test(20261121));
  std::uniform_int_distribution<std::int32_t> ratio(1, 2147483647);
  std::uniform_real_distribution<double> quantity(-1e6, 1e6);
  GearFunction gear;
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    const std::int32_t numerator = ratio(random);
    const std::int32_t denominator = ratio(random);
    gear.set(i % 2 == 0 ? numerator : -numerator, denominator, {}, {}, kRing, kRing);
    const double leading = quantity(random);
    // The product of 31 and 53 bits over 31 bits, in 64 bits: far below an ulp of a double beside it.
    const long double exact =
        (i % 2 == 0 ? 1.0L : -1.0L) * numerator * static_cast<long double>(leading) / denominator;
    for (const double geared : {gear.velocity(leading), gear.acceleration(leading)})
      ASSERT_LE(std::abs(geared - exact), ulp(static_cast<double>(exact)))
          << numerator << ":" << denominator << " of " << leading;
  }
}

TEST(GearFunction, ChangingTheDirectionMakesNoStep) {
  GearFunction gear;
  gear.set(-7, 3, {0, 350.0}, {0, 2.0}, kRing, kRing);
  AxisPosition at{0, 350.0};
  AxisPosition before = gear.value(at);
  for (int i = 0; i < 4000; ++i) {
    const double step = (i / 37) % 2 == 0 ? 5.0 : -5.0;
    at = advanced(at, step, kRing);
    const AxisPosition now = gear.value(at);
    ASSERT_NEAR(difference(now, before, kRing).rounded(), -step * 7.0 / 3.0, 1e-12);
    before = now;
  }
}

TEST(GearFunction, TurnsWrapAtSixtyFourBitsWithoutAStep) {
  GearFunction gear;
  gear.set(1, 1, {INT64_MAX, 359.0}, {INT64_MAX, 359.0}, kRing, kRing);
  const AxisPosition beyond = gear.value({INT64_MIN, 1.0});
  EXPECT_EQ(beyond, (AxisPosition{INT64_MIN, 1.0}));
}

}  // namespace
}  // namespace lockstep::gear_function_test
