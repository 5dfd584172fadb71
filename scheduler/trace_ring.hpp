/// The crossing of trace rows from the cycle to the recorder: a ring of fixed-size rows, one writer, one
/// reader, neither of which ever waits for the other inside a tick.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scheduler/signal_copies.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// One row of a trace: the values of all signals as they stood at the end of a tick.
struct TraceRow {
  std::int64_t t = 0;             ///< [ns] since the start of the run
  std::uint64_t tick = 0;         ///< number of the servo tick
  std::uint64_t dropped = 0;      ///< rows that found the ring full before this one, since the start
  std::span<const Value> values;  ///< one for each signal, in the order of the signals
};

class TraceRing;

/// Where the next row of a ring will be pushed. Known since the last one, so that the memory for it can be
/// fetched at the begin of a tick without a look at any of it, while the tick computes: between two ticks
/// others use the processor, and each line that is not there is waited for, one after the other where one
/// leads to the next.
class RowAhead {
 public:
  RowAhead() = default;
  RowAhead(const TraceRing* ring, const void* row, std::size_t row_lines, std::span<const void* const> plan)
      : ring_(ring),
        row_(row),
        plan_(plan.data()),
        row_lines_(static_cast<std::uint32_t>(row_lines)),
        planned_(static_cast<std::uint32_t>(plan.size())) {}

  /// Has it brought near. A ring that is not there any more, or never was, does no harm.
  void fetch() const noexcept;

 private:
  const TraceRing* ring_ = nullptr;
  const void* row_ = nullptr;
  const void* const* plan_ = nullptr;
  std::uint32_t row_lines_ = 0;
  std::uint32_t planned_ = 0;
};

/// The cycle copies what stands in memory; what the values are is found out by who reads them. A row has
/// lines of the cache of its own, which the recorder had last. Threads: the *cycle* pushes, the *runner* (the
/// same thread, between two ticks) may wait, the *recorder* reads.
class TraceRing {
 public:
  /// Rows that outlast a disk's pause of some seconds at the usual cycles, and keep virtual time from waiting
  /// for the recorder's naps.
  static constexpr std::size_t kRows = 8192;

  /// Allocates and touches all memory. Holds at least `rows` rows (rounded up to a power of two, at least 2).
  /// What the signals point at must outlive the last `push`.
  explicit TraceRing(std::vector<Signal> signals, std::size_t rows = kRows);

  /// Cycle: reads the signals into the ring. A constant number of steps; no allocation, no system call.
  /// @param t [ns] since the start of the run
  /// @return false if the ring is full: the row is dropped and counted.
  bool push(std::int64_t t, std::uint64_t tick) noexcept;

  /// Cycle: what the next `push` will need, to be fetched early in that tick. Without it `push` takes longer.
  RowAhead ahead() const noexcept;

  /// Runner, between two ticks, never inside one: returns when there is space for a row, so that the next
  /// `push` succeeds. This is how virtual time waits for the disk.
  /// @return false if the recorder has closed the ring and there is no space: nobody will make any.
  bool wait_for_space() const noexcept;

  /// Rows dropped since the start. Any thread.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  /// Rows that can be read now. Recorder.
  std::size_t readable() const noexcept;
  /// The row at an index < `readable()`, oldest first; its values until the next call. Recorder.
  TraceRow row(std::size_t index) noexcept;
  /// Gives the oldest rows back; rows ≤ `readable()`. Recorder.
  void pop(std::size_t rows) noexcept;
  /// Nothing will be read any more: ends a `wait_for_space` in progress. Recorder.
  void close() noexcept;

  std::size_t capacity() const noexcept { return mask_ + 1; }  ///< [rows]
  std::size_t columns() const noexcept { return values_.size(); }

 private:
  friend class RowAhead;

  static constexpr std::size_t kPrefix = 3;  // t, tick, dropped stand before the values

  struct alignas(kCacheLine) Line {
    std::array<std::uint64_t, kCacheLine / sizeof(std::uint64_t)> words;
  };

  bool has_space() const noexcept;
  std::uint64_t* row_at(std::uint64_t number) const noexcept {
    return lines_[(number & mask_) * row_lines_].words.data();
  }

  // What the cycle only reads is one line, up to the plan of the copies; behind it comes what it writes.
  alignas(kCacheLine) std::uint64_t mask_;
  std::uint64_t row_lines_ = 0;
  std::unique_ptr<Line[]> lines_;
  SignalCopies copies_;

  // Both counters only grow; a row lives at counter & mask_. Each side owns a cache line.
  alignas(kCacheLine) std::atomic<std::uint64_t> written_{0};
  std::uint64_t known_read_ = 0;  // the writer's last look at read_
  std::atomic<std::uint64_t> dropped_{0};
  alignas(kCacheLine) std::atomic<std::uint64_t> read_{0};
  std::atomic<bool> closed_{false};
  std::vector<Value> values_;  // of the row that is read
};

}  // namespace lockstep
