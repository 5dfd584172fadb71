/// Whether an object stands, as its standstill signal tells.
/// @source S7-1500T synchronous operation V7, 13.1 (StandstillSignal)
#pragma once

#include <cmath>
#include <cstdint>

#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// Looks at the actual velocity of each interpolator tick. Thread: the cycle.
class Standstill {
 public:
  /// @param velocity actual velocity [u/s]  @param period of the interpolator [s]
  /// @return whether it has kept within the window for the dwell time
  bool watch(double velocity, const TO_Struct_StandstillSignal& signal, double period) noexcept {
    const double threshold = stands_ ? signal.VelocityThreshold * kHysteresis : signal.VelocityThreshold;
    if (!(std::abs(velocity) <= threshold)) {
      ticks_ = 0;
      return stands_ = false;
    }
    const double dwelt = static_cast<double>(ticks_++) * period;
    return stands_ = dwelt >= signal.MinDwellTime - 1e-9 * period;
  }
  bool stands() const noexcept { return stands_; }

 private:
  /// How far the velocity has to rise above the threshold to end a standstill: without it the signal would
  /// flicker while an axis trembles at the threshold.
  static constexpr double kHysteresis = 1.05;

  std::int64_t ticks_ = 0;  // within the window
  bool stands_ = false;
};

}  // namespace lockstep
