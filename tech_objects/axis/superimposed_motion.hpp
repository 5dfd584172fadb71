/// What is added to the base motion of an axis, and how the two share the dynamic limits.
/// @source S7-1500T synchronous operation V7, 4.5; S7-1500T axis functions, superimposed motion
#pragma once

#include "tech_objects/axis/motion_limits.hpp"
#include "tech_objects/profile/superimposed.hpp"

namespace lockstep {

/// The base motion as the superimposed one sees it.
struct BaseMotion {
  const SingleAxisMotion& motion;
  const Job* job;    // whose motion it is; nullptr: of none
  bool single_axis;  // it moves by `motion`
  bool led;          // by another object
};

/// The superimposed part, the base motion's setpoint beside it, and the share of the limits that each has. On
/// a single-axis motion the sum keeps within the limits, and the base motion comes first. Thread: the cycle.
class SuperimposedMotion {
 public:
  /// What it uses of the limits from a setpoint on, if it moves by a profile.
  struct Demand {
    bool planned = false;
    Dynamics dynamics;
  };

  /// @param period of the interpolator [s]
  void configure(double period) noexcept { part_.configure(period); }

  bool in_use() const noexcept { return part_.in_use(); }
  bool resting() const noexcept { return part_.resting(); }
  bool finished() const noexcept { return part_.finished(); }
  DoubleDouble value() const noexcept { return part_.value(); }  ///< [u]
  /// The distance that it still makes in a direction, 1 or -1 [u] ≥ 0.
  double distance_left(int side) const noexcept { return part_.distance_left(side); }
  /// What it adds to the velocity in a direction, now or when its acceleration is run down [u/s] ≥ 0.
  double maximum_velocity(double direction) const noexcept;

  // ---- Beginning and ending

  /// What a job asks for, before override and limits.
  void want(const Dynamics& wanted) noexcept { wanted_ = wanted; }
  /// A job begins beside a base motion. @param acceleration that it can run down at most [u/s²]
  void begin(const Setpoint& base, double acceleration) noexcept;
  /// The motion of MC_MoveSuperimposed or MC_HaltSuperimposed. `limits` are told where the base motion has to
  /// be planned anew.
  PlanResult begin_motion(const Job& job, const BaseMotion& base, MotionLimits& limits) noexcept;
  /// Values are given from now on, without a profile.
  void begin_giving() noexcept { part_.begin_giving(); }
  void give(double distance, double velocity, double acceleration) noexcept {
    part_.give(distance, velocity, acceleration);
  }
  /// Values that were given come to an end: it brakes with all that there is.
  void brake(const BaseMotion& base, MotionLimits& limits) noexcept;
  /// To rest with these dynamic values, or at once if that cannot be planned.
  void stop(const Dynamics& dynamics, bool abort_acceleration) noexcept;
  /// At rest where it is, at once.
  void rest() noexcept { part_.rest(); }
  /// It has become a part of the base motion.
  void reset() noexcept;

  // ---- Beside the base motion

  /// The base motion's setpoint while there is a superimposed part.
  const Setpoint& base() const noexcept { return base_; }
  /// A setpoint without what is superimposed on it.
  const Setpoint& base_of(const Setpoint& setpoint) const noexcept { return in_use() ? base_ : setpoint; }
  void shift_base(double by, const Modulo& modulo) noexcept {
    base_.position = advanced(base_.position, by, modulo);
  }
  /// Whether, within a step, the setpoint at hand is that of the base motion alone.
  bool advancing_base() const noexcept { return advancing_base_; }
  const Setpoint& begin_base() noexcept {
    advancing_base_ = true;
    return base_;
  }
  void leave_base() noexcept { advancing_base_ = false; }
  /// The last steps of function → + offset → + superimposed → setpoint.
  Setpoint add_to(const Setpoint& base, const Modulo& modulo) noexcept {
    base_ = base;
    advancing_base_ = false;
    return with(base, modulo);
  }
  Setpoint with(const Setpoint& base, const Modulo& modulo) const noexcept {
    return {advanced(base.position, part_.value(), modulo), base.velocity + part_.velocity(),
            base.acceleration + part_.acceleration()};
  }

  // ---- One cycle

  void advance() noexcept { part_.advance(); }
  /// What is wanted, cut to the limits of acceleration as they are now.
  Dynamics wanted_within(const TO_Struct_DynamicLimits& limits) const noexcept;
  /// Override, limits and the base motion count at once.
  PlanResult follow_share(const BaseMotion& base, const MotionLimits& limits) noexcept;

  Demand demand() const noexcept;
  /// Beside a base motion counts what it uses from the last setpoint on, also in the tick in which it ends,
  /// and what it does once it has been advanced. @return whether the base motion may have more again
  bool take_demand(const Demand& before) noexcept;
  /// A base motion that is planned anew from `now` keeps to what is left, within a step. What the
  /// superimposed motion only runs down yet it is given back later.
  void curb(Dynamics& dynamics, const Setpoint& now, const BaseMotion& base, const Job* job,
            const MotionLimits& limits) noexcept;
  /// It is over. @return whether the base motion may have all again
  bool give_back() noexcept;

 private:
  Dynamics share(const BaseMotion& base, const MotionLimits& limits) const noexcept;
  Dynamics left_by(const BaseMotion& base, const MotionLimits& limits) const noexcept;
  double velocity_left_by(const BaseMotion& base, double velocity_limit, int side) const noexcept;
  Dynamics first_share(const BaseMotion& base, MotionLimits& limits) noexcept;
  Dynamics quick_enough(Dynamics share, const BaseMotion& base, const MotionLimits& limits) noexcept;
  bool stays_against(const BaseMotion& base, const Job* job, const Dynamics& dynamics) const noexcept;
  bool runs_down() const noexcept;

  Dynamics wanted_;  // before override and limits
  Dynamics share_;   // of that, what it has been planned with
  Dynamics uses_;    // of the limits, in this cycle and from it on
  Setpoint base_;
  bool base_curbed_ = false;         // the base motion has been planned with less
  bool curbed_for_a_while_ = false;  // by what that runs down yet
  bool advancing_base_ = false;
  Superimposed part_;  // last, with what every cycle touches at its end
};

}  // namespace lockstep
