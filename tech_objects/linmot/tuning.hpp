/// The currents that a motion takes, as the tuning tool calculates them.
/// @source LinMot release 1.3 addendum, 7.5 to 7.7
#pragma once

#include <cmath>

namespace lockstep::linmot {

/// Of all motors that move one load together.
struct TuningInput {
  double force_constant = 40.0;  ///< [N/A] > 0
  double slider_mass = 0.0;      ///< [kg] of each motor
  double load_mass = 0.0;        ///< [kg] of all
  int motors = 1;                ///< in parallel
  double friction = 0.0;         ///< [N] of each motor
  double inclination = 0.0;      ///< [°] 90: out of the motor is straight upwards
  double external_force = 0.0;   ///< [N] on each motor, out of it
};

/// For each motor.
struct TuningResult {
  double mass;             ///< [kg]
  double ff_friction;      ///< [A]
  double ff_acceleration;  ///< [mA/(m/s²)], and FF Deceleration
  double current_offset;   ///< [A]
};

inline TuningResult tune(const TuningInput& input) noexcept {
  constexpr double kGravity = 9.81;  // [m/s²] as the source calculates
  constexpr double kDegree = 3.14159265358979323846 / 180.0, kMilliamperes = 1e3;
  const double mass = input.slider_mass + input.load_mass / input.motors;
  const double weight = mass * kGravity * std::sin(input.inclination * kDegree);
  return {mass, input.friction / input.force_constant, kMilliamperes * mass / input.force_constant,
          (weight - input.external_force) / input.force_constant};
}

}  // namespace lockstep::linmot
