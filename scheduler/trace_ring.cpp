#include "scheduler/trace_ring.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <thread>

#include "scheduler/come_near.hpp"

namespace lockstep {

TraceRing::TraceRing(std::vector<Signal> signals, std::size_t rows)
    : mask_(std::bit_ceil(std::max<std::size_t>(rows, 2)) - 1), copies_(signals), values_(signals.size()) {
  const std::size_t bytes = (kPrefix + copies_.words()) * sizeof(std::uint64_t);
  row_lines_ = (bytes + sizeof(Line) - 1) / sizeof(Line);
  lines_ = std::make_unique<Line[]>((mask_ + 1) * row_lines_);
}

void RowAhead::fetch() const noexcept {
  if (ring_ == nullptr) return;
  come_near_for_reading(&ring_->mask_);
  come_near_for_writing(&ring_->written_);
  const char* const row = static_cast<const char*>(row_);
  for (std::size_t line = 0; line < row_lines_; ++line) come_near_for_writing(row + line * kCacheLine);
  constexpr std::size_t kPlannedInALine = kCacheLine / sizeof(void*);
  for (std::size_t i = 0; i < planned_; i += kPlannedInALine) come_near_for_reading(plan_ + i);
}

RowAhead TraceRing::ahead() const noexcept {
  return {this, row_at(written_.load(std::memory_order_relaxed)), row_lines_, copies_.plan()};
}

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
  std::uint64_t* const row = row_at(written);
  row[0] = static_cast<std::uint64_t>(t);
  row[1] = tick;
  row[2] = dropped;
  copies_.take(row + kPrefix);
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

TraceRow TraceRing::row(std::size_t index) noexcept {
  const std::uint64_t* const row = row_at(read_.load(std::memory_order_relaxed) + index);
  copies_.read(row + kPrefix, values_);
  return {static_cast<std::int64_t>(row[0]), row[1], row[2], values_};
}

void TraceRing::pop(std::size_t rows) noexcept {
  read_.store(read_.load(std::memory_order_relaxed) + rows, std::memory_order_release);
}

void TraceRing::close() noexcept {
  closed_.store(true, std::memory_order_release);
}

}  // namespace lockstep
