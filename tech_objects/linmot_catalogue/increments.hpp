/// The increments in which the protocols of a LinMot controller count, exact; of a linear motor.
/// @source LinMot release 1.3 addendum, 3.8, 8.7; what is printed there is their rounding
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lockstep::linmot {

inline constexpr double kPositionIncrement = 5.0 / 256.0;                      ///< [mm]
inline constexpr double kVelocityIncrement = 50000.0 / 262144.0 * 1e-3;        ///< [m/s]
inline constexpr double kAccelerationIncrement = kVelocityIncrement * 1250.0;  ///< [m/s²]
inline constexpr double kCurrentIncrement = 6.0 / 256.0;                       ///< [A]
inline constexpr double kProportionalIncrement = 2.34375e-3;                   ///< [A/mm]
inline constexpr double kIntegralIncrement = 45.7e-3;                          ///< [A/(mm s)]
inline constexpr double kDerivativeIncrement = 0.015;                          ///< [A/(m/s)]
inline constexpr double kFeedForwardIncrement = 0.1;                           ///< [mA/(m/s²)]
inline constexpr double kPercentIncrement = 100.0 / 4096.0;                    ///< [%]

inline constexpr std::int32_t kPositionReach = 32256;  ///< ± increments, ±630 mm
/// Where no position is valid.
inline constexpr std::int32_t kNoPosition = 32767;

/// Whole increments, half away from zero; within ±2³⁰.
inline std::int32_t increments(double value, double increment) noexcept {
  constexpr double kLargest = 1073741824.0;
  const double exact = value / increment;
  if (!(std::abs(exact) < kLargest)) return exact > 0.0 ? 1073741824 : -1073741824;
  return static_cast<std::int32_t>(exact < 0.0 ? -std::floor(0.5 - exact) : std::floor(exact + 0.5));
}
/// The value that as many whole increments have.
inline double in_whole_increments(double value, double increment) noexcept {
  return increments(value, increment) * increment;
}

}  // namespace lockstep::linmot
