#include "fb/bistable.hpp"

#include <gtest/gtest.h>

namespace lockstep::bistable_test {
namespace {

bool call(SR& block, bool s1, bool r) {
  block.S1 = s1;
  block.R = r;
  block.call(0);
  return block.Q1;
}

bool call(RS& block, bool s, bool r1) {
  block.S = s;
  block.R1 = r1;
  block.call(0);
  return block.Q1;
}

template <class T>
class Bistable : public testing::Test {};
using Blocks = testing::Types<SR, RS>;
TYPED_TEST_SUITE(Bistable, Blocks);

TYPED_TEST(Bistable, IsFalseUntilItIsSet) {
  TypeParam block;
  EXPECT_FALSE(block.Q1);
  EXPECT_FALSE(call(block, false, false));
}

TYPED_TEST(Bistable, KeepsItsStateWhileBothInputsAreFalse) {
  TypeParam block;
  EXPECT_TRUE(call(block, true, false));
  EXPECT_TRUE(call(block, false, false));
  EXPECT_TRUE(call(block, false, false));
  EXPECT_FALSE(call(block, false, true));
  EXPECT_FALSE(call(block, false, false));
}

TEST(SR, SetsWhenBothInputsAreTrue) {
  SR block;
  EXPECT_TRUE(call(block, true, true));
  EXPECT_TRUE(call(block, true, true));
  EXPECT_FALSE(call(block, false, true)) << "the reset acts as soon as the set input is FALSE";
}

TEST(RS, ResetsWhenBothInputsAreTrue) {
  RS block;
  EXPECT_FALSE(call(block, true, true));
  EXPECT_TRUE(call(block, true, false)) << "the set acts as soon as the reset input is FALSE";
  EXPECT_FALSE(call(block, true, true));
}

}  // namespace
}  // namespace lockstep::bistable_test
