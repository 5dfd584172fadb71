/// Time-optimal motion profiles of one axis: from any state to a velocity, or to a position and a velocity.
/// Pure arithmetic: no allocation, no exceptions, the same bits on every machine of an architecture.
/// Every function may be called by any thread on objects of its own.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "tech_objects/arithmetic/setpoint.hpp"

namespace lockstep {

/// Where an axis is and how it moves.
struct MotionState {
  double position{};      ///< [u] any finite value
  double velocity{};      ///< [u/s] any finite value
  double acceleration{};  ///< [u/s²] any finite value
};

/// What a profile must not exceed. "Speeding up" is a growing, "slowing down" a falling amount of the
/// velocity.
struct ProfileLimits {
  double velocity_max{};  ///< [u/s] > 0: maximum velocity in the positive direction
  double velocity_min{};  ///< [u/s] < 0: maximum velocity in the negative direction
  double acceleration{};  ///< [u/s²] > 0: maximum amount while speeding up
  double deceleration{};  ///< [u/s²] > 0: maximum amount while slowing down
  double jerk{};          ///< [u/s³] > 0; 0: no limit, the acceleration steps (trapezoidal profile)
};

/// Limits that are alike in both directions. @param dynamics its velocity has to be above 0 for a plan
inline ProfileLimits limits_of(const Dynamics& dynamics) noexcept {
  return {.velocity_max = dynamics.velocity,
          .velocity_min = -dynamics.velocity,
          .acceleration = dynamics.acceleration,
          .deceleration = dynamics.deceleration,
          .jerk = dynamics.jerk};
}

/// What became of a request for a profile.
enum class PlanResult : std::uint8_t {
  ok,
  not_finite,        ///< a state or a target is NaN or infinite
  limits_invalid,    ///< a limit is not finite, or has the wrong sign, or is 0 where it must not be
  beyond_limits,     ///< the target velocity lies outside velocity_min … velocity_max
  not_representable  ///< a limit below 1e-100 or a value above 1e100, or a motion that leaves the range of
                     ///< double
};

/// A motion over time: phases of constant jerk, after which the end velocity goes on. Plain data, fixed size.
/// A default-constructed profile stands at position 0.
class Profile {
 public:
  /// One phase of constant jerk; it lasts until the next one begins or the profile ends.
  struct Phase {
    double begin{};       ///< [s] from the start of the profile
    MotionState state{};  ///< at `begin`
    double jerk{};        ///< [u/s³] 0 in all phases of a trapezoidal profile

    /// The state at a time of the profile within the phase [s].
    MotionState at(double t) const noexcept {
      const double dt = t - begin;
      const double half_jerk = jerk * 0.5;
      const double half_acceleration = state.acceleration * 0.5;
      return {
          state.position + dt * (state.velocity + dt * (half_acceleration + dt * half_jerk * (1.0 / 3.0))),
          state.velocity + dt * (state.acceleration + dt * half_jerk), state.acceleration + dt * jerk};
    }
  };

  /// Enough for every profile: the distance to a = 0, two changes of velocity with a limit that changes at
  /// standstill (6 phases each), and the constant velocity between them.
  static constexpr int kMaxPhases = 16;

  /// Time until the target state is reached [s], ≥ 0.
  double duration() const noexcept { return duration_; }

  /// The state at a time [s]. t ≤ 0 and NaN: exactly the start, even if the duration is 0; t ≥ duration:
  /// exactly the target, moving on with the end velocity.
  MotionState at(double t) const noexcept;

  /// The state the profile starts from.
  const MotionState& start() const noexcept { return start_; }

  /// The state at the duration; its acceleration is 0.
  const MotionState& target() const noexcept { return target_; }

  /// The phases in order; none if start and target coincide.
  std::span<const Phase> phases() const noexcept {
    return {phases_.data(), static_cast<std::size_t>(count_)};
  }

 private:
  friend class ProfileBuilder;

  MotionState start_{};
  MotionState target_{};
  double duration_{};
  int count_{};
  std::array<Phase, kMaxPhases> phases_{};
};

/// Plans the quickest motion that reaches a position with a velocity and without acceleration.
///
/// The acceleration keeps within the limit of its side; it is brought to the limit of the other side before
/// the velocity changes its sign, unless full jerk from the start on cannot do so. From a start inside the
/// limits the motion is time-optimal. A start beyond a velocity limit comes inside with full jerk and
/// deceleration, and meets the limit without falling short of it if it is to stay there; a motion that stayed
/// beyond the limit for longer might be quicker.
///
/// The phases meet the target but for rounding. A target that the quickest change of velocity misses by some
/// 1e-14 of positions and distance counts as met by it, so that a motion planned anew from its own setpoints
/// does not turn back; with an end velocity other than 0, planning anew in every cycle lets such errors add
/// up.
/// @param target_position [u] finite
/// @param target_velocity [u/s] velocity_min … velocity_max
/// @param out the profile; unchanged unless the result is ok
PlanResult plan_position(const MotionState& start, double target_position, double target_velocity,
                         const ProfileLimits& limits, Profile& out) noexcept;

/// Plans the quickest change to a velocity, without acceleration at its end; the position is what results.
/// @param target_velocity [u/s] velocity_min … velocity_max
/// @param out the profile; unchanged unless the result is ok
PlanResult plan_velocity(const MotionState& start, double target_velocity, const ProfileLimits& limits,
                         Profile& out) noexcept;

/// What a stop does with an acceleration that is present at its start.
enum class PresentAcceleration : std::uint8_t {
  keep,  ///< reduced with the jerk
  abort  ///< set to 0 at once if it speeds the axis up; the start of the profile is then without acceleration
};

/// Plans the quickest stop with deceleration and jerk.
/// @source S7-1500T axis functions, MC_Halt and MC_Stop, AbortAcceleration
/// @param out the profile; unchanged unless the result is ok
PlanResult plan_stop(const MotionState& start, const ProfileLimits& limits, PresentAcceleration present,
                     Profile& out) noexcept;

}  // namespace lockstep
