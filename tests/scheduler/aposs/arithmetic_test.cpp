// Arithmetic of APOSS at its edges.
#include "scheduler/aposs/arithmetic.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lockstep::aposs::arithmetic_test {
namespace {

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

TEST(AposArithmetic, WrapsWhereTheResultDoesNotFit) {
  EXPECT_EQ(sum(kHighest, 1), kLowest);
  EXPECT_EQ(difference(kLowest, 1), kHighest);
  EXPECT_EQ(product(65536, 65536), 0);
  EXPECT_EQ(product(kLowest, -1), kLowest);
  EXPECT_EQ(negative(kLowest), kLowest);
  EXPECT_EQ(absolute(kLowest), kLowest);
  EXPECT_EQ(absolute(-5), 5);
  EXPECT_EQ(quotient(kLowest, -1), kLowest);
  EXPECT_EQ(rounded_quotient(kLowest, -1), kLowest);
  EXPECT_EQ(remainder(kLowest, -1), 0);
}

TEST(AposArithmetic, DividesAsPublished) {
  EXPECT_EQ(quotient(19, 3), 6);
  EXPECT_EQ(quotient(-19, 3), -6);
  EXPECT_EQ(quotient(19, -3), -6);
  EXPECT_EQ(remainder(250, 16), 10);
  EXPECT_EQ(remainder(-7, 3), -1);
  EXPECT_EQ(remainder(7, -3), 1);
  EXPECT_EQ(rounded_quotient(250, 16), 16);
  EXPECT_EQ(rounded_quotient(-100, 15), -7);
  EXPECT_EQ(rounded_quotient(5, 2), 3);
  EXPECT_EQ(rounded_quotient(-5, 2), -3);
  EXPECT_EQ(rounded_quotient(4, 3), 1);
}

TEST(AposArithmetic, GivesZeroForADivisionByZero) {
  EXPECT_EQ(quotient(5, 0), 0);
  EXPECT_EQ(remainder(5, 0), 0);
  EXPECT_EQ(rounded_quotient(-5, 0), 0);
}

TEST(AposArithmetic, ShiftsByUpToThirtyOnePlaces) {
  EXPECT_EQ(shifted_left(3, 1), 6);
  EXPECT_EQ(shifted_right(12, 1), 6);
  EXPECT_EQ(shifted_left(1, 31), kLowest);
  EXPECT_EQ(shifted_left(1, 32), 0);
  EXPECT_EQ(shifted_left(1, -1), 0);
  EXPECT_EQ(shifted_right(-8, 1), -4);
  EXPECT_EQ(shifted_right(kLowest, 31), -1);
  EXPECT_EQ(shifted_right(kHighest, 32), 0);
  EXPECT_EQ(shifted_right(-1, 99), -1);
}

TEST(AposArithmetic, TakesPartsOfANumberAsPublished) {
  EXPECT_EQ(BitOf::of(7, 1), 1);
  EXPECT_EQ(BitOf::of(7, 3), 1);
  EXPECT_EQ(BitOf::of(7, 4), 0);
  EXPECT_EQ(BitOf::of(-1, 32), 1);
  EXPECT_EQ(BitOf::of(-1, 33), 0);
  EXPECT_EQ(BitOf::of(-1, 0), 0);
  EXPECT_EQ(ByteOf::of(0x027F, 1), 127);
  EXPECT_EQ(ByteOf::of(0x027F, 2), 2);
  EXPECT_EQ(ByteOf::of(-1, 4), 255);
  EXPECT_EQ(WordOf::of(0x0010FFFF, 2), 16);
  EXPECT_EQ(WordOf::of(-1, 1), 65535);
}

TEST(AposArithmetic, PutsPartsIntoANumberAsPublished) {
  EXPECT_EQ(BitOf::with(0, 3, 1), 4);
  EXPECT_EQ(BitOf::with(-1, 32, 0), kHighest);
  EXPECT_EQ(BitOf::with(5, 33, 1), 5);
  const std::int32_t low = ByteOf::with(0, 1, 72);
  EXPECT_EQ(ByteOf::with(low, 2, 128), 0x8048);
  EXPECT_EQ(WordOf::with(0x8048, 2, 15), 0x000F8048);
  EXPECT_EQ(ByteOf::with(0, 1, 0x1FF), 0xFF);
}

TEST(AposArithmetic, ShowsPositionsWithinTheirRange) {
  EXPECT_EQ(wrapped_position(1073741823), 1073741823);
  EXPECT_EQ(wrapped_position(1073741824), -1073741824);
  EXPECT_EQ(wrapped_position(-1073741825), 1073741823);
  EXPECT_EQ(wrapped_position(std::int64_t{1} << 40), 0);
}

}  // namespace
}  // namespace lockstep::aposs::arithmetic_test
