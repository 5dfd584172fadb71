// Arrays, stack, print queue, PID, and where a position is passed.
#include <gtest/gtest.h>

#include "scheduler/aposs/frame.hpp"
#include "scheduler/aposs/interrupts.hpp"
#include "scheduler/aposs/pid_filter.hpp"
#include "scheduler/aposs/print_queue.hpp"

namespace lockstep::aposs::parts_test {
namespace {

TEST(AposArrays, AreKnownByTheirOrderAndKeepTheirContent) {
  Arrays arrays;
  const ArrayDeclaration first[] = {{"a", 3}, {"b", 2}};
  ASSERT_EQ(arrays.fit(first), 0);
  *arrays.element(1, 2) = 7;
  const ArrayDeclaration renamed[] = {{"x", 3}, {"y", 2}, {"z", 5}};
  ASSERT_EQ(arrays.fit(renamed), 0);
  EXPECT_EQ(*arrays.element(1, 2), 7);
  EXPECT_EQ(*arrays.element(2, 5), 0);
  const ArrayDeclaration subset[] = {{"x", 3}};
  EXPECT_EQ(arrays.fit(subset), 0);
}

TEST(AposArrays, OfAnotherSizeOrWithoutMemoryAreErrors) {
  Arrays arrays;
  const ArrayDeclaration first[] = {{"a", 3}};
  ASSERT_EQ(arrays.fit(first), 0);
  const ArrayDeclaration other[] = {{"a", 4}};
  EXPECT_EQ(arrays.fit(other), 170);
  const ArrayDeclaration large[] = {{"a", 3}, {"b", Arrays::kMaximumCells}};
  EXPECT_EQ(arrays.fit(large), 175);
}

TEST(AposArrays, HaveNoElementOutsideTheirBounds) {
  Arrays arrays;
  const ArrayDeclaration first[] = {{"a", 3}, {"b", 2}};
  ASSERT_EQ(arrays.fit(first), 0);
  EXPECT_EQ(arrays.element(0, 0), nullptr);
  EXPECT_EQ(arrays.element(0, 4), nullptr);
  EXPECT_EQ(arrays.element(0, -2147483647 - 1), nullptr);
  EXPECT_NE(arrays.element(0, 3), nullptr);
  EXPECT_EQ(arrays.element(2, 1), nullptr);
  arrays.forget();
  EXPECT_EQ(arrays.element(0, 1), nullptr);
  EXPECT_EQ(arrays.fit(first), 0);
  EXPECT_NE(arrays.element(0, 1), nullptr);
}

TEST(AposStack, HoldsTenCalls) {
  Stack stack;
  for (std::uint16_t i = 0; i < 10; ++i) EXPECT_TRUE(stack.call(i));
  EXPECT_FALSE(stack.call(10));
  std::uint16_t to = 0;
  for (int i = 9; i >= 0; --i) {
    EXPECT_TRUE(stack.leave(to));
    EXPECT_EQ(to, i);
  }
  EXPECT_FALSE(stack.leave(to));
}

TEST(AposStack, TurnsALoopAsOftenAsItSaysInEachRoutine) {
  Stack stack;
  EXPECT_EQ(stack.turn(5, 2), Stack::Turn::kAgain);
  ASSERT_TRUE(stack.call(1));
  EXPECT_EQ(stack.turn(5, 1), Stack::Turn::kAgain);  // the same loop in a routine that calls itself
  EXPECT_EQ(stack.turn(5, 1), Stack::Turn::kOver);
  std::uint16_t to = 0;
  ASSERT_TRUE(stack.leave(to));
  EXPECT_EQ(stack.turn(5, 2), Stack::Turn::kAgain);
  EXPECT_EQ(stack.turn(5, 2), Stack::Turn::kOver);
  EXPECT_EQ(stack.turn(5, 0), Stack::Turn::kOver);
  EXPECT_EQ(stack.turn(5, -1), Stack::Turn::kOver);
}

TEST(AposStack, HoldsTenLoopsOfARoutine) {
  Stack stack;
  for (std::uint16_t i = 0; i < 10; ++i) EXPECT_EQ(stack.turn(i, 5), Stack::Turn::kAgain);
  EXPECT_EQ(stack.turn(10, 5), Stack::Turn::kTooDeep);
  EXPECT_EQ(stack.turn(0, 5), Stack::Turn::kAgain);  // those within it have been left by GOTO
  EXPECT_EQ(stack.turn(10, 5), Stack::Turn::kAgain);
}

TEST(AposPrintQueue, DropsALineThatDoesNotFitWholeAndCountsIt) {
  PrintQueue queue(4);
  queue.push({Printed::Kind::kNumber, 1});
  queue.end_line();
  queue.push({Printed::Kind::kNumber, 2});
  queue.push({Printed::Kind::kNumber, 3});
  queue.end_line();  // five items
  EXPECT_EQ(queue.dropped_lines(), 1u);
  Printed item;
  ASSERT_TRUE(queue.take(item));
  EXPECT_EQ(item.value, 1);
  ASSERT_TRUE(queue.take(item));
  EXPECT_EQ(item.kind, Printed::Kind::kEndOfLine);
  EXPECT_FALSE(queue.take(item));
  queue.push({Printed::Kind::kNumber, 4});
  EXPECT_FALSE(queue.take(item)) << "a line is given out when it ends";
  queue.flush();
  ASSERT_TRUE(queue.take(item));
  EXPECT_EQ(item.value, 4);
}

// u(n) = (KP·e + KD·(e − e') + KI·Σe) / TIMER, from EN 4955.
TEST(AposPid, FollowsItsFormula) {
  PidFilter pid;
  EXPECT_EQ(pid.step(10), 20);  // KP 1, KD 1
  EXPECT_EQ(pid.step(10), 10);
  pid.set(0, 3);
  pid.set(1, 0);
  pid.set(2, 2);
  pid.set(3, 15);
  pid.set(4, 4);
  EXPECT_EQ(pid.step(10), (3 * 10 + 2 * 10) / 4);
  EXPECT_EQ(pid.step(10), (3 * 10 + 2 * 15) / 4);  // the sum ends at KILIM
  pid.set(4, 0);
  EXPECT_EQ(pid.step(0), 2 * 15 / 4);
  pid.set(0, 2147483647);
  EXPECT_EQ(pid.step(2147483647), 2147483647);
}

TEST(AposPosition, IsPassedOnceInItsDirection) {
  constexpr std::int64_t kPeriod = std::int64_t{1} << 31;
  EXPECT_TRUE(passed(0, 10, 5, false, kPeriod));
  EXPECT_TRUE(passed(0, 10, 10, false, kPeriod));
  EXPECT_FALSE(passed(10, 20, 10, false, kPeriod)) << "it stood there";
  EXPECT_FALSE(passed(10, 0, 5, false, kPeriod));
  EXPECT_TRUE(passed(10, 0, 5, true, kPeriod));
  EXPECT_FALSE(passed(0, 0, 0, true, kPeriod));
  EXPECT_TRUE(passed(1073741820, -1073741820, -1073741822, false, kPeriod)) << "over the end of the counter";
  EXPECT_TRUE(passed(3900, 100, 3950, false, 4000)) << "over the end of a cycle";
  EXPECT_TRUE(passed(3900, 100, 50, false, 4000));
  EXPECT_FALSE(passed(3900, 100, 2000, false, 4000));
}

}  // namespace
}  // namespace lockstep::aposs::parts_test
