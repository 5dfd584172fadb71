/// What an axis that pursues a target keeps to.
#pragma once

#include <cstdint>

namespace lockstep {

struct PursuitLimits {
  double velocity = 0.0;      ///< [u/step] ≥ 0
  double acceleration = 1.0;  ///< [u/step²] > 0, of what becomes faster in either direction
  double deceleration = 1.0;  ///< [u/step²] > 0, of what becomes slower
  /// Part of the target's velocity by which the own one may differ while the target is being met, 0 … 1;
  /// below 0: as it likes.
  double band = -1.0;
  /// By how much the target is faster than what the band lies about: of a correction that is spread [u/step].
  double spread = 0.0;
  /// Whether the velocity may be negative: always, while the target's is, never.
  enum class Reversal : std::uint8_t { free, with_target, never } reversal = Reversal::free;
  /// By how much the velocity of a target that is counted is uncertain: one count in a step [u/step] ≥ 0.
  /// Once it is on such a target it takes each count as it comes, as long as the velocity stays within so
  /// much of one that keeps the limits.
  double uncertainty = 0.0;

  /// Whether the velocity must not be negative. What spreads a correction is no motion of the target.
  bool only_forward(double target_velocity) const noexcept {
    constexpr double kRests = -1e-9;  // [u/step]
    return reversal == Reversal::never ||
           (reversal == Reversal::with_target && target_velocity - spread >= kRests);
  }
};

}  // namespace lockstep
