/// What an axis asks of the next interpolator tick before it is stepped.
#pragma once

#include <atomic>
#include <utility>

namespace lockstep {

/// Raised with one flag for all axes: while nothing is raised, whoever steps many looks at none of them.
/// Thread: the cycle, and those that help with it, each for the axis that it steps.
class Attention {
 public:
  /// Load time. @param any raised with this one too
  void raise_with(std::atomic<bool>& any) noexcept { any_ = &any; }

  /// A job has been handed over.
  void job_is_new() noexcept { raise(); }
  /// A coupling has changed, so that the order of the axes is built anew.
  void coupling_has_changed() noexcept {
    coupling_changed_ = true;
    raise();
  }
  /// Whether a coupling has changed since this was asked last.
  bool take_coupling_change() noexcept { return std::exchange(coupling_changed_, false); }

 private:
  void raise() noexcept {
    if (any_ != nullptr) any_->store(true, std::memory_order_relaxed);
  }

  std::atomic<bool>* any_ = nullptr;  // none: nobody steps several
  bool coupling_changed_ = false;
};

}  // namespace lockstep
