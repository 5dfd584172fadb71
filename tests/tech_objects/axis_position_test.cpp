#include "tech_objects/arithmetic/axis_position.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/property.hpp"

namespace lockstep::axis_position_test {
namespace {

constexpr Modulo kRing{true, 360.0, 0.0};
constexpr Modulo kCentred{true, 360.0, -180.0};
constexpr Modulo kLine{};

TEST(AxisPosition, ANormalisedPositionIsNeverTheEndOfTheRing) {
  EXPECT_EQ(normalised({4, 360.0}, kRing), (AxisPosition{5, 0.0}));
  EXPECT_EQ(normalised({4, -1e-30}, kRing), (AxisPosition{4, 0.0}));
  EXPECT_EQ(normalised({4, -1.0}, kRing), (AxisPosition{3, 359.0}));
  EXPECT_EQ(normalised({0, 180.0}, kCentred), (AxisPosition{1, -180.0}));
  const double last = std::nextafter(360.0, 0.0);
  EXPECT_EQ(normalised({0, last}, kRing), (AxisPosition{0, last}));
}

TEST(AxisPosition, NormalisingIsExactForLargeValues) {
  EXPECT_EQ(normalised({0, 1e15 + 7.0}, kRing).value, std::fmod(1e15 + 7.0, 360.0));
  const Modulo odd{true, 0.1, 0.0};
  for (const double value : {1e3, 12345.678, 9.9e11})
    EXPECT_EQ(normalised({0, value}, odd).value, std::fmod(value, 0.1)) << value;
}

TEST(AxisPosition, AdvancingAndComingBackKeepsTurnsAndValueTogether) {
  std::mt19937_64 random(test::seed_of_test(7));
  std::uniform_real_distribution<double> step(-3000.0, 3000.0);
  for (const Modulo& ring : {kRing, kCentred, Modulo{true, 0.001, 1.0}, Modulo{true, 33.3, -1e6}}) {
    AxisPosition at{0, ring.start};
    const AxisPosition begin = at;
    DoubleDouble sum{};
    for (int i = 0; i < test::cases(10'000, 1'000'000); ++i) {
      sum = sum + step(random);
      at = advanced(begin, sum, ring);
      ASSERT_TRUE(ring.contains(at.value)) << "step " << i;
      ASSERT_NEAR((difference(at, begin, ring) - sum).rounded(), 0.0,
                  1e-15 * (ring.length + std::abs(ring.start)));
    }
  }
}

TEST(AxisPosition, TurnsAreADistanceTheSameWhateverTheirNumber) {
  for (const double length : {360.0, 0.001, 1e12, 100.0 / 3.0})
    for (const std::int64_t turns :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{-7}, std::int64_t{1} << 53,
          (std::int64_t{1} << 53) + 1, -(std::int64_t{1} << 53) - 1, INT64_MAX, INT64_MIN}) {
      const DoubleDouble expected = to_double_double(turns) * length;
      const DoubleDouble distance = turns_distance(turns, length);
      EXPECT_EQ(distance.hi, expected.hi) << turns << " turns of " << length;
      EXPECT_EQ(distance.lo, expected.lo) << turns << " turns of " << length;
    }
}

TEST(AxisPosition, TurnsWrapWithoutAStep) {
  const AxisPosition last{INT64_MAX, 359.0};
  EXPECT_EQ(advanced(last, 2.0, kRing), (AxisPosition{INT64_MIN, 1.0}));
}

TEST(AxisPosition, ALinearAxisCountsNoTurns) {
  EXPECT_EQ(advanced({0, 350.0}, 20.0, kLine), (AxisPosition{0, 370.0}));
  EXPECT_EQ(difference({0, 1.0}, {0, 3.0}, kLine).rounded(), -2.0);
  EXPECT_EQ(shortest_distance(10.0, 700.0, kLine), 690.0);
  EXPECT_EQ(positive_distance(10.0, -7.0, kLine), -17.0);
}

TEST(AxisPosition, DistancesOnTheRingGoTheWayAsked) {
  EXPECT_EQ(positive_distance(350.0, 10.0, kRing), 20.0);
  EXPECT_EQ(negative_distance(350.0, 10.0, kRing), -340.0);
  EXPECT_EQ(shortest_distance(350.0, 10.0, kRing), 20.0);
  EXPECT_EQ(shortest_distance(10.0, 350.0, kRing), -20.0);
  EXPECT_EQ(shortest_distance(0.0, 180.0, kRing), 180.0);
  EXPECT_EQ(positive_distance(5.0, 5.0, kRing), 0.0);
  EXPECT_EQ(negative_distance(5.0, 5.0, kRing), 0.0);
  EXPECT_EQ(positive_distance(5.0, 725.0, kRing), 0.0) << "a target beyond the ring is on the ring too";
  EXPECT_EQ(positive_distance(-170.0, 185.0, kCentred), 355.0);
}

TEST(AxisPosition, DifferencesOverManyTurnsKeepTheirLastBits) {
  const DoubleDouble distance = difference({INT64_MAX, 0.25}, {0, 0.0}, kRing);
  const DoubleDouble turns = distance - 0.25;
  EXPECT_EQ(turns.hi, 0x1p63 * 360.0);
  EXPECT_EQ(turns.lo, -360.0);
  EXPECT_EQ(difference({INT64_MIN, 1.0}, {INT64_MAX, 359.0}, kRing).rounded(), 2.0);
}

}  // namespace
}  // namespace lockstep::axis_position_test
