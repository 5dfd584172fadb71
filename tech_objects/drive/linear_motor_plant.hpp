/// What a linear motor moves: a mass that forces push, with dry friction, weight, a spring and stops.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A stop that gives way as a spring and takes energy as a damper; it pushes and never pulls.
struct DampedStop {
  double position = 0.0;   ///< [mm] where it is touched
  int side = 1;            ///< 1: met in the positive direction, -1: in the negative one
  double stiffness = 0.0;  ///< [N/m] > 0
  double damping = 0.0;    ///< [N s/m] ≥ 0
};

/// A spring that is always in force.
struct CentringSpring {
  double position = 0.0;   ///< [mm] where it is slack
  double stiffness = 0.0;  ///< [N/m] ≥ 0; 0: there is none
};

/// "Out of the motor" is positive.
struct LinearMotorPlantSettings {
  double slider_mass = 0.0;  ///< [kg] > 0
  double load_mass = 0.0;    ///< [kg] ≥ 0
  double friction = 0.0;     ///< [N] ≥ 0, dry, against every motion
  double inclination = 0.0;  ///< [°] -90 … 90; 90: out of the motor is straight upwards
  const LREAL* external_force =
      nullptr;  ///< [N] LREAL tag: pushes besides, within ±1e9; nullptr: nothing does
  CentringSpring spring{};
  std::vector<DampedStop> stops;
};

/// Mass, forces, places: what moves comes from the forces alone. Exact for a constant force; spring and stops
/// by the midpoint rule, which gives them no energy. A step is split where the motion turns or meets or
/// leaves a stop. Deterministic. The cycle's thread.
class LinearMotorPlant {
 public:
  static constexpr double kGravity = 9.81;  ///< [m/s²] as the source calculates

  /// At rest. May allocate. @param start [mm]
  void configure(const LinearMotorPlantSettings& settings, double start) noexcept;

  /// @param force of the motor, constant meanwhile [N]  @param duration [s] > 0
  void step(double force, double duration) noexcept {
    const double pushed = force + weight_ + external();
    if (!free_ || !glides(pushed, duration)) step_in_pieces(pushed, duration);
  }
  /// Whatever holds it has taken its motion.
  void stop() noexcept { velocity_ = 0.0; }

  double position() const noexcept { return position_; }  ///< [mm]
  double velocity() const noexcept { return velocity_; }  ///< [mm/s]
  /// [N s²/mm] of all that moves.
  double mass() const noexcept { return mass_; }
  /// [N mm] Of motion, spring, stops and weight, for whoever holds it against the forces.
  double energy() const noexcept;

 private:
  struct Stop {
    double position, side, stiffness, damping;  // [mm], ±1, [N/mm], [N s/mm]
  };
  /// What spring and stops do at present: stiffness · position - pull, and damping · velocity, against it.
  struct Elastic {
    double stiffness = 0.0;  // [N/mm]
    double pull = 0.0;       // [N]
    double damping = 0.0;    // [N s/mm]
  };
  /// [N] A tag that says more, or is no number, pushes with nothing.
  static constexpr double kMaximumForce = 1e9;
  double external() const noexcept {
    const double external = external_force_ != nullptr ? *external_force_ : 0.0;
    return std::abs(external) <= kMaximumForce ? external : 0.0;
  }
  /// Without spring and stops most steps are of one piece. @return false: it turns, and has not moved yet
  bool glides(double pushed, double duration) noexcept {
    if (velocity_ == 0.0 && std::abs(pushed) <= friction_) return true;  // it sticks
    const double against = std::copysign(friction_, velocity_ == 0.0 ? pushed : velocity_);
    const double acceleration = (pushed - against) / mass_;
    if (velocity_ * acceleration < 0.0 && -velocity_ / acceleration < duration) return false;
    const double after = velocity_ + acceleration * duration;
    position_ = position_ + 0.5 * (velocity_ + after) * duration;
    velocity_ = after;
    return true;
  }
  void step_in_pieces(double pushed, double duration) noexcept;
  bool pushes(const Stop& stop) const noexcept;
  Elastic elastic() const noexcept;
  double piece(double force, double duration, bool whole) noexcept;
  double fly(double acceleration, double duration, bool whole) noexcept;
  double swing(const Elastic& elastic, double force, double duration, bool whole) noexcept;
  const Stop* next_crossing(const Elastic& at, double pushed, double& duration) const noexcept;
  const Stop* next_stop(double acceleration, double& duration) const noexcept;

  double position_ = 0.0;
  double velocity_ = 0.0;
  double mass_ = 1.0;
  double friction_ = 0.0;
  double weight_ = 0.0;  // along the motion [N]
  bool free_ = true;     // of spring and stops
  const LREAL* external_force_ = nullptr;
  Stop spring_{};
  std::vector<Stop> stops_;
};

}  // namespace lockstep
