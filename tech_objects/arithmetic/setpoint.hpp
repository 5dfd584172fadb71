/// The state of motion of an axis at one interpolator tick, and what limits it.
#pragma once

#include "tech_objects/arithmetic/axis_position.hpp"

namespace lockstep {

/// Direction of a distance or a velocity: 1, -1, or 0 (also for NaN).
constexpr int sign(double value) noexcept {
  return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

/// Position, velocity and acceleration of one tick.
struct Setpoint {
  AxisPosition position;
  double velocity{};      ///< [u/s]
  double acceleration{};  ///< [u/s²]

  bool standing() const noexcept { return velocity == 0.0 && acceleration == 0.0; }
};

/// Dynamic values in effect: defaults filled in and limits applied.
struct Dynamics {
  double velocity{};      ///< [u/s] ≥ 0
  double acceleration{};  ///< [u/s²] > 0
  double deceleration{};  ///< [u/s²] > 0
  double jerk{};          ///< [u/s³] > 0; 0: trapezoidal

  bool operator==(const Dynamics&) const = default;
};

}  // namespace lockstep
