/// Puts a profile together, phase by phase, from the start state on.
#pragma once

#include "tech_objects/profile/profile.hpp"
#include "tech_objects/profile/rise.hpp"

namespace lockstep {

/// `sign` below is +1 or -1: the direction in which a rise is meant. Velocity and acceleration at the ends of
/// a part are set to the planned values, so that rounding does not add up over the phases.
class ProfileBuilder {
 public:
  ProfileBuilder(Profile& profile, const MotionState& start, JerkLimit jerk) noexcept
      : profile_(profile), state_(start), jerk_(jerk) {
    profile_.start_ = start;
    profile_.count_ = 0;
    if (jerk.jerk == 0.0) state_.acceleration = 0.0;
  }

  /// From the present acceleration, which opposes `sign`, to 0 at velocity `stop`.
  void add_release(double sign, double stop) noexcept {
    add(std::abs(state_.acceleration) * jerk_.inverse, sign * jerk_.jerk);
    state_.velocity = stop;
    state_.acceleration = 0.0;
  }

  void add_rise(const Rise& rise, double sign) noexcept {
    add_part(rise.first, sign);
    if (rise.crosses) add_part(rise.second, sign);
  }

  /// A rise run backwards in time.
  void add_reversed(const Rise& rise, double sign) noexcept {
    if (rise.crosses) add_reversed_part(rise.second, sign);
    add_reversed_part(rise.first, sign);
  }

  void add_part(const RisePart& part, double sign) noexcept {
    add(part.t1, part.peak >= part.a0 ? sign * jerk_.jerk : -sign * jerk_.jerk);
    state_.acceleration = sign * part.peak;
    add(part.t2, 0.0);
    add(part.t3, -sign * jerk_.jerk);
    state_.velocity = sign * part.v1;
    state_.acceleration = sign * part.a1;
  }

  void add_cruise(double duration) noexcept { add(duration, 0.0); }

  /// Changes the acceleration by `jerk` [u/s³] for a duration [s].
  void add_jerk(double duration, double jerk) noexcept { add(duration, jerk); }

  /// Position reached so far [u].
  double position() const noexcept { return state_.position; }

  void finish(double position, double velocity) noexcept {
    profile_.target_ = {position, velocity, 0.0};
    profile_.duration_ = time_;
  }

 private:
  void add_reversed_part(const RisePart& part, double sign) noexcept {
    add(part.t3, -sign * jerk_.jerk);
    state_.acceleration = -sign * part.peak;
    add(part.t2, 0.0);
    add(part.t1, part.peak >= part.a0 ? sign * jerk_.jerk : -sign * jerk_.jerk);
    state_.velocity = sign * part.v0;
    state_.acceleration = -sign * part.a0;
  }

  void add(double duration, double jerk) noexcept {
    if (!(duration > 0.0)) return;
    if (!continues_last(jerk))
      profile_.phases_[static_cast<std::size_t>(profile_.count_++)] = {time_, state_, jerk};
    const double t = duration;
    state_.position += t * (state_.velocity + t * (state_.acceleration * 0.5 + t * jerk * (1.0 / 6.0)));
    state_.velocity += t * (state_.acceleration + t * jerk * 0.5);
    state_.acceleration += t * jerk;
    time_ += t;
  }

  // Phases with the same jerk that follow each other are one, unless the acceleration stays (trapezoids).
  bool continues_last(double jerk) const noexcept {
    return profile_.count_ > 0 && jerk != 0.0 &&
           profile_.phases_[static_cast<std::size_t>(profile_.count_ - 1)].jerk == jerk;
  }

  Profile& profile_;
  MotionState state_;
  JerkLimit jerk_;
  double time_{};
};

}  // namespace lockstep
