/// The crossing of values that somebody chooses while the cycle runs, such as those on a page of the studio.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "scheduler/chosen_writes.hpp"
#include "scheduler/come_near.hpp"
#include "scheduler/trace_ring.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"

namespace lockstep {

/// A trace ring that is exchanged while the cycle pushes into it. The bridge makes a ring of the signals that
/// are wanted now and hands it over; the cycle turns to it between two rows, and what it has pushed into the
/// ring before stays there to be read. So no row is missing, torn or there twice, and nothing is made or
/// given back in a tick. Neither side waits for the other. Without a ring a tick costs two loads.
/// Threads: the *cycle* exchanges and pushes, the *bridge* (one thread) hands over and reads.
class SignalTap {
 public:
  /// A row and what its values are.
  struct Row {
    TraceRow row;
    std::uint64_t ring = 0;     ///< number of the ring: the first one handed over is 1
    std::uint64_t dropped = 0;  ///< rows that found a ring full before this one, of all rings
  };

  SignalTap() = default;
  SignalTap(const SignalTap&) = delete;
  SignalTap& operator=(const SignalTap&) = delete;

  /// Turns to the ring that was handed over last. Between two rows. Thread: the cycle.
  void exchange() noexcept {
    const std::uint64_t wanted = wanted_.load(std::memory_order_acquire);
    if (wanted == number_) return;
    ring_ = handed_over_;
    number_ = wanted;
    taken_.store(wanted, std::memory_order_release);
  }
  /// Has what a tick looks at of this one brought near, while the tick computes. Thread: the cycle.
  void fetch() const noexcept {
    come_near_for_reading(&writes);
    come_near_for_reading(&ring_);
  }
  /// What the next `push` will need. Thread: the cycle.
  RowAhead ahead() const noexcept { return ring_ != nullptr ? ring_->ahead() : RowAhead(); }
  /// Reads the signals into the ring, if there is one. Thread: the cycle.
  void push(std::int64_t t, std::uint64_t tick) noexcept {
    if (ring_ != nullptr) ring_->push(t, tick);
  }
  /// Returns when there is space for a row or the bridge reads no more; at once without a ring. Thread: the
  /// one of the cycle, between two ticks of virtual time.
  bool wait_for_space() const noexcept { return ring_ == nullptr || ring_->wait_for_space(); }

  /// Whether the cycle has turned to what was handed over last, or nothing has been yet. Thread: the bridge.
  bool is_taken() const noexcept { return taken_.load(std::memory_order_acquire) == last_number_; }
  /// Has the cycle turn to a ring; nullptr: to none. @return the number of the ring; 0: the one before has
  /// not been taken or its predecessor has not been read to its end, nothing has happened. Thread: the
  /// bridge.
  std::uint64_t hand_over(std::unique_ptr<TraceRing> ring);
  /// Calls `visit(const Row&)` for each row there is, oldest first. Thread: the bridge.
  template <class Visit>
  void drain(Visit visit) {
    // Looked at first: once it is taken, nobody pushes into the one before any more.
    const bool taken = is_taken();
    if (before_) {
      read_ring(*before_, last_number_ - 1, visit);
      if (taken) give_back();
    }
    if (current_ && taken) read_ring(*current_, last_number_, visit);
  }
  /// Rows that found a ring full. Thread: the bridge.
  std::uint64_t dropped() const noexcept;
  /// Nothing is read any more: ends a `wait_for_space`. Thread: the bridge.
  void close() noexcept;

  /// The other direction: what is written to signals that somebody chooses.
  ChosenWrites writes;

 private:
  template <class Visit>
  void read_ring(TraceRing& ring, std::uint64_t number, Visit& visit) {
    const std::size_t rows = ring.readable();
    for (std::size_t i = 0; i < rows; ++i) {
      const TraceRow row = ring.row(i);
      visit(Row{row, number, dropped_before_ + row.dropped});
    }
    ring.pop(rows);
  }
  void give_back() noexcept;

  // In one line, which is written only where a ring is handed over. The cycle's:
  alignas(kCacheLine) TraceRing* ring_ = nullptr;
  std::uint64_t number_ = 0;
  // Each side writes one of the numbers; what is handed over belongs to the cycle as long as they differ.
  std::atomic<std::uint64_t> wanted_{0};
  TraceRing* handed_over_ = nullptr;
  std::atomic<std::uint64_t> taken_{0};

  // The bridge's.
  alignas(kCacheLine) std::uint64_t last_number_ = 0;
  std::unique_ptr<TraceRing> current_;  // handed over last
  std::unique_ptr<TraceRing> before_;   // that the cycle may still push into, or that is not read to its end
  std::uint64_t dropped_before_ = 0;    // by rings that were given back
};

}  // namespace lockstep
