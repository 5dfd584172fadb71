/// The clock that a run in real time waits for.
#pragma once

#include <cstdint>

namespace lockstep {

/// Thread: the cycle's. Nothing here locks or allocates.
class WaitingClock {
 public:
  virtual ~WaitingClock() = default;

  /// [ns] from an origin of its own; never goes back.
  virtual std::int64_t now() noexcept = 0;
  /// Returns at this time or, as late as the system is, after it; at once if it has passed.
  virtual void sleep_until(std::int64_t time) noexcept = 0;
};

/// The clock of the system, which nobody sets.
WaitingClock& monotonic_clock() noexcept;

}  // namespace lockstep
