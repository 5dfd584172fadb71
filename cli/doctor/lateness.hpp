/// How late a thread wakes that waits for the grid of a cycle.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "scheduler/waiting_clock.hpp"

namespace lockstep::cli {

/// What was measured. Threads: one adds; the counts may be read by any meanwhile, the quantiles behind it.
class Lateness {
 public:
  Lateness();

  /// @param late [ns]; before the time counts as in time
  void add(std::int64_t late) noexcept;

  std::uint64_t count() const noexcept { return count_.load(std::memory_order_relaxed); }
  std::int64_t worst() const noexcept { return worst_.load(std::memory_order_relaxed); }  ///< [ns]

  /// The lateness [ns] that so large a share of them does not exceed, rounded up to a whole microsecond, or
  /// the worst one; 0 if there are none.
  /// @param share 0 to 1
  std::int64_t quantile(double share) const;

 private:
  std::vector<std::uint64_t> buckets_;  // of a microsecond; the last one has all that is later
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> worst_{0};
};

/// Waits for each cycle of a grid, as the cycle of a run does, and notes how late that was. Cycles that have
/// passed meanwhile are left out. Nothing in it allocates.
/// @param cycle, duration [ns]; at least one cycle is waited for
void measure(WaitingClock& clock, std::int64_t cycle, std::int64_t duration, Lateness& into) noexcept;

}  // namespace lockstep::cli
