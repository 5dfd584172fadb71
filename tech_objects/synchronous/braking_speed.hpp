/// How fast something may come nearer to where it has to stand.
/// Nothing here allocates or throws.
#pragma once

#include <cmath>
#include <cstdint>

namespace lockstep {

/// So fast that whole steps of braking behind this one end at the distance; velocities are distances per
/// step.
/// @param distance [u] ≥ 0  @param braking [u/step²] > 0
inline double braking_speed(double distance, double braking) noexcept {
  constexpr double kWhole = 4503599627370496.0;  // 2⁵²: from here on there is nothing behind the point
  const double steps = std::sqrt(0.25 + 2.0 * distance / braking) - 0.5;
  // The floor, which is never negative, without the call that it takes where the processor has no instruction
  // for it.
  const double whole = steps < kWhole ? static_cast<double>(static_cast<std::int64_t>(steps)) : steps;
  return whole < 1.0 ? distance : whole * braking;
}

}  // namespace lockstep
