#include "scheduler/spsc_queue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

namespace lockstep {
namespace {

std::vector<int> all_of(SpscQueue<int>& queue) {
  std::vector<int> items;
  queue.consume([&](int item) { items.push_back(item); });
  return items;
}

TEST(SpscQueue, GivesItemsInTheOrderInWhichTheyCame) {
  SpscQueue<int> queue(3);
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(std::array{2, 3}));
  EXPECT_EQ(all_of(queue), (std::vector{1, 2, 3}));
  EXPECT_EQ(all_of(queue), std::vector<int>{});
}

TEST(SpscQueue, HoldsExactlyItsCapacityEvenWhenThatIsNoPowerOfTwo) {
  for (const std::size_t capacity : {0u, 1u, 2u, 3u, 5u, 8u, 100u}) {
    SpscQueue<int> queue(capacity);
    for (int round = 0; round < 5; ++round) {
      std::vector<int> expected;
      for (std::size_t i = 0; i < capacity; ++i) {
        expected.push_back(static_cast<int>(i) + 1000 * round);
        EXPECT_TRUE(queue.push(expected.back()));
      }
      EXPECT_FALSE(queue.push(-1)) << capacity;
      EXPECT_EQ(all_of(queue), expected);
    }
  }
}

TEST(SpscQueue, RefusesAsAWholeABatchThatDoesNotFit) {
  SpscQueue<int> queue(4);
  EXPECT_FALSE(queue.push(std::array{1, 2, 3, 4, 5}));
  EXPECT_TRUE(queue.push(std::array{1, 2, 3}));
  EXPECT_FALSE(queue.push(std::array{4, 5}));
  EXPECT_TRUE(queue.push(4));
  EXPECT_EQ(all_of(queue), (std::vector{1, 2, 3, 4}));
}

TEST(SpscQueue, PopsOneByOne) {
  SpscQueue<int> queue(2);
  int item = 0;
  EXPECT_FALSE(queue.pop(item));
  EXPECT_TRUE(queue.push(std::array{7, 8}));
  EXPECT_TRUE(queue.pop(item));
  EXPECT_EQ(item, 7);
  EXPECT_TRUE(queue.push(9));
  EXPECT_EQ(all_of(queue), (std::vector{8, 9}));
}

TEST(SpscQueue, WhatIsPushedWhileItIsConsumedWaitsForTheNextTime) {
  SpscQueue<int> queue(8);
  ASSERT_TRUE(queue.push(1));
  EXPECT_EQ(queue.consume([&](int item) { EXPECT_TRUE(queue.push(item + 1)); }), 1u);
  EXPECT_EQ(all_of(queue), std::vector{2});
}

TEST(SpscQueue, BetweenThreadsNothingIsLostAndBatchesArriveWhole) {
  constexpr std::uint64_t kBatches = 100'000;
  struct Item {
    std::uint64_t batch;
    std::uint64_t left;  ///< items of the batch that follow
  };
  SpscQueue<Item> queue(50);
  std::thread producer([&] {
    std::vector<Item> batch;
    for (std::uint64_t n = 0; n < kBatches; ++n) {
      batch.clear();
      for (std::uint64_t left = n % 7 + 1; left-- > 0;) batch.push_back({n, left});
      while (!queue.push(batch)) std::this_thread::yield();
    }
  });
  std::uint64_t next = 0;
  std::uint64_t wrong = 0;
  std::uint64_t cut = 0;
  while (next != kBatches) {
    std::uint64_t left = 0;
    const std::size_t count = queue.consume([&](const Item& item) {
      wrong += item.batch != next ? 1 : 0;
      left = item.left;
      next += item.left == 0 ? 1 : 0;
    });
    cut += left != 0 ? 1 : 0;  // the last batch that was seen did not end
    if (count == 0) std::this_thread::yield();
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(cut, 0u);
}

}  // namespace
}  // namespace lockstep
