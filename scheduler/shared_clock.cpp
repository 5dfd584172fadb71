#include "scheduler/shared_clock.hpp"

#include <sys/timex.h>
#include <time.h>

#include <cstdlib>

namespace lockstep {
namespace {

constexpr std::int64_t kPerSecond = 1'000'000'000;  // [ns]
constexpr int kReadings = 5;                        // of which the one counts that took the shortest time

std::int64_t time_of(clockid_t id) noexcept {
  timespec time{};
  clock_gettime(id, &time);
  return std::int64_t{time.tv_sec} * kPerSecond + time.tv_nsec;
}

class OwnMachine final : public SharedClock {
 public:
  SharedClockReading read() noexcept override { return {}; }
};

class AcrossMachines final : public SharedClock {
 public:
  explicit AcrossMachines(std::int64_t largest_error) : largest_error_(largest_error) {}

  SharedClockReading read() noexcept override {
    SharedClockReading reading{.offset = 0, .locked = locked()};
    std::int64_t shortest = INT64_MAX;
    for (int i = 0; i < kReadings; ++i) {
      const std::int64_t before = time_of(CLOCK_MONOTONIC);
      const std::int64_t shared = time_of(CLOCK_TAI);
      const std::int64_t took = time_of(CLOCK_MONOTONIC) - before;
      if (took >= shortest) continue;
      shortest = took;
      reading.offset = shared - (before + took / 2);
    }
    return reading;
  }

 private:
  bool locked() const noexcept {
    timex state{};
    const int clock = adjtimex(&state);
    return clock >= 0 && clock != TIME_ERROR && (state.status & STA_UNSYNC) == 0 &&
           std::int64_t{state.maxerror} * 1000 <= largest_error_;
  }

  const std::int64_t largest_error_;  // [ns]
};

}  // namespace

std::unique_ptr<SharedClock> make_shared_clock(SharedClockKind kind, std::int64_t largest_error) {
  if (kind == SharedClockKind::monotonic) return std::make_unique<OwnMachine>();
  return std::make_unique<AcrossMachines>(largest_error);
}

ClockWatch::ClockWatch(SharedClock& clock) noexcept : clock_(clock) {
  const SharedClockReading reading = clock.read();
  offset_ = candidate_ = reading.offset;
  trusted_ = reading.locked;
  settling_ = INT64_MIN;
}

void ClockWatch::look(std::int64_t now) noexcept {
  if (looked_ != INT64_MIN && now - looked_ < kBetween) return;
  looked_ = now;
  const SharedClockReading reading = clock_.read();
  if (trusted()) {
    if (!reading.locked || std::abs(reading.offset - offset()) > kJump) {
      losses_.fetch_add(1, std::memory_order_relaxed);
      lose(now, reading.offset);
    } else {
      offset_.store(reading.offset, std::memory_order_relaxed);
    }
    return;
  }
  if (settling_ == INT64_MIN || !reading.locked || std::abs(reading.offset - candidate_) > kJump)
    return lose(now, reading.offset);
  candidate_ = reading.offset;
  if (now - settling_ < kSettled) return;
  offset_.store(candidate_, std::memory_order_relaxed);
  trusted_.store(true, std::memory_order_relaxed);
}

/// It does not count; from here on it has to go on evenly.
void ClockWatch::lose(std::int64_t now, std::int64_t offset) noexcept {
  trusted_.store(false, std::memory_order_relaxed);
  settling_ = now;
  candidate_ = offset;
}

}  // namespace lockstep
