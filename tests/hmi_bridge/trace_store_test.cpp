#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "hmi_bridge/traces/store.hpp"
#include "tests/support/values.hpp"

namespace lockstep::trace_store_test {
namespace {

using test::integer;
using test::real;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A row as it was given: none for a signal that was not set.
struct Given {
  std::int64_t t;
  std::vector<std::optional<double>> values;
};

const std::vector<TraceSignal> kAll = {
    {"a", Type::LREAL, "u"}, {"b", Type::DINT, ""}, {"c", Type::LREAL, ""}, {"d", Type::BOOL, ""}};

Value value_of(double number, Type type) {
  return is_real(type) ? real(number) : integer(static_cast<std::int64_t>(number));
}

/// Grows a store by chance, with signals that come and go, and keeps beside it what it was given.
class Pair {
 public:
  explicit Pair(std::uint64_t seed, TraceStoreLimits limits = {}) : store(limits), chance_(seed) {}

  void add(std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) {
      if (given.empty() || chance_() % 3000 == 0) choose();
      t_ += 1 + static_cast<std::int64_t>(chance_() % (chance_() % 50 == 0 ? 5000 : 50));
      Given row{t_, std::vector<std::optional<double>>(kAll.size())};
      std::vector<Value> values;
      for (const std::size_t signal : chosen_) {
        const double number = number_of(kAll[signal].type);
        row.values[signal] = number;
        values.push_back(value_of(number, kAll[signal].type));
      }
      store.append(t_, given.size(), values);
      given.push_back(row);
    }
  }

  std::uint64_t row_up_to(std::uint64_t last) { return chance_() % (last + 1); }
  std::size_t index_of(std::size_t signal) const { return store.find(kAll[signal].name).value(); }

  TraceStore store;
  std::vector<Given> given;

 private:
  void choose() {
    chosen_.clear();
    for (std::size_t i = 0; i < kAll.size(); ++i)
      if (given.empty() || chance_() % 4 != 0) chosen_.push_back(i);
    std::shuffle(chosen_.begin(), chosen_.end(), chance_);
    std::vector<TraceSignal> signals;
    for (const std::size_t signal : chosen_) signals.push_back(kAll[signal]);
    store.set_signals(signals);
  }
  double number_of(Type type) {
    if (type == Type::BOOL) return static_cast<double>(chance_() % 2);
    if (type == Type::DINT) return static_cast<double>(chance_() % 2'000'001) - 1e6;
    if (chance_() % 40 == 0) return kNaN;
    return std::uniform_real_distribution<double>(-1e3, 1e3)(chance_) * (chance_() % 900 == 0 ? 1e6 : 1.0);
  }

  std::mt19937_64 chance_;
  std::int64_t t_ = -5000;
  std::vector<std::size_t> chosen_;
};

/// What some rows come to, looked at one by one.
struct Slow {
  std::optional<double> first, last;
  double minimum = kNaN, maximum = kNaN;
};

Slow slow_point(const std::vector<Given>& given, std::size_t signal, std::uint64_t from, std::uint64_t to) {
  Slow slow;
  for (std::uint64_t row = from; row < to; ++row) {
    const std::optional<double> value = given[row].values[signal];
    if (!value) continue;
    if (!slow.first) slow.first = value;
    slow.last = value;
    if (std::isnan(*value)) continue;
    slow.minimum = std::isnan(slow.minimum) ? *value : std::min(slow.minimum, *value);
    slow.maximum = std::isnan(slow.maximum) ? *value : std::max(slow.maximum, *value);
  }
  return slow;
}

bool is_same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// Whether a point says of rows what they say themselves.
bool agrees(const TraceWindow::Column& column, std::size_t point, const Slow& slow) {
  const auto shown = [&](const std::vector<Value>& values) { return as_double(values[point], column.type); };
  return is_same(shown(column.first), slow.first.value_or(kNaN)) &&
         is_same(shown(column.last), slow.last.value_or(kNaN)) &&
         is_same(shown(column.minimum), slow.minimum) && is_same(shown(column.maximum), slow.maximum);
}

TEST(TraceStore, PointsOfAnyWindowAreWhatItsRowsComeTo) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Pair pair(seed);
    pair.add(20'000);
    for (int window = 0; window < 60; ++window) {
      std::uint64_t from = pair.row_up_to(pair.given.size());
      std::uint64_t to = pair.row_up_to(pair.given.size());
      if (from > to) std::swap(from, to);
      const std::size_t points = 1 + pair.row_up_to(300);
      const std::vector<std::size_t> signals = {pair.index_of(0), pair.index_of(1), pair.index_of(2),
                                                pair.index_of(3)};
      const TraceWindow seen = pair.store.window(signals, from, to, points);
      ASSERT_EQ(seen.is_coarse, to - from > 4 * points) << "seed " << seed;
      if (!seen.is_coarse) continue;
      ASSERT_LE(seen.t.size(), points);
      for (std::size_t point = 0; point < seen.t.size(); ++point) {
        const std::uint64_t begin = seen.tick[point];
        const std::uint64_t end = point + 1 < seen.t.size() ? seen.tick[point + 1] : to;
        ASSERT_EQ(seen.t[point], pair.given[begin].t);
        for (std::size_t signal = 0; signal < kAll.size(); ++signal)
          ASSERT_TRUE(agrees(seen.columns[signal], point, slow_point(pair.given, signal, begin, end)))
              << "seed " << seed << " rows " << begin << " to " << end << " of " << kAll[signal].name;
      }
      ASSERT_EQ(seen.tick.front(), from) << "every row is in a point";
    }
  }
}

TEST(TraceStore, CoarseRowsHoldEveryPeakOnce) {
  Pair pair(77);
  pair.add(9000);
  const std::vector<std::size_t> signals = {pair.index_of(0)};
  for (const std::uint64_t per_point : {1u, 7u, 16u, 100u, 4096u, 20'000u}) {
    const TraceWindow seen = pair.store.coarse(signals, 123, 8999, per_point);
    ASSERT_EQ(seen.t.size(), (8999 - 123 + per_point - 1) / per_point);
    for (std::size_t point = 0; point < seen.t.size(); ++point) {
      const std::uint64_t begin = 123 + point * per_point;
      EXPECT_TRUE(agrees(seen.columns[0], point,
                         slow_point(pair.given, 0, begin, std::min<std::uint64_t>(begin + per_point, 8999))));
    }
  }
}

TEST(TraceStore, RowsAreToTheBitWhatWasGiven) {
  TraceStore store;
  store.set_signals(std::vector<TraceSignal>{{"x", Type::LREAL, ""}, {"n", Type::ULINT, ""}});
  std::vector<Value> n(1);
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    n[0].u = ~i;
    store.append(static_cast<std::int64_t>(i), i,
                 std::vector<Value>{real(0.1 * static_cast<double>(i)), n[0]});
  }
  const TraceWindow seen = store.rows(std::vector<std::size_t>{1, 0}, 4000, 4200);
  ASSERT_EQ(seen.t.size(), 200u);
  for (std::uint64_t i = 0; i < 200; ++i) {
    EXPECT_EQ(seen.columns[0].first[i].u, ~(4000 + i)) << "beyond what a double can hold";
    EXPECT_EQ(seen.columns[1].first[i].r, 0.1 * static_cast<double>(4000 + i));
  }
}

TEST(TraceStore, RowsWithoutASignalHaveNoNumber) {
  TraceStore store;
  store.set_signals(std::vector<TraceSignal>{{"x", Type::LREAL, ""}});
  store.append(0, 0, std::vector<Value>{real(1.0)});
  store.set_signals(std::vector<TraceSignal>{{"n", Type::DINT, ""}, {"x", Type::LREAL, ""}});
  store.append(1, 1, std::vector<Value>{integer(7), real(2.0)});
  const TraceWindow seen = store.rows(std::vector<std::size_t>{0, 1}, 0, 2);
  EXPECT_EQ(seen.columns[0].first[1].r, 2.0);
  EXPECT_EQ(seen.columns[1].type, Type::LREAL);
  EXPECT_TRUE(std::isnan(seen.columns[1].first[0].r));
  EXPECT_EQ(seen.columns[1].first[1].r, 7.0);
}

TEST(TraceStore, FindsRowsByTime) {
  Pair pair(5);
  pair.add(9000);
  for (int i = 0; i < 300; ++i) {
    const std::int64_t t =
        pair.given[pair.row_up_to(8999)].t + static_cast<std::int64_t>(pair.row_up_to(3)) - 1;
    const auto row =
        std::find_if(pair.given.begin(), pair.given.end(), [t](const Given& one) { return one.t >= t; });
    EXPECT_EQ(pair.store.row_at(t), static_cast<std::uint64_t>(row - pair.given.begin()));
  }
  EXPECT_EQ(pair.store.row_at(std::numeric_limits<std::int64_t>::min()), 0u);
  EXPECT_EQ(pair.store.row_at(std::numeric_limits<std::int64_t>::max()), 9000u);
}

TEST(TraceStore, ForgetsTheOldestRowsByTimeAndByMemory) {
  Pair by_time(1, {.history = 100'000});
  by_time.add(30'000);
  EXPECT_GT(by_time.store.begin(), 0u);
  EXPECT_LE(by_time.store.t(by_time.store.begin()), by_time.given.back().t - 100'000)
      << "all of the history is there";
  Pair by_memory(1, {.bytes = 500'000});
  by_memory.add(40'000);
  EXPECT_GT(by_memory.store.begin(), 0u);
  EXPECT_LT(by_memory.store.bytes(), 800'000u) << "the limit and the newest portion";
  const TraceWindow seen = by_memory.store.rows(std::vector<std::size_t>{by_memory.index_of(0)}, 0, 40'000);
  EXPECT_EQ(seen.tick.front(), by_memory.store.begin()) << "numbers of rows stay theirs";
}

TEST(TraceStore, TakesLittleMoreMemoryThanItsData) {
  TraceStore store;
  std::vector<TraceSignal> signals;
  for (int i = 0; i < 10; ++i) signals.push_back({"s" + std::to_string(i), Type::LREAL, ""});
  store.set_signals(signals);
  const std::vector<Value> values(10, real(1.0));
  for (std::uint64_t i = 0; i < 100'000; ++i) store.append(static_cast<std::int64_t>(i), i, values);
  EXPECT_LE(static_cast<double>(store.bytes()), 1.3 * 100'000 * 12 * 8);
}

TEST(TraceStore, StatisticsAreThoseOfTheRows) {
  Pair pair(9);
  pair.add(5000);
  const TraceStatistics seen = pair.store.statistics(pair.index_of(0), 1000, 4000);
  double sum = 0.0;
  double power = 0.0;
  double integral = 0.0;
  std::uint64_t rows = 0;
  std::uint64_t nans = 0;
  for (std::uint64_t row = 1000; row < 4000; ++row) {
    const double value = pair.given[row].values[0].value_or(kNaN);
    const double before = row > 1000 ? pair.given[row - 1].values[0].value_or(kNaN) : kNaN;
    if (!std::isnan(value) && !std::isnan(before))
      integral +=
          (value + before) / 2 * static_cast<double>(pair.given[row].t - pair.given[row - 1].t) * 1e-9;
    if (std::isnan(value)) {
      ++nans;
      continue;
    }
    sum += value;
    power += value * value;
    ++rows;
  }
  const double mean = sum / static_cast<double>(rows);
  const double square = power / static_cast<double>(rows);
  const Slow slow = slow_point(pair.given, 0, 1000, 4000);
  EXPECT_EQ(seen.rows, rows);
  EXPECT_EQ(seen.nans, nans);
  EXPECT_GT(nans, 0u);
  EXPECT_EQ(seen.minimum, slow.minimum);
  EXPECT_EQ(seen.maximum, slow.maximum);
  EXPECT_EQ(seen.t_maximum, pair.store.t(pair.store.row_at(seen.t_maximum)));
  EXPECT_NEAR(seen.mean, mean, 1e-9 * std::sqrt(square));
  EXPECT_NEAR(seen.rms, std::sqrt(square), 1e-9 * std::sqrt(square));
  EXPECT_NEAR(seen.deviation, std::sqrt(square - mean * mean), 1e-9 * std::sqrt(square));
  EXPECT_NEAR(seen.integral, integral, 1e-12 + 1e-9 * std::abs(integral));
}

TEST(TraceStore, ACopyHasTheSameRowsAndSignals) {
  Pair pair(3);
  pair.add(9000);
  const TraceStore copy = pair.store.copy(2500, 8000);
  ASSERT_EQ(copy.end(), 5500u);
  for (std::size_t signal = 0; signal < kAll.size(); ++signal) {
    const TraceWindow theirs = pair.store.rows(std::vector<std::size_t>{pair.index_of(signal)}, 2500, 8000);
    const TraceWindow ours =
        copy.rows(std::vector<std::size_t>{copy.find(kAll[signal].name).value()}, 0, 5500);
    EXPECT_EQ(ours.t, theirs.t);
    for (std::size_t row = 0; row < 5500; ++row)
      ASSERT_EQ(ours.columns[0].first[row].u, theirs.columns[0].first[row].u);
  }
}

TEST(TraceStore, KnowsWhereRowsAreMissing) {
  TraceStore store;
  store.set_signals({});
  store.append(0, 0, {});
  store.append(5, 5, {}, 4);
  store.append(6, 6, {});
  ASSERT_EQ(store.gaps().size(), 1u);
  EXPECT_EQ(store.gaps()[0].t, 5);
  EXPECT_EQ(store.gaps()[0].row, 1u);
  EXPECT_EQ(store.gaps()[0].missing, 4u);
  EXPECT_TRUE(store.copy(1, 3).gaps().empty()) << "nothing is known of what was before the first row";
  EXPECT_EQ(store.copy(0, 3).gaps().size(), 1u);
}

TEST(TraceStore, HoldsATableAsTheReadersGiveIt) {
  TraceTable table;
  table.signals = {{"x", Type::LREAL, "u"}, {"n", Type::DINT, ""}, {"after", Type::TIME, "s"}};
  table.t = {0.0, 0.001, 0.002};
  table.columns = {{1.5, kNaN, 2.5}, {1.0, -2.0, 3.0}, {0.5, 0.25, 0.125}};
  const TraceStore store(table);
  const TraceWindow seen = store.rows(std::vector<std::size_t>{0, 1, 2}, 0, 3);
  EXPECT_EQ(seen.t, (std::vector<std::int64_t>{0, 1'000'000, 2'000'000}));
  EXPECT_EQ(seen.columns[0].first[2].r, 2.5);
  EXPECT_EQ(seen.columns[1].first[1].i, -2);
  EXPECT_EQ(seen.columns[2].first[1].i, 250'000'000);
}

TEST(TraceStore, AnEmptyOneHasAnEmptyWindow) {
  TraceStore store;
  store.set_signals(kAll);
  EXPECT_TRUE(store.window(std::vector<std::size_t>{0, 1}, 0, 100, 10).t.empty());
  EXPECT_EQ(store.statistics(0, 0, 100).rows, 0u);
  EXPECT_EQ(store.row_at(0), 0u);
}

}  // namespace
}  // namespace lockstep::trace_store_test
