/// What the tap costs the tick, from what the cycle counts anyway.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "projects/studio/api.hpp"

namespace lockstep {

/// Compares how long ticks take on average while signals are recorded with how long they took when last none
/// was. No clock is read for it: the thread of the cycle reads one before and after each tick anyway, and
/// counts. The difference is what the tap costs, as far as the machine did the same then as now.
class TapCost {
 public:
  /// Takes the counts at a look. What lies between two looks counts if the same number of signals was
  /// recorded at both.
  /// @param busy of all ticks together [µs] @param signals that are recorded now
  void add(std::uint64_t ticks, double busy, std::size_t signals);
  /// `tick_us`, the mean of the ticks between the last two looks, and `tick_without_us`, the same when last
  /// no signal was recorded; null: not known.
  studio_api::Json told() const;

 private:
  struct Look {
    std::uint64_t ticks = 0;
    double busy = 0.0;
    std::size_t signals = 0;
  };

  std::optional<Look> before_;
  std::optional<double> tick_, without_;  // [µs]
};

}  // namespace lockstep
