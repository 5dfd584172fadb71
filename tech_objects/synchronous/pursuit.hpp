/// Onto a moving target and then along with it, within a velocity, an acceleration and a deceleration, in
/// whole steps: a target of constant velocity is met exactly and without overshoot. Velocities are distances
/// per step. Nothing here allocates or throws.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/synchronous/counted_pace.hpp"
#include "tech_objects/synchronous/plain_pursuit.hpp"
#include "tech_objects/synchronous/pursuit_limits.hpp"

namespace lockstep {

class Pursuit {
 public:
  /// Goes on from here. @param velocity [u/step]
  void begin(double position, double velocity) noexcept {
    own_.begin(position, steady_ = last_target_velocity_ = velocity);
    last_target_ = kNone;
    synchronous_ = locked_ = false;
    pace_.begin();
  }
  /// What is known of a counted target beforehand: its mean velocity over so many steps [u/step].
  void expect(double velocity, double steps) noexcept { pace_.expect(velocity, steps); }
  /// One step. @param target where to be at its end [u]  @param target_velocity how far the target moves in a
  /// step, without steps of its own [u/step]; all finite
  [[gnu::always_inline]] void step(double target, double target_velocity,
                                   const PursuitLimits& limits) noexcept {
    const double whole = target - position();
    const double rest = whole - target_velocity;  // beyond going along
    const bool counted = limits.uncertainty > 0.0;
    double pace = target_velocity;
    if (counted)
      pace = limits.spread + pace_.step(target_velocity - limits.spread, limits.uncertainty,
                                        std::min(limits.acceleration, limits.deceleration));
    const bool stays = counted && stays_on(whole, rest, target_velocity, limits);
    last_target_ = target;
    last_target_velocity_ = target_velocity;
    synchronous_ = stays;
    if (stays) return own_.begin(target, whole);
    own_.step(target, rest, pace, limits);
  }
  /// One step towards a velocity alone.
  void follow(double target_velocity, const PursuitLimits& limits) noexcept {
    own_.follow(target_velocity, limits);
    last_target_ = kNone;
    synchronous_ = velocity() == target_velocity;
  }
  /// Called by another name: what it is at moves, it does not.
  void shift(double by) noexcept { own_.shift(by); }

  double position() const noexcept { return own_.position(); }
  double velocity() const noexcept { return own_.velocity(); }  ///< [u/step] of the last step
  /// Whether it is within one unit of the target and goes along with it. @param limits of the last step
  bool synchronous(const PursuitLimits& limits) const noexcept {
    const double jump = std::abs(velocity() - last_target_velocity_);
    return synchronous_ || (std::abs(last_target_ - position()) < 1.0 &&
                            jump <= std::max(limits.acceleration, limits.deceleration));
  }

 private:
  static constexpr double kRounding = 1e-14;  // of a position
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  /// Whether it is on a counted target, and may go on with all its steps.
  bool stays_on(double whole, double rest, double target_velocity, const PursuitLimits& limits) noexcept {
    const double change = std::max(limits.acceleration, limits.deceleration);
    double uncertainty = limits.uncertainty;
    if (locked_) {
      const bool faster = (target_velocity > steady_) == (steady_ >= 0.0);
      const double step = faster ? limits.acceleration : limits.deceleration;
      steady_ += std::clamp(target_velocity - steady_, -step, step);
    } else {
      // What is gained in this step has to go again in the next one.
      uncertainty = std::min(uncertainty, std::abs(target_velocity - last_target_velocity_));
      if (std::abs(rest) > change + uncertainty) return false;
      steady_ = velocity();
    }
    // What the target has stepped by beside its velocity is made up for, and within the band; what rounding
    // leaves is nothing to make up for.
    const double correction = std::abs(rest) <= kRounding * (1.0 + std::abs(position())) ? 0.0 : rest;
    locked_ = std::abs(whole - steady_) <= change + uncertainty &&
              PlainPursuit::bounded(whole, correction, target_velocity, limits) == whole;
    return locked_;
  }

  PlainPursuit own_;
  double steady_ = 0.0;  // velocity that keeps the limits, beside which that of a counted target jumps
  double last_target_ = kNone, last_target_velocity_ = 0.0;
  CountedPace pace_;
  bool synchronous_ = false, locked_ = false;
};

}  // namespace lockstep
