/// How fast something may come nearer to where it has to stand.
/// Nothing here allocates or throws.
#pragma once

#include <cmath>

#include "tech_objects/arithmetic/nearest.hpp"

namespace lockstep {

namespace detail {
/// Apart from the other code: seldom needed, and where the processor has no instruction for it a call.
[[gnu::noinline, gnu::cold]] inline double floor(double value) noexcept {
  return std::floor(value);
}
}  // namespace detail

/// So fast that whole steps of braking behind this one end at the distance; velocities are distances per
/// step.
/// @param distance [u] ≥ 0  @param braking [u/step²] > 0
inline double braking_speed(double distance, double braking) noexcept {
  const double root = std::sqrt(0.25 + 2.0 * distance / braking);
  // ⌊root - 0.5⌋, which but on its edges is the nearest one less 1.
  double whole = nearest(root) - 1.0;
  const double rest = root - whole;
  if (!(rest >= 0.5 && rest < 1.5)) [[unlikely]]
    whole = detail::floor(root - 0.5);
  return whole < 1.0 ? distance : whole * braking;
}

}  // namespace lockstep
