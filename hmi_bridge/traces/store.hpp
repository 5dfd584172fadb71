/// A trace in memory that can be looked at from any distance: rows in portions with pyramids of their
/// extremes. Of a run that goes on, of a file, of what a trigger has caught.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"
#include "hmi_bridge/traces/table.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// How much of a trace is kept; beyond it the oldest rows go.
struct TraceStoreLimits {
  std::int64_t history = std::numeric_limits<std::int64_t>::max();  ///< [ns], a portion more at most
  std::size_t bytes = std::numeric_limits<std::size_t>::max();      ///< of all portions but the newest
};

/// A part of a trace, as it is drawn: rows, or what several of them come to.
struct TraceWindow {
  /// Values of a signal, one for each point; NaN of a real one, where a row has none of the signal.
  struct Column {
    std::size_t signal = 0;    ///< index into the signals of the store
    Type type = Type::LREAL;   ///< of the values; LREAL where some are missing
    std::vector<Value> first;  ///< of rows the values themselves; the others are empty then
    std::vector<Value> minimum, maximum, last;
  };
  bool is_coarse = false;           ///< points are several rows each
  std::vector<std::int64_t> t;      ///< of the first row of each point [ns]
  std::vector<std::uint64_t> tick;  ///< of the first row of each point
  std::vector<Column> columns;      ///< as they were asked for
};

/// What a signal comes to between two times, of rows that have it. Values as reals; TIME in seconds.
struct TraceStatistics {
  std::uint64_t rows = 0;  ///< that have a number
  std::uint64_t nans = 0;  ///< that have none
  double minimum = 0.0, maximum = 0.0;
  std::int64_t t_minimum = 0, t_maximum = 0;  ///< of the first row that has it [ns]
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of all the rows, not of a sample
  double rms = 0.0;
  double integral = 0.0;  ///< over time [u·s], by trapezoids between neighbouring rows
  double first = 0.0, last = 0.0;
};

/// Rows have numbers from 0 on, which stay theirs when older ones go. Signals may come and go while it grows:
/// then rows have no value of some. Not for several threads at once.
class TraceStore {
 public:
  static constexpr std::size_t kPortion = 4096;  ///< rows
  static constexpr std::size_t kFan = 16;        ///< rows, or buckets, that a bucket of a pyramid is made of

  /// Rows are missing before one.
  struct Gap {
    std::int64_t t = 0;         ///< of the row behind it [ns]
    std::uint64_t row = 0;      ///< its number
    std::uint64_t missing = 0;  ///< rows
  };

  explicit TraceStore(TraceStoreLimits limits = {}) : limits_(limits) {}
  /// Of a whole trace, such as a file; times are rounded to nanoseconds, `tick` is the number of the row.
  explicit TraceStore(const TraceTable& table);

  /// What the values of the rows from here on are. A signal that was there before keeps its index.
  void set_signals(std::span<const TraceSignal> signals);
  /// Adds a row. @param t [ns], not less than that of the row before
  /// @param values of the signals that were set last, in their order
  /// @param missing rows that should have come between the one before and this
  void append(std::int64_t t, std::uint64_t tick, std::span<const Value> values, std::uint64_t missing = 0);

  /// All that have ever been set.
  const std::vector<TraceSignal>& signals() const noexcept { return signals_; }
  std::optional<std::size_t> find(std::string_view name) const noexcept;

  std::uint64_t begin() const noexcept { return begin_; }  ///< number of the oldest row that is kept
  std::uint64_t end() const noexcept { return end_; }      ///< number of the row that comes next
  std::int64_t t(std::uint64_t row) const noexcept;        ///< begin() ≤ row < end() [ns]
  /// Number of the first row that is not before a time; end(): there is none.
  std::uint64_t row_at(std::int64_t t) const noexcept;
  /// Memory of the rows [byte].
  std::size_t bytes() const noexcept;
  /// The newest of them, oldest first.
  const std::deque<Gap>& gaps() const noexcept { return gaps_; }

  /// The rows from `from` to before `to`, or what of them is kept; if there are more of them than `points`
  /// times four, in `points` stretches of the same time, of which those without rows are left out.
  /// @param signals indices
  TraceWindow window(std::span<const std::size_t> signals, std::uint64_t from, std::uint64_t to,
                     std::size_t points) const;
  /// The rows from `from` to before `to` in points of `per_point` rows each, the last one of what is left
  /// over.
  TraceWindow coarse(std::span<const std::size_t> signals, std::uint64_t from, std::uint64_t to,
                     std::uint64_t per_point) const;
  /// The rows themselves.
  TraceWindow rows(std::span<const std::size_t> signals, std::uint64_t from, std::uint64_t to) const;
  TraceStatistics statistics(std::size_t signal, std::uint64_t from, std::uint64_t to) const;
  /// A trace of its own of these rows, with all their signals and gaps.
  TraceStore copy(std::uint64_t from, std::uint64_t to) const;

 private:
  static constexpr std::size_t kLevels = 3;  // of 16, 256 and 4096 rows
  static constexpr std::uint32_t kNoColumn = ~std::uint32_t{0};

  struct Extremes {
    Value minimum, maximum;
  };
  struct Column {
    Type type;
    std::vector<Value> values;
    std::array<std::vector<Extremes>, kLevels> pyramid;  // whole buckets only
  };
  /// Rows that follow each other and have the same signals.
  struct Portion {
    std::uint64_t begin;
    std::vector<std::int64_t> t;
    std::vector<std::uint64_t> tick;
    std::vector<Column> columns;
    std::vector<std::uint32_t> column_of;  // by signal; beyond its end: none
    std::size_t bytes = 0;                 // once no row is added any more
    std::uint64_t end() const noexcept { return begin + t.size(); }
    const Column* column(std::size_t signal) const noexcept;
  };
  /// What several rows come to.
  struct Point {
    Value first, minimum, maximum, last;
    bool is_present = false;
  };

  static bool is_number(Value value, Type type) noexcept;
  static void widen(Extremes& extremes, const Extremes& by, Type type) noexcept;
  static void build(Column& column);
  static std::size_t bytes_of(const Portion& portion) noexcept;
  void open_portion();
  void forget_oldest();
  std::size_t portion_of(std::uint64_t row) const noexcept;
  static Extremes extremes_of(const Column& column, std::size_t from, std::size_t to) noexcept;
  Point point_of(std::size_t signal, std::uint64_t from, std::uint64_t to) const noexcept;
  bool is_missing(std::size_t signal, std::uint64_t from, std::uint64_t to) const noexcept;
  std::pair<std::uint64_t, std::uint64_t> kept(std::uint64_t from, std::uint64_t to) const noexcept;
  TraceWindow points(std::span<const std::size_t> signals, std::span<const std::uint64_t> borders) const;

  TraceStoreLimits limits_;
  std::vector<TraceSignal> signals_;
  std::vector<std::size_t> current_;  // signals of the rows that are added
  bool opens_ = true;                 // the next row begins a portion
  std::deque<Portion> portions_;
  std::deque<Gap> gaps_;
  std::uint64_t begin_ = 0, end_ = 0;
  std::size_t closed_bytes_ = 0;  // of all portions but the newest
};

}  // namespace lockstep
