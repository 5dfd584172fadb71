#include "scheduler/waiting_clock.hpp"

#include <time.h>

#include <cerrno>

namespace lockstep {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;  // [ns]

class MonotonicClock final : public WaitingClock {
 public:
  std::int64_t now() noexcept override {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t{time.tv_sec} * kSecond + time.tv_nsec;
  }
  void sleep_until(std::int64_t due) noexcept override {
    const timespec time{static_cast<time_t>(due / kSecond), static_cast<long>(due % kSecond)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
    }
  }
};

}  // namespace

WaitingClock& monotonic_clock() noexcept {
  static MonotonicClock clock;
  return clock;
}

}  // namespace lockstep
