#include "scheduler/trace_ring.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace lockstep::trace_ring_test {
namespace {

TEST(TraceRing, ARowHoldsTheValuesAtTheMomentOfThePush) {
  LREAL position = 1.5;
  DINT count = -7;
  UDINT word = 0b100;
  TraceRing ring({{&position, Type::LREAL}, {&count, Type::DINT}, {&word, Type::UDINT, 2}}, 8);
  ASSERT_TRUE(ring.push(2'000'000, 2));
  position = 9.0;
  word = 0;
  ASSERT_TRUE(ring.push(4'000'000, 4));

  ASSERT_EQ(ring.readable(), 2u);
  const TraceRow first = ring.row(0);
  EXPECT_EQ(first.t, 2'000'000);
  EXPECT_EQ(first.tick, 2u);
  EXPECT_EQ(first.dropped, 0u);
  ASSERT_EQ(first.values.size(), 3u);
  EXPECT_EQ(first.values[0].r, 1.5);
  EXPECT_EQ(first.values[1].i, -7);
  EXPECT_EQ(first.values[2].u, 1u);
  EXPECT_EQ(ring.row(1).values[0].r, 9.0);
  EXPECT_EQ(ring.row(1).values[2].u, 0u);
}

TEST(TraceRing, AFullRingDropsTheNewRowCountsItAndTellsTheNextOne) {
  LREAL value = 0.0;
  TraceRing ring({{&value, Type::LREAL}}, 3);
  ASSERT_EQ(ring.capacity(), 4u);
  for (std::uint64_t tick = 0; tick < 7; ++tick) {
    value = static_cast<double>(tick);
    EXPECT_EQ(ring.push(0, tick), tick < 4) << tick;
  }
  EXPECT_EQ(ring.dropped(), 3u);
  EXPECT_EQ(ring.row(3).tick, 3u) << "rows that were there stay as they were";
  EXPECT_EQ(ring.row(3).values[0].r, 3.0);
  EXPECT_EQ(ring.row(3).dropped, 0u);
  ring.pop(1);
  ASSERT_TRUE(ring.push(0, 7));
  EXPECT_EQ(ring.row(3).tick, 7u);
  EXPECT_EQ(ring.row(3).dropped, 3u);
}

TEST(TraceRing, ARingWithoutSignalsStillCarriesTimes) {
  TraceRing ring({}, 2);
  ASSERT_TRUE(ring.push(-1, 5));
  EXPECT_EQ(ring.row(0).t, -1);
  EXPECT_TRUE(ring.row(0).values.empty());
}

TEST(TraceRing, WaitingForSpaceReturnsAtOnceWhereThereIsSome) {
  TraceRing ring({}, 2);
  ring.push(0, 0);
  EXPECT_TRUE(ring.wait_for_space());
  ring.close();
  EXPECT_TRUE(ring.wait_for_space()) << "a closed ring still takes what fits";
}

TEST(TraceRing, ClosingEndsAWaitForSpaceThatNobodyWillMake) {
  TraceRing ring({}, 2);
  while (ring.push(0, 0)) continue;
  std::thread recorder([&ring] { ring.close(); });
  EXPECT_FALSE(ring.wait_for_space());
  recorder.join();
}

// Both threads run as fast as they can over a small ring; every row carries values that only fit each other.
TEST(TraceRing, NoRowIsLostTornOrReorderedWhileTheWriterWaits) {
  constexpr std::uint64_t kRows = 200'000;
  ULINT low = 0;
  ULINT high = 0;
  TraceRing ring({{&low, Type::ULINT}, {&high, Type::ULINT}}, 64);
  std::uint64_t wrong = 0;
  std::thread recorder([&] {
    for (std::uint64_t expected = 0; expected < kRows;) {
      const std::size_t rows = ring.readable();
      for (std::size_t i = 0; i < rows; ++i, ++expected) {
        const TraceRow row = ring.row(i);
        wrong += row.tick != expected || row.t != static_cast<std::int64_t>(2 * expected) ||
                 row.values[0].u != expected || row.values[1].u != ~expected || row.dropped != 0;
      }
      ring.pop(rows);
      if (rows == 0) std::this_thread::yield();
    }
  });
  std::uint64_t refused = 0;
  for (std::uint64_t tick = 0; tick < kRows; ++tick) {
    low = tick;
    high = ~tick;
    ring.wait_for_space();
    ring.ahead().fetch();  // whether there is space or not
    refused += !ring.push(static_cast<std::int64_t>(2 * tick), tick);
  }
  recorder.join();
  EXPECT_EQ(refused, 0u) << "after wait_for_space a push succeeds";
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(ring.dropped(), 0u);
}

/// A cycle asks for the row of a ring that somebody has taken away since its last tick.
TEST(TraceRing, ThatIsGoneIsNotTouchedByWhoFetchesItsNextRow) {
  LREAL value = 0.0;
  auto ring = std::make_unique<TraceRing>(std::vector<Signal>{{&value, Type::LREAL}}, 16);
  ring->push(0, 0);
  const RowAhead ahead = ring->ahead();
  ring.reset();
  ahead.fetch();
  RowAhead().fetch();
}

TEST(TraceRing, EveryRowOfAHurriedWriterIsEitherReadOrCounted) {
  constexpr std::uint64_t kRows = 300'000;
  ULINT value = 0;
  TraceRing ring({{&value, Type::ULINT}}, 16);
  std::atomic<bool> done{false};
  std::uint64_t read = 0;
  std::uint64_t wrong = 0;
  std::thread recorder([&] {
    for (bool last = false; !last;) {
      last = done.load();
      const std::size_t rows = ring.readable();
      for (std::size_t i = 0; i < rows; ++i, ++read) {
        const TraceRow row = ring.row(i);
        wrong += row.values[0].u != row.tick || row.tick != read + row.dropped;  // the gap is known exactly
      }
      ring.pop(rows);
    }
  });
  for (std::uint64_t tick = 0; tick < kRows; ++tick) {
    value = tick;
    ring.push(0, tick);
  }
  done = true;
  recorder.join();
  EXPECT_EQ(read + ring.dropped(), kRows);
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace lockstep::trace_ring_test
