#include "scheduler/signal_tap.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "tests/support/allocations.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/seeds.hpp"

namespace lockstep::signal_tap_test {
namespace {

std::unique_ptr<TraceRing> ring_of(std::vector<Signal> signals, std::size_t rows = 8) {
  return std::make_unique<TraceRing>(std::move(signals), rows);
}

void row_of_cycle(SignalTap& tap, std::uint64_t tick) {
  tap.exchange();
  tap.push(static_cast<std::int64_t>(tick) * 1000, tick);
}

std::vector<SignalTap::Row> drained(SignalTap& tap) {
  std::vector<SignalTap::Row> rows;
  tap.drain([&](const SignalTap::Row& row) { rows.push_back(row); });
  return rows;
}

TEST(SignalTap, WithoutARingNothingIsPushed) {
  SignalTap tap;
  row_of_cycle(tap, 0);
  EXPECT_TRUE(tap.wait_for_space());
  EXPECT_TRUE(drained(tap).empty());
}

TEST(SignalTap, RowsGoToTheRingThatWasHandedOverLastAndStayInTheOneBefore) {
  SignalTap tap;
  LREAL first = 1.0;
  LREAL second = 20.0;
  ASSERT_EQ(tap.hand_over(ring_of({{&first, Type::LREAL}})), 1u);
  row_of_cycle(tap, 0);
  ASSERT_EQ(tap.hand_over(ring_of({{&second, Type::LREAL}, {&first, Type::LREAL}})), 2u);
  EXPECT_FALSE(tap.is_taken());
  EXPECT_EQ(tap.hand_over(nullptr), 0u) << "the cycle has not turned to the last one";
  row_of_cycle(tap, 1);

  std::vector<std::vector<double>> values;
  std::vector<std::uint64_t> rings;
  tap.drain([&](const SignalTap::Row& row) {
    rings.push_back(row.ring);
    std::vector<double>& of_row = values.emplace_back();
    for (const Value value : row.row.values) of_row.push_back(value.r);
  });
  EXPECT_EQ(rings, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(values, (std::vector<std::vector<double>>{{1.0}, {20.0, 1.0}}));
}

TEST(SignalTap, HandingOverNoneEndsIt) {
  SignalTap tap;
  LREAL value = 1.0;
  tap.hand_over(ring_of({{&value, Type::LREAL}}));
  row_of_cycle(tap, 0);
  ASSERT_EQ(tap.hand_over(nullptr), 2u);
  row_of_cycle(tap, 1);
  EXPECT_EQ(drained(tap).size(), 1u);
  ASSERT_EQ(tap.hand_over(ring_of({{&value, Type::LREAL}})), 3u);
  row_of_cycle(tap, 2);
  const std::vector<SignalTap::Row> rows = drained(tap);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].row.tick, 2u);
}

TEST(SignalTap, CountsWhatFindsARingFullAcrossAllRings) {
  SignalTap tap;
  LREAL value = 1.0;
  tap.hand_over(ring_of({{&value, Type::LREAL}}, 2));
  for (std::uint64_t tick = 0; tick < 5; ++tick) row_of_cycle(tap, tick);
  EXPECT_EQ(tap.dropped(), 3u);
  EXPECT_EQ(drained(tap).size(), 2u);
  tap.hand_over(ring_of({{&value, Type::LREAL}}, 2));
  row_of_cycle(tap, 5);
  const std::vector<SignalTap::Row> rows = drained(tap);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].dropped, 3u);
}

TEST(SignalTap, AClosedOneLetsVirtualTimeGoOn) {
  SignalTap tap;
  LREAL value = 1.0;
  tap.hand_over(ring_of({{&value, Type::LREAL}}, 2));
  row_of_cycle(tap, 0);
  row_of_cycle(tap, 1);
  tap.close();
  EXPECT_FALSE(tap.wait_for_space());
}

// In a soak 10⁵ exchanges. Each row has the tick in all its columns, so that a torn one shows.
TEST(SignalTap, NoRowIsTornMissingOrDoubledWhileRingsAreExchanged) {
  const auto exchanges = static_cast<std::uint64_t>(test::cases(2'000, 100'000));
  SignalTap tap;
  std::array<std::uint64_t, 4> cells{};
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> allocations{1};
  std::thread cycle([&] {
    const std::uint64_t before = test::allocations_counted();
    {
      const test::CountAllocations counting;
      for (std::uint64_t tick = 0; !stop.load(std::memory_order_relaxed); ++tick) {
        cells.fill(tick);
        row_of_cycle(tap, tick);
        // As the runner in virtual time: then no row is dropped.
        tap.wait_for_space();
      }
    }
    allocations = test::allocations_counted() - before;
  });
  std::mt19937_64 chance(test::seed_of_run(23));
  std::vector<std::size_t> columns(exchanges + 1, 0);
  bool begun = false;
  std::uint64_t last = 0;
  std::uint64_t faults = 0;
  std::uint64_t rings = 0;
  while (rings < exchanges) {
    const std::size_t wanted = 1 + chance() % cells.size();
    std::vector<Signal> signals;
    for (std::size_t i = 0; i < wanted; ++i) signals.push_back({&cells[i], Type::ULINT});
    if (const std::uint64_t ring = tap.hand_over(ring_of(std::move(signals), 64)); ring != 0) {
      columns[ring] = wanted;
      rings = ring;
    }
    tap.drain([&](const SignalTap::Row& row) {
      if (begun && row.row.tick != last + 1) ++faults;
      if (row.row.values.size() != columns[row.ring]) ++faults;
      for (const Value value : row.row.values) faults += value.u != row.row.tick ? 1 : 0;
      begun = true;
      last = row.row.tick;
    });
  }
  stop = true;
  tap.close();
  cycle.join();
  EXPECT_EQ(faults, 0u);
  EXPECT_EQ(tap.dropped(), 0u);
  EXPECT_GT(last, 1000u);
  EXPECT_EQ(allocations.load(), 0u);
}

TEST(SignalTap, OfAControllerHasTheRowsOfItsTrace) {
  test::Rig rig(1'000'000, 2);
  Axis& axis = rig.axis("A");
  const Signal position{&axis.data.Position, Type::LREAL};
  TraceRing trace({position}, 64);
  SignalTap tap;
  rig.controller.trace = &trace;
  rig.controller.tap = &tap;
  rig.run(4);
  tap.hand_over(ring_of({position}, 64));
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counting;
    for (int tick = 0; tick < 12; ++tick) rig.controller.tick();
  }
  EXPECT_EQ(test::allocations_counted(), before);
  std::vector<std::uint64_t> ticks;
  tap.drain([&](const SignalTap::Row& row) { ticks.push_back(row.row.tick); });
  EXPECT_EQ(ticks, (std::vector<std::uint64_t>{4, 6, 8, 10, 12, 14}));
  ASSERT_EQ(trace.readable(), 8u);
  EXPECT_EQ(trace.row(2).tick, 4u);
}

}  // namespace
}  // namespace lockstep::signal_tap_test
