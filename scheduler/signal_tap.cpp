#include "scheduler/signal_tap.hpp"

#include <utility>

namespace lockstep {

std::uint64_t SignalTap::hand_over(std::unique_ptr<TraceRing> ring) {
  if (!is_taken() || before_) return 0;
  before_ = std::exchange(current_, std::move(ring));
  handed_over_ = current_.get();
  ++last_number_;
  wanted_.store(last_number_, std::memory_order_release);
  return last_number_;
}

void SignalTap::give_back() noexcept {
  dropped_before_ += before_->dropped();
  before_.reset();
}

std::uint64_t SignalTap::dropped() const noexcept {
  return dropped_before_ + (before_ ? before_->dropped() : 0) + (current_ ? current_->dropped() : 0);
}

void SignalTap::close() noexcept {
  if (before_) before_->close();
  if (current_) current_->close();
}

}  // namespace lockstep
