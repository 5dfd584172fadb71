#include "fb/edge.hpp"

#include <gtest/gtest.h>

namespace lockstep::edge_test {
namespace {

TEST(R_TRIG, IsTrueForOneCallAfterARise) {
  R_TRIG trigger;
  trigger.CLK = true;
  trigger.call(0);
  EXPECT_TRUE(trigger.Q);
  trigger.call(1);
  EXPECT_FALSE(trigger.Q);
  trigger.CLK = false;
  trigger.call(2);
  EXPECT_FALSE(trigger.Q);
}

TEST(F_TRIG, CountsAFirstCallWithFalseAsAFall) {
  F_TRIG trigger;
  trigger.call(0);
  EXPECT_TRUE(trigger.Q);
  trigger.call(1);
  EXPECT_FALSE(trigger.Q);
  trigger.CLK = true;
  trigger.call(2);
  EXPECT_FALSE(trigger.Q);
  trigger.CLK = false;
  trigger.call(3);
  EXPECT_TRUE(trigger.Q);
}

TEST(BlockList, FindsTypesAndPinsWithoutRegardToCase) {
  const BlockType* type = find_block_type("r_trig");
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->name, "R_TRIG");
  const auto block = type->create();
  const Pin* pin = type->find_pin("clk");
  ASSERT_NE(pin, nullptr);
  Value one{};
  one.u = 1;
  pin->signal(*block).store(one);
  block->call(0);
  EXPECT_EQ(type->find_pin("Q")->signal(*block).load().u, 1u);
}

}  // namespace
}  // namespace lockstep::edge_test
