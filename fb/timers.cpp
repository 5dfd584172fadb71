#include "fb/timers.hpp"

#include <algorithm>

namespace lockstep {
namespace {

std::int64_t preset_of(TIME pin) noexcept {
  return std::max(static_cast<std::int64_t>(pin), std::int64_t{0});
}

}  // namespace

void TON::call(std::int64_t now) noexcept {
  if (IN && !memory_) {
    start_ = now;
    preset_ = preset_of(PT);
  }
  memory_ = IN;
  const std::int64_t elapsed = IN ? std::min(now - start_, preset_) : 0;
  ET = TIME{elapsed};
  Q = IN && elapsed >= preset_;
}

void TOF::call(std::int64_t now) noexcept {
  if (IN) {
    running_ = false;
    Q = true;
    ET = TIME{0};
  } else if (memory_) {
    running_ = true;
    start_ = now;
    preset_ = preset_of(PT);
  }
  memory_ = IN;
  if (!running_) return;
  const std::int64_t elapsed = std::min(now - start_, preset_);
  ET = TIME{elapsed};
  running_ = elapsed < preset_;
  Q = running_;
}

void TP::call(std::int64_t now) noexcept {
  if (running_ && now - start_ >= preset_) {
    running_ = false;
    ET = TIME{preset_};
  }
  if (IN && !memory_ && !running_) {
    start_ = now;
    preset_ = preset_of(PT);
    running_ = preset_ > 0;
    ET = TIME{0};
  }
  memory_ = IN;
  if (running_)
    ET = TIME{now - start_};
  else if (!IN)
    ET = TIME{0};
  Q = running_;
}

}  // namespace lockstep
