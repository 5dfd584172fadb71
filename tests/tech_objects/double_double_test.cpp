#include "tech_objects/arithmetic/double_double.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "tests/support/property.hpp"

namespace lockstep::double_double_test {
namespace {

TEST(DoubleDouble, SumsAndProductsOfDoublesLoseNothing) {
  std::mt19937_64 random(test::seed_of_test(11));
  std::uniform_int_distribution<std::int64_t> numbers(-(1LL << 53), 1LL << 53);
  __extension__ using Wide = __int128;
  for (int i = 0; i < test::cases(100'000, 10'000'000); ++i) {
    const std::int64_t a = numbers(random);
    const std::int64_t b = numbers(random);
    const DoubleDouble sum = two_sum(static_cast<double>(a), static_cast<double>(b));
    ASSERT_EQ(static_cast<std::int64_t>(sum.hi) + static_cast<std::int64_t>(sum.lo), a + b);
    const DoubleDouble product = two_product(static_cast<double>(a), static_cast<double>(b));
    ASSERT_TRUE(static_cast<Wide>(product.hi) + static_cast<Wide>(product.lo) == static_cast<Wide>(a) * b);
  }
}

TEST(DoubleDouble, ARoundedSumHasTheBitsOfTheSum) {
  std::mt19937_64 random(test::seed_of_test(12));
  std::uniform_real_distribution<double> values(-1.0, 1.0);
  std::uniform_int_distribution<int> sizes(-60, 60);
  const auto any = [&] { return std::ldexp(values(random), sizes(random)); };
  for (int i = 0; i < test::cases(100'000, 10'000'000); ++i) {
    const double big = any();
    const DoubleDouble a = two_sum(big, 0x1p-53 * values(random) * big);
    const double b = i % 2 == 0 ? any() : -a.hi * (1.0 + 0x1p-52 * static_cast<double>(i % 5));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(rounded_sum(a, b)),
              std::bit_cast<std::uint64_t>((a + b).rounded()))
        << a.hi << " + " << a.lo << " + " << b;
  }
}

TEST(DoubleDouble, OnlyTheSameBitsAreTheSame) {
  const DoubleDouble third = to_double_double(1.0) / 3.0;
  EXPECT_TRUE(same_bits(third, third));
  EXPECT_FALSE(same_bits(third, {third.hi, 0.0}));
  EXPECT_FALSE(same_bits(third, {std::nextafter(third.hi, 1.0), third.lo}));
  EXPECT_FALSE(same_bits({0.0, 0.0}, {-0.0, 0.0})) << "equal, but not the same";
}

TEST(DoubleDouble, AQuotientTimesItsDivisorIsTheDividend) {
  const DoubleDouble third = to_double_double(1.0) / 3.0;
  EXPECT_NE(third.lo, 0.0);
  EXPECT_EQ((third * 3.0).rounded(), 1.0);
  EXPECT_LE(std::abs((third * 3.0 - 1.0).rounded()), 0x1p-103);
}

TEST(DoubleDouble, A64BitIntegerIsExact) {
  const DoubleDouble maximum = to_double_double(INT64_MAX);
  EXPECT_EQ(maximum.hi, 0x1p63);
  EXPECT_EQ(maximum.lo, -1.0);
  EXPECT_EQ(to_double_double(INT64_MIN).hi, -0x1p63);
}

TEST(DoubleDouble, AManyTermSumIsTheRoundedExactSum) {
  DoubleDouble sum{};
  for (int i = 0; i < 1000000; ++i) sum = sum + 0.1;
  EXPECT_EQ(sum.rounded(), 100000.0);  // plain addition ends at 100000.00000133288
}

}  // namespace
}  // namespace lockstep::double_double_test
