/// The part of an axis' motion that MC_MoveSuperimposed, MC_MotionInSuperimposed and MC_HaltSuperimposed add
/// to its base motion.
/// @source S7-1500T synchronous operation V7, 4.5; S7-1500T axis functions, superimposed motion
#pragma once

#include <algorithm>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"

namespace lockstep {

/// A distance on top of the base motion, with a velocity and an acceleration of its own. The sum of many
/// distances carries its rounding error along. Every function that begins a motion goes on from the present
/// velocity and acceleration. Thread: the cycle.
class Superimposed {
 public:
  /// @param period interpolator cycle [s]
  void configure(double period) noexcept { motion_.configure({}, period); }

  /// Whether there is a superimposed part, moving or at rest.
  bool in_use() const noexcept { return in_use_; }
  /// At rest at zero, and in use from now on.
  void begin() noexcept;
  /// Not in use any more: the part has become one of the base motion.
  void reset() noexcept;

  /// By a distance from here [u]. At rest, dynamic values of 0 leave no margin: the motion waits until
  /// `make_room` tells of others. In motion only the velocity may be 0: it comes to rest and waits.
  PlanResult move_by(double distance, const Dynamics& margin) noexcept;
  /// Other dynamic values for the distance under way; a motion goes on braking with those that it has.
  PlanResult make_room(const Dynamics& margin) noexcept;
  /// To rest.
  PlanResult stop(const Dynamics& dynamics, bool abort_acceleration) noexcept;
  /// Values as given, without a profile; `distance` counts from where the part is at `begin_giving` [u].
  void begin_giving() noexcept;
  void give(double distance, double velocity, double acceleration) noexcept;
  /// Cuts an acceleration that was given, so that a profile can run it down [u/s²].
  void cut_acceleration(double maximum) noexcept {
    local_.acceleration = std::clamp(local_.acceleration, -maximum, maximum);
  }
  /// At rest where it is, at once.
  void rest() noexcept;

  /// One tick.
  void advance() noexcept;

  bool finished() const noexcept { return !waits_ && !given_ && motion_.finished(); }
  bool resting() const noexcept { return local_.standing(); }
  /// Dynamic values that the motion under way may use.
  const Dynamics& dynamics() const noexcept { return margin_; }
  /// What that motion may yet use of the limits, with what it still runs down.
  Dynamics demand() const noexcept { return motion_.demand(local_); }
  /// Whether it moves by a profile.
  bool planned() const noexcept { return !given_ && !waits_ && !motion_.finished(); }
  /// The distance that it still makes in a direction, 1 or -1 [u] ≥ 0.
  double distance_left(int direction) const noexcept;
  /// 1 or -1: the motion by a distance, or the one that waits, makes all that is left of it in this
  /// direction; 0: it turns back, is over, or nobody knows.
  int direction() const noexcept;

  DoubleDouble value() const noexcept { return anchor_ + local_.position.value; }  ///< [u]
  double velocity() const noexcept { return local_.velocity; }                     ///< [u/s]
  double acceleration() const noexcept { return local_.acceleration; }             ///< [u/s²]

 private:
  void settle() noexcept;

  DoubleDouble anchor_;
  Setpoint local_;         // from the anchor on
  double distance_ = 0.0;  // that waits [u]
  Dynamics margin_;
  SingleAxisMotion motion_;
  bool waits_ = false;   // for a margin, at rest
  bool given_ = false;   // the values are given in every cycle
  bool in_use_ = false;  // last, beside what an axis touches in every cycle
};

}  // namespace lockstep
