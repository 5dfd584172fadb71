#include "scheduler/triple_buffer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace lockstep::triple_buffer_test {
namespace {

TEST(TripleBuffer, TheReaderSeesTheInitialValueBeforeTheFirstPublication) {
  TripleBuffer<int> buffer(42);
  EXPECT_FALSE(buffer.refresh());
  EXPECT_EQ(buffer.front(), 42);
}

TEST(TripleBuffer, TheReaderGetsTheNewestOfSeveralPublications) {
  TripleBuffer<int> buffer(0);
  for (int i = 1; i <= 5; ++i) {
    buffer.back() = i;
    buffer.publish();
  }
  EXPECT_TRUE(buffer.refresh());
  EXPECT_EQ(buffer.front(), 5);
  EXPECT_FALSE(buffer.refresh());
  EXPECT_EQ(buffer.front(), 5);
}

TEST(TripleBuffer, WhatTheReaderHoldsStaysAsItIsWhileTheWriterGoesOn) {
  TripleBuffer<int> buffer(0);
  buffer.back() = 1;
  buffer.publish();
  ASSERT_TRUE(buffer.refresh());
  for (int i = 2; i <= 10; ++i) {
    buffer.back() = i;
    buffer.publish();
    EXPECT_EQ(buffer.front(), 1);
  }
  buffer.back() = 99;  // not published
  ASSERT_TRUE(buffer.refresh());
  EXPECT_EQ(buffer.front(), 10);
}

TEST(TripleBuffer, NoOrderOfStepsGivesBothSidesTheSameSlot) {
  // Every order of 12 steps: a set bit publishes, a clear one refreshes.
  for (unsigned order = 0; order < 1u << 12; ++order) {
    TripleBuffer<int> buffer(0);
    int published = 0;
    for (unsigned step = 0; step < 12; ++step) {
      if ((order >> step & 1u) != 0) {
        buffer.back() = ++published;
        buffer.publish();
      } else {
        buffer.refresh();
        ASSERT_EQ(buffer.front(), published) << "order " << order << " step " << step;
      }
      ASSERT_NE(&buffer.back(), &buffer.front());
    }
  }
}

TEST(TripleBuffer, BetweenThreadsNoValueIsTornAndNoneIsOlderThanTheOneBefore) {
  using Block = std::array<std::uint64_t, 64>;
  constexpr std::uint64_t kLast = 200'000;
  TripleBuffer<Block> buffer(Block{});
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= kLast; ++n) {
      buffer.back().fill(n);
      buffer.publish();
    }
  });
  std::uint64_t last = 0;
  std::uint64_t torn = 0;
  std::uint64_t backwards = 0;
  while (last != kLast) {
    if (!buffer.refresh()) continue;
    const Block& block = buffer.front();
    for (const std::uint64_t word : block) torn += word != block[0] ? 1 : 0;
    backwards += block[0] <= last ? 1 : 0;
    last = block[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
}

}  // namespace
}  // namespace lockstep::triple_buffer_test
