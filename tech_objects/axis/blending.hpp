/// How a job that waits takes over in motion, with the velocity that its mode asks for.
/// @source PLCopen Motion Control Part 1 v2.0, 2.4.2 (MC_BUFFER_MODE)
#pragma once

#include "tech_objects/jobs/job.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"

namespace lockstep {

/// What the next motion is like, seen from the target of the running one.
struct NextMotion {
  double distance = 0.0;  // its direction if it is endless [u]
  bool endless = false;   // whether it has no target that it must not pass
  Dynamics dynamics;
};

/// Plans the running positioning so that it passes its target with the velocity of both: the one that the
/// mode asks for, or the highest one that needs no turning back, neither here nor by the next motion. Thread:
/// the cycle.
class Blending {
 public:
  /// @param period of the interpolator [s]
  void configure(double period) noexcept { period_ = period; }

  /// Nothing waits any more, or what waits has only begun to.
  void release() noexcept { junction_velocity_ = 0.0; }

  /// @param motion the running positioning, which is planned anew from `now`
  /// @return whether its target is passed in motion
  bool plan(SingleAxisMotion& motion, const Setpoint& now, const NextMotion& next, BufferMode mode,
            double velocity_limit, const Modulo& modulo) noexcept;

  /// Whether in the next cycle it would be too late to reach the velocity of the junction: where the next
  /// motion is faster and its velocity is asked for, the running one keeps its own as long as it can.
  bool due_to_speed_up(const SingleAxisMotion& motion, const Setpoint& now,
                       const Modulo& modulo) const noexcept;
  /// Then it speeds up, and just reaches the other at its target.
  void speed_up(SingleAxisMotion& motion, const Setpoint& now, const NextMotion& next,
                const Modulo& modulo) noexcept;

 private:
  double highest_velocity(const SingleAxisMotion& motion, const Setpoint& now, double distance, double wanted,
                          const NextMotion& next, const Dynamics& dynamics) const noexcept;
  bool can_take_over(const NextMotion& next, double velocity) const noexcept;
  bool reachable_later(const Setpoint& now, double distance, const Dynamics& dynamics) const noexcept;

  double period_ = 0.001;           // [s]
  double junction_velocity_ = 0.0;  // for which the running motion has yet to speed up [u/s]; 0: none
};

}  // namespace lockstep
