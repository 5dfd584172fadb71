/// The distance that an axis still moves when it stops.
#pragma once

#include <algorithm>

#include "tech_objects/arithmetic/setpoint.hpp"

namespace lockstep {

/// A state of motion as seen in one direction: what goes in it counts positive.
struct Heading {
  double velocity;      // [u/s]
  double acceleration;  // [u/s²]

  /// @param side 1 or -1
  Heading(const Setpoint& setpoint, int side) noexcept
      : velocity{side * setpoint.velocity}, acceleration{side * setpoint.acceleration} {}

  /// The velocity from which the axis brakes, once its acceleration is run down.
  double velocity_reached(double jerk) const noexcept {
    const double a = std::max(acceleration, 0.0);
    return velocity + (jerk > 0.0 ? a * a / (2.0 * jerk) : 0.0);
  }

  /// Whether the axis brakes so hard that it turns back before the deceleration can be run down.
  bool turning_back(double jerk) const noexcept {
    const double a = acceleration;
    return velocity > 0.0 && a < 0.0 && jerk > 0.0 && a * a >= 2.0 * jerk * velocity;
  }

  /// Whether it does so within a distance [u].
  bool turning_back_within(double distance, double jerk) const noexcept {
    return turning_back(jerk) && velocity * velocity <= -2.0 * acceleration * distance;
  }
};

/// A distance that a stop with these dynamic values does not exceed, from few operations: the present
/// acceleration is run down, then the velocity; the time of the latter is at most v/d + d/j.
inline double maximum_stopping_distance(const Heading& from, const Dynamics& dynamics) noexcept {
  const double a = std::max(from.acceleration, 0.0);
  if (dynamics.jerk <= 0.0) {
    const double v = std::max(from.velocity, 0.0);
    return v * v / (2.0 * dynamics.deceleration);
  }
  const double run_down = a / dynamics.jerk;
  const double v = from.velocity + 0.5 * a * run_down;
  if (v <= 0.0) return 0.0;
  return v * (run_down + 0.5 * (v / dynamics.deceleration + dynamics.deceleration / dynamics.jerk));
}

/// The distance that the axis still makes in a direction if it stops at once [u] ≥ 0; infinite if no stop can
/// be planned.
double stopping_distance(const Heading& from, const Dynamics& dynamics) noexcept;

/// A stop from a velocity in its own direction: where it ends [u], with the acceleration at hand. False if no
/// stop can be planned. @param velocity [u/s] ≥ 0
bool find_stop(double velocity, double acceleration, const Dynamics& dynamics, double& distance) noexcept;

/// Dynamic values with which the axis comes to rest within a distance: those given, or else the highest, or
/// else these without jerk limit. False: it cannot be done; the last of them are left.
bool find_braking(const Heading& from, double distance, const Dynamics& highest, Dynamics& dynamics) noexcept;

}  // namespace lockstep
