#include "scheduler/trace_ring.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <thread>
#include <utility>

namespace lockstep {

TraceRing::TraceRing(std::vector<Signal> signals, std::size_t rows)
    : signals_(std::move(signals)),
      stride_(kPrefix + signals_.size()),
      mask_(std::bit_ceil(std::max<std::size_t>(rows, 2)) - 1),
      cells_((mask_ + 1) * stride_) {}

bool TraceRing::push(std::int64_t t, std::uint64_t tick) noexcept {
  const std::uint64_t written = written_.load(std::memory_order_relaxed);
  const std::uint64_t dropped = dropped_.load(std::memory_order_relaxed);
  if (written - known_read_ > mask_) {
    known_read_ = read_.load(std::memory_order_acquire);
    if (written - known_read_ > mask_) {
      dropped_.store(dropped + 1, std::memory_order_relaxed);  // this thread alone writes it
      return false;
    }
  }
  Value* cell = cells_.data() + (written & mask_) * stride_;
  (cell++)->i = t;
  (cell++)->u = tick;
  (cell++)->u = dropped;
  for (const Signal& signal : signals_) *cell++ = signal.load();
  written_.store(written + 1, std::memory_order_release);
  return true;
}

bool TraceRing::has_space() const noexcept {
  return written_.load(std::memory_order_relaxed) - read_.load(std::memory_order_acquire) <= mask_;
}

bool TraceRing::wait_for_space() const noexcept {
  // The recorder is not made to wake anybody: a nap is short against the time in which it empties a ring.
  while (!has_space()) {
    if (closed_.load(std::memory_order_acquire)) return has_space();
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return true;
}

std::size_t TraceRing::readable() const noexcept {
  return written_.load(std::memory_order_acquire) - read_.load(std::memory_order_relaxed);
}

TraceRow TraceRing::row(std::size_t index) const noexcept {
  const Value* cell = cells_.data() + ((read_.load(std::memory_order_relaxed) + index) & mask_) * stride_;
  return {cell[0].i, cell[1].u, cell[2].u, {cell + kPrefix, signals_.size()}};
}

void TraceRing::pop(std::size_t rows) noexcept {
  read_.store(read_.load(std::memory_order_relaxed) + rows, std::memory_order_release);
}

void TraceRing::close() noexcept {
  closed_.store(true, std::memory_order_release);
}

}  // namespace lockstep
