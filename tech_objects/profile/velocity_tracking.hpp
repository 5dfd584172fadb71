/// Synchronizing without given positions: an axis runs up to the velocity and acceleration of a moving
/// target.
#pragma once

namespace lockstep {

/// Limits while synchronizing. Acceleration and deceleration are magnitudes > 0 of speeding up and slowing
/// down.
struct TrackingLimits {
  double velocity = 0.0;      ///< [u/s] > 0
  double acceleration = 0.0;  ///< [u/s²] > 0
  double deceleration = 0.0;  ///< [u/s²] > 0
  double jerk = 0.0;          ///< [u/s³] 0: trapezoidal velocity profile, the acceleration may step
};

/// Own motion, or that of the target: ratio times the leading values.
struct TrackingMotion {
  double velocity = 0.0;      ///< [u/s]
  double acceleration = 0.0;  ///< [u/s²]
};

/// The axis one tick on.
struct TrackingStep {
  double distance = 0.0;      ///< [u] covered in the tick, the exact integral of its velocity
  double velocity = 0.0;      ///< [u/s]
  double acceleration = 0.0;  ///< [u/s²]
  bool synchronous = false;   ///< velocity and acceleration are those of the target, to the last bit
};

/// One tick of `period` [s] towards the target, whose motion is that at the end of the tick.
///
/// Time-optimal in the frame that moves with the target's acceleration: for a target with constant velocity
/// or constant acceleration inside the limits synchronous after finite time and without overshoot; once
/// synchronous, so at every tick as long as the target's jerk stays inside `jerk`. The target's velocity is
/// cut to the velocity limit and its acceleration to the acceleration limits; then the axis is not
/// synchronous. Acceleration, deceleration, jerk and velocity limits hold for the axis; an axis that starts
/// outside of them comes back at once. Speeding up and slowing down are told by the axis' own velocity, also
/// across its reversal. All arguments finite, period > 0. Any thread.
/// @source S7-1500T synchronous operation V7, 6.2.2 (MC_GearIn: synchronous when velocity and acceleration
/// match)
TrackingStep track_velocity(TrackingMotion own, TrackingMotion target, const TrackingLimits& limits,
                            double period) noexcept;

}  // namespace lockstep
