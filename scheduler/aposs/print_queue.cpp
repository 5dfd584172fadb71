#include "scheduler/aposs/print_queue.hpp"

#include <bit>

namespace lockstep::aposs {

PrintQueue::PrintQueue(std::size_t capacity)
    : ring_(std::bit_ceil(capacity < 2 ? std::size_t{2} : capacity)), mask_(ring_.size() - 1) {}

void PrintQueue::push(Printed item) noexcept {
  if (dropping_) return;
  if (written_ - taken_.load(std::memory_order_acquire) == ring_.size()) {
    dropping_ = true;
    return;
  }
  ring_[written_++ & mask_] = item;
}

void PrintQueue::end_line() noexcept {
  push({Printed::Kind::kEndOfLine, 0});
  if (dropping_) {
    written_ = given_.load(std::memory_order_relaxed);
    dropping_ = false;
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  given_.store(written_, std::memory_order_release);
  ++lines_;
}

void PrintQueue::flush() noexcept {
  if (dropping_ || written_ != given_.load(std::memory_order_relaxed)) end_line();
}

bool PrintQueue::take(Printed& item) noexcept {
  const std::size_t at = taken_.load(std::memory_order_relaxed);
  if (at == given_.load(std::memory_order_acquire)) return false;
  item = ring_[at & mask_];
  taken_.store(at + 1, std::memory_order_release);
  return true;
}

}  // namespace lockstep::aposs
