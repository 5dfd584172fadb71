// Channels of a trace: which rows they let through.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "hmi_bridge/traces/channel.hpp"

namespace lockstep::trace_channel_test {
namespace {

using Ticks = std::vector<std::uint64_t>;

class Heard final : public TraceSink {
 public:
  explicit Heard(Ticks& ticks) : ticks_(ticks) {}
  void begin(std::span<const TraceSignal> /*signals*/) override {}
  void row(const TraceRow& row) override {
    EXPECT_EQ(row.values[0].u, row.tick) << "the values of another row";
    ticks_.push_back(row.tick);
  }
  void flush() override {}
  void end() override {}
  std::string_view name() const noexcept override { return "heard"; }

 private:
  Ticks& ticks_;
};

constexpr std::int64_t kRow = 1'000'000;  // [ns]

/// The rows that a channel lets through of a run, a millisecond each, in which a signal has these values.
Ticks rows_of(const TraceSelection& selection, const std::vector<double>& signal) {
  Ticks ticks;
  TraceChannel channel(std::make_unique<Heard>(ticks), {1}, selection, 0);
  channel.begin(std::array{TraceSignal{"signal", Type::LREAL, ""}, TraceSignal{"tick", Type::ULINT, ""}});
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const Value values[] = {{.r = signal[i]}, {.u = i}};
    channel.row({static_cast<std::int64_t>(i) * kRow, i, 0, values});
  }
  channel.end();
  return ticks;
}

/// A signal that is 1 in some of twenty-five rows, else 0.
std::vector<double> ones_at(const Ticks& ticks) {
  std::vector<double> signal(25, 0.0);
  for (const std::uint64_t tick : ticks) signal[tick] = 1.0;
  return signal;
}

TEST(TraceChannel, ShowsTheRowsInWhichASignalIsBelowALevel) {
  const TraceSelection selection{.trigger = TriggerKind::below, .level = 2.5};
  EXPECT_EQ(rows_of(selection, {3.0, 2.0, 2.5, 2.4, 9.0, -1.0}), (Ticks{1, 3, 5}));
}

TEST(TraceChannel, ShowsEachNthRowAroundAnOccasionByItsPlaceInTheRun) {
  const TraceSelection selection{
      .every = 3, .trigger = TriggerKind::rising, .before = 4 * kRow, .after = 4 * kRow};
  EXPECT_EQ(rows_of(selection, ones_at({10})), (Ticks{6, 9, 12})) << "the occasion itself is not one of them";
  EXPECT_EQ(rows_of(selection, ones_at({12})), (Ticks{9, 12, 15}));
}

TEST(TraceChannel, IsProlongedByAnOccasionMeanwhileAndShowsNoRowTwice) {
  const TraceSelection selection{.trigger = TriggerKind::rising, .before = 2 * kRow, .after = 4 * kRow};
  EXPECT_EQ(rows_of(selection, ones_at({5, 8})), (Ticks{3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(rows_of(selection, ones_at({5, 10})), (Ticks{3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}))
      << "what comes right behind it begins where the first one ended";
  EXPECT_EQ(rows_of(selection, ones_at({5, 20})), (Ticks{3, 4, 5, 6, 7, 8, 9, 18, 19, 20, 21, 22, 23, 24}));
}

// lcm-logger holds 30 messages; a burst of hundreds would lose what the trigger is for.
TEST(TraceChannel, HandsRowsFromBeforeAnOccasionOnAFewAtATimeAndNoneIsLeftAtTheEnd) {
  const TraceSelection selection{.trigger = TriggerKind::rising, .before = 40 * kRow, .after = 2 * kRow};
  Ticks ticks;
  TraceChannel channel(std::make_unique<Heard>(ticks), {1}, selection, 0);
  channel.begin(std::array{TraceSignal{"signal", Type::LREAL, ""}, TraceSignal{"tick", Type::ULINT, ""}});
  std::size_t maximum = 0;
  const auto run = [&](std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t i = from; i < to; ++i) {
      const Value values[] = {{.r = i == 50 || i == 58 ? 1.0 : 0.0}, {.u = i}};
      const std::size_t before = ticks.size();
      channel.row({static_cast<std::int64_t>(i) * kRow, i, 0, values});
      maximum = std::max(maximum, ticks.size() - before);
    }
  };
  run(0, 60);  // the second occasion comes while rows of the first one still wait
  EXPECT_GT(ticks.size(), 20u);
  EXPECT_LE(maximum, TraceChannel::kAtOnce);
  channel.end();
  Ticks expected;
  for (std::uint64_t i = 10; i < 60; ++i) expected.push_back(i);
  EXPECT_EQ(ticks, expected);
}

TEST(TraceChannel, RowsThatNoOccasionAsksForAreForgottenAlsoBehindThoseThatStillWait) {
  const TraceSelection selection{.trigger = TriggerKind::rising, .before = 20 * kRow, .after = 0};
  std::vector<double> signal(100, 0.0);
  signal[30] = signal[80] = 1.0;
  Ticks expected;
  for (std::uint64_t i = 10; i <= 30; ++i) expected.push_back(i);
  for (std::uint64_t i = 60; i <= 80; ++i) expected.push_back(i);
  EXPECT_EQ(rows_of(selection, signal), expected);
}

}  // namespace
}  // namespace lockstep::trace_channel_test
