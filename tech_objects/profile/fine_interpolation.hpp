/// Position and velocity between two interpolator ticks.
#pragma once

namespace lockstep {

/// A place on a cubic through position and velocity of two interpolator ticks.
struct FineSetpoint {
  double distance = 0.0;  // from the earlier tick [u]
  double velocity = 0.0;  // [u/s]
};

/// @param distance between the ticks [u]  @param from_velocity, to_velocity at them [u/s]  @param period of
/// the interpolator [s] > 0  @param u part of the interpolator cycle, 0 to 1. Any thread.
inline FineSetpoint fine_setpoint(double distance, double from_velocity, double to_velocity, double period,
                                  double u) noexcept {
  const double a = from_velocity * period;
  const double b = to_velocity * period;
  const double cubic = a + b - 2.0 * distance;
  const double square = 3.0 * distance - 2.0 * a - b;
  return {((cubic * u + square) * u + a) * u, ((3.0 * cubic * u + 2.0 * square) * u + a) / period};
}

}  // namespace lockstep
