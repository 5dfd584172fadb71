/// Position and velocity between two interpolator ticks.
#pragma once

namespace lockstep {

/// A place on a cubic through position and velocity of two interpolator ticks.
struct FineSetpoint {
  double way = 0.0;       // from the earlier tick [u]
  double velocity = 0.0;  // [u/s]
};

/// @param way between the ticks [u]  @param from_velocity, to_velocity at them [u/s]  @param period of the
/// interpolator [s] > 0  @param u part of the interpolator cycle, 0 to 1. Any thread.
inline FineSetpoint fine_setpoint(double way, double from_velocity, double to_velocity, double period,
                                  double u) noexcept {
  const double a = from_velocity * period;
  const double b = to_velocity * period;
  const double cubic = a + b - 2.0 * way;
  const double square = 3.0 * way - 2.0 * a - b;
  return {((cubic * u + square) * u + a) * u, ((3.0 * cubic * u + 2.0 * square) * u + a) / period};
}

}  // namespace lockstep
