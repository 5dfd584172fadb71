/// Motion of one axis along a profile: positioning, endless motion and stopping, retargeted on the fly.
#pragma once

#include <limits>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/profile/walk.hpp"

namespace lockstep {

/// Generates setpoints along a time-optimal profile. Every function that begins a motion starts from the
/// setpoint at hand, so that velocity (and acceleration, if jerk-limited) goes on without a step. Thread: the
/// cycle.
class SingleAxisMotion {
 public:
  enum class Aim : std::uint8_t { stand, position, velocity };

  /// @param period interpolator cycle [s]
  void configure(const Modulo& modulo, double period) noexcept;

  /// Stands where the setpoint is.
  void stand(const Setpoint& from) noexcept;
  /// To a position `distance` away [u], which is `target`; comes to rest exactly there, or passes it with an
  /// end velocity [u/s] within ±dynamics.velocity.
  PlanResult move_to(const Setpoint& from, AxisPosition target, double distance, const Dynamics& dynamics,
                     double end_velocity = 0.0) noexcept;
  /// Whether such a motion with an end velocity other than 0 never turns back. Changes nothing.
  bool passes_ahead(const Setpoint& from, double distance, double end_velocity,
                    const Dynamics& dynamics) const noexcept;
  /// To a velocity [u/s] within ±dynamics.velocity, which is then held.
  PlanResult run_at(const Setpoint& from, double velocity, const Dynamics& dynamics) noexcept;
  /// To rest, as quickly as deceleration and jerk permit.
  PlanResult stop(const Setpoint& from, const Dynamics& dynamics, bool abort_acceleration) noexcept;

  /// Plans anew for the same aim (to rest, if it is a position) with other dynamics; a target velocity beyond
  /// the new one is cut to it.
  PlanResult replan(const Setpoint& from, const Dynamics& dynamics) noexcept;

  /// The setpoint one interpolator cycle later.
  void advance(Setpoint& setpoint) noexcept {
    const double t = static_cast<double>(ticks_ + 1) * period_;
    if (stands() || !walk_.before_end(t * kSameTime)) return advance_otherwise(setpoint);
    ++ticks_;
    go_on(walk_.here(t), setpoint);
  }

  /// Shifts the whole motion, for homing [u].
  void shift(double distance) noexcept;

  /// The distance that the motion still makes in a direction, 1 or -1 [u] ≥ 0; infinite if it goes on for
  /// ever.
  double distance_left(int direction) const noexcept;

  Aim aim() const noexcept { return aim_; }
  /// Whether the aim is reached: at rest at the target, or at the velocity.
  bool finished() const noexcept { return finished_; }
  /// Whether it stands, and goes on to.
  bool stands() const noexcept { return aim_ == Aim::stand && finished_; }
  AxisPosition target() const noexcept { return target_; }
  double target_velocity() const noexcept { return target_velocity_; }
  const Dynamics& dynamics() const noexcept { return dynamics_; }
  /// What the motion may yet use of the limits, from a setpoint of it on: its dynamic values, or what it has
  /// taken over beyond them and still runs down. Acceleration and deceleration are the greater of both.
  Dynamics demand(const Setpoint& now) const noexcept;
  /// Of the velocity in a direction, 1 or -1 [u/s] ≥ 0.
  double fastest(const Setpoint& now, int direction) const noexcept;

 private:
  /// A tick that misses the end of a profile by rounding is at it: what is left there is no motion, but would
  /// show as one.
  static constexpr double kSameTime = 1.0 + 16.0 * std::numeric_limits<double>::epsilon();

  void begin(const Setpoint& from, Aim aim, const Dynamics& dynamics) noexcept;
  void advance_otherwise(Setpoint& setpoint) noexcept;
  /// To a state of the profile.
  void go_on(const MotionState& state, Setpoint& setpoint) noexcept {
    setpoint.velocity = state.velocity;
    setpoint.acceleration = state.acceleration;
    setpoint.position = origin_.after(state.position, modulo_);
  }

  // What every cycle touches comes first.
  Modulo modulo_;
  double period_ = 0.001;
  std::int64_t ticks_ = 0;  // since the profile began
  Aim aim_ = Aim::stand;
  bool finished_ = true;
  bool exact_target_ = false;  // whether `target_` was given; else it is where the stop ends
  double target_velocity_ = 0.0;
  DistanceOrigin origin_;  // where the profile's position is 0
  AxisPosition target_;
  double wanted_velocity_ = 0.0;  // before the limit
  ProfileWalk walk_;              // along the profile
  Profile profile_;
  Dynamics dynamics_;
};

}  // namespace lockstep
