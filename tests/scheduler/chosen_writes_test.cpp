#include "scheduler/chosen_writes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/allocations.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/seeds.hpp"

namespace lockstep::chosen_writes_test {
namespace {

TEST(ChosenWrites, EnterAtOneTickAndTellWhatStoodThere) {
  ChosenWrites writes;
  LREAL speed = 1.5;
  SINT small = -3;
  BOOL flag = false;
  ASSERT_TRUE(writes.post({{.signal = {&speed, Type::LREAL}, .value = {.r = 2.5}},
                           {.signal = {&small, Type::SINT}, .value = {.i = -100}},
                           {.signal = {&flag, Type::BOOL}, .value = {.u = 1}}}));
  EXPECT_FALSE(writes.is_applied());
  EXPECT_EQ(speed, 1.5) << "nothing before a tick";
  EXPECT_FALSE(writes.post({})) << "one batch at a time";
  writes.apply(17);
  EXPECT_TRUE(writes.is_applied());
  EXPECT_EQ(writes.tick(), 17);
  EXPECT_EQ(speed, 2.5);
  EXPECT_EQ(small, -100);
  EXPECT_TRUE(flag);
  EXPECT_EQ(writes.batch()[0].before.r, 1.5);
  EXPECT_EQ(writes.batch()[1].before.i, -3);
  speed = 7.0;
  writes.apply(18);
  EXPECT_EQ(speed, 7.0) << "once only";
}

TEST(ChosenWrites, TheLastOfABatchWins) {
  ChosenWrites writes;
  INT number = 0;
  ASSERT_TRUE(writes.post({{.signal = {&number, Type::INT}, .value = {.i = 1}},
                           {.signal = {&number, Type::INT}, .value = {.i = 2}}}));
  writes.apply(0);
  EXPECT_EQ(number, 2);
  EXPECT_EQ(writes.batch()[1].before.i, 1);
}

TEST(ChosenWrites, ChangeOnlyTheBitsOfTheirMask) {
  ChosenWrites writes;
  WORD word{0xff00};
  SINT sign = 0x0f;
  ASSERT_TRUE(writes.post({{.signal = {&word, Type::WORD}, .value = {.u = 0x000f}, .mask = 0x00ff},
                           {.signal = {&word, Type::WORD, 15}, .value = {.u = 0}},
                           {.signal = {&sign, Type::SINT}, .value = {.u = 0x80}, .mask = 0x80}}));
  writes.apply(0);
  EXPECT_EQ(word, WORD{0x7f0f});
  EXPECT_EQ(sign, static_cast<SINT>(0x8f));
  EXPECT_EQ(writes.batch()[1].before.u, 1u);
}

TEST(ChosenWrites, ReplaceATextWithinItsCapacity) {
  ChosenWrites writes;
  std::array<char, 6> memory{"abcde"};
  const Text text{memory.data(), 5};
  ASSERT_TRUE(writes.post({{.text = text, .new_text = "xy"}}));
  writes.apply(0);
  EXPECT_EQ(text.view(), "xy");
  EXPECT_EQ(writes.batch()[0].old_text, "abcde");
}

TEST(ChosenWrites, RefuseABatchThatATickCouldNotTakeQuickly) {
  ChosenWrites writes;
  LREAL value = 0.0;
  std::vector<ChosenWrite> batch(ChosenWrites::kMaximum + 1, {.signal = {&value, Type::LREAL}});
  EXPECT_FALSE(writes.post(batch));
  batch.pop_back();
  EXPECT_TRUE(writes.post(batch));
}

TEST(ChosenWrites, AllocateNothingInATick) {
  ChosenWrites writes;
  std::array<char, 11> memory{};
  LREAL value = 0.0;
  ASSERT_TRUE(writes.post({{.signal = {&value, Type::LREAL}, .value = {.r = 1.0}},
                           {.text = {memory.data(), 10}, .new_text = "0123456789"}}));
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counting;
    writes.apply(0);
    writes.apply(1);
  }
  EXPECT_EQ(test::allocations_counted(), before);
  EXPECT_EQ(value, 1.0);
}

/// Batches of all of some signals, from another thread: each tick shows whole batches only, in their order.
TEST(ChosenWrites, AreWholeBetweenTwoThreads) {
  const std::uint64_t seed = test::seed_of_run(29);
  SCOPED_TRACE(seed);
  constexpr std::uint64_t kBatches = 20'000;
  ChosenWrites writes;
  std::array<ULINT, 5> signals{};
  std::atomic<bool> over{false};
  std::thread cycle([&] {
    std::uint64_t last = 0;
    for (std::int64_t tick = 0; !over.load(); ++tick) {
      writes.apply(tick);
      for (const ULINT value : signals) ASSERT_EQ(value, signals[0]) << "torn in tick " << tick;
      ASSERT_GE(signals[0], last);
      last = signals[0];
      if (tick % 64 == 0) std::this_thread::yield();
    }
  });
  std::int64_t last_tick = -1;
  std::uint64_t random = seed;
  for (std::uint64_t number = 1; number <= kBatches; ++number) {
    std::vector<ChosenWrite> batch;
    for (ULINT& signal : signals) batch.push_back({.signal = {&signal, Type::ULINT}, .value = {.u = number}});
    random = random * 6364136223846793005u + 1442695040888963407u;
    std::swap(batch[random >> 61 & 3], batch[4]);
    while (!writes.post(batch)) std::this_thread::yield();
    while (!writes.is_applied()) std::this_thread::yield();
    ASSERT_GT(writes.tick(), last_tick);
    last_tick = writes.tick();
    for (const ChosenWrite& write : writes.batch()) ASSERT_EQ(write.before.u, number - 1);
  }
  over = true;
  cycle.join();
}

}  // namespace
}  // namespace lockstep::chosen_writes_test
