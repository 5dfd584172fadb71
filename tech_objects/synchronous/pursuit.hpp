/// Onto a moving target and then along with it, within a velocity, an acceleration and a deceleration, in
/// whole steps: a target of constant velocity is met exactly and without overshoot. Velocities are distances
/// per step. Nothing here allocates or throws.
#pragma once

#include <algorithm>
#include <cmath>

#include "tech_objects/synchronous/braking_speed.hpp"
#include "tech_objects/synchronous/counted_pace.hpp"
#include "tech_objects/synchronous/pursuit_limits.hpp"

namespace lockstep {

class Pursuit {
 public:
  /// Goes on from here. @param velocity [u/step]
  void begin(double position, double velocity) noexcept {
    move_to(position, steady_ = last_target_velocity_ = velocity);
    synchronous_ = locked_ = false;
    pace_.begin();
  }
  /// Is moved by somebody else, along with no counted target. @param velocity [u/step]
  void move_to(double position, double velocity) noexcept {
    position_ = position;
    velocity_ = velocity;
  }
  /// What is known of a counted target beforehand: its mean velocity over so many steps [u/step].
  void expect(double velocity, double steps) noexcept { pace_.expect(velocity, steps); }
  /// One step. @param target where to be at its end [u]  @param target_velocity how far the target moves in a
  /// step, without steps of its own [u/step]; all finite
  void step(double target, double target_velocity, const PursuitLimits& limits) noexcept {
    const double whole = target - position_;
    const double rest = whole - target_velocity;  // beyond going along
    const bool counted = limits.uncertainty > 0.0;
    double pace = target_velocity;
    if (counted)
      pace = limits.spread + pace_.step(target_velocity - limits.spread, limits.uncertainty,
                                        std::min(limits.acceleration, limits.deceleration));
    const bool stays = counted && stays_on(whole, rest, target_velocity, limits);
    last_target_velocity_ = target_velocity;
    if (stays) {
      velocity_ = whole;
      position_ = target;
      return;
    }
    const double wanted = bounded(pace + approach(rest, pace, limits), rest, pace, limits);
    const double velocity = reachable(wanted, limits);
    const double jump = std::abs(velocity - target_velocity);
    velocity_ = velocity;
    position_ = velocity == whole ? target : position_ + velocity;
    synchronous_ =
        std::abs(target - position_) < 1.0 && jump <= std::max(limits.acceleration, limits.deceleration);
  }
  /// One step towards a velocity alone.
  void follow(double target_velocity, const PursuitLimits& limits) noexcept {
    velocity_ = reachable(bounded(target_velocity, 0.0, target_velocity, limits), limits);
    position_ += velocity_;
    synchronous_ = velocity_ == target_velocity;
  }
  /// Called by another name: what it is at moves, it does not.
  void shift(double by) noexcept { position_ += by; }

  /// Whether the velocity must not be negative. What spreads a correction is no motion of the target.
  static bool only_forward(double target_velocity, const PursuitLimits& limits) noexcept {
    constexpr double kRests = -1e-9;  // [u/step]
    using Reversal = PursuitLimits::Reversal;
    return limits.reversal == Reversal::never ||
           (limits.reversal == Reversal::with_target && target_velocity - limits.spread >= kRests);
  }

  double position() const noexcept { return position_; }
  double velocity() const noexcept { return velocity_; }  ///< [u/step] of the last step
  /// Whether it is within one unit of the target and goes along with it.
  bool synchronous() const noexcept { return synchronous_; }

 private:
  static constexpr double kRounding = 1e-14;  // of a position

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
      steady_ = velocity_;
    }
    // What the target has stepped by beside its velocity is made up for, and within the band; what rounding
    // leaves is nothing to make up for.
    const double correction = std::abs(rest) <= kRounding * (1.0 + std::abs(position_)) ? 0.0 : rest;
    locked_ = std::abs(whole - steady_) <= change + uncertainty &&
              bounded(whole, correction, target_velocity, limits) == whole;
    synchronous_ = locked_;
    return locked_;
  }
  static double approach(double rest, double target_velocity, const PursuitLimits& limits) noexcept {
    const double distance = std::abs(rest);
    if (distance == 0.0) return 0.0;
    const bool catches_up = (rest > 0.0) == (target_velocity >= 0.0);
    double towards = braking_speed(distance, catches_up ? limits.deceleration : limits.acceleration);
    // On its way back through standstill both count.
    if (!catches_up && towards > std::abs(target_velocity))
      towards = std::max(std::min(towards, std::abs(target_velocity)),
                         braking_speed(distance, std::min(limits.acceleration, limits.deceleration)));
    return std::copysign(towards, rest);
  }
  static double bounded(double wanted, double rest, double target_velocity,
                        const PursuitLimits& limits) noexcept {
    double low = -limits.velocity, high = limits.velocity;
    if (limits.band >= 0.0 && (rest != 0.0 || limits.spread != 0.0)) {
      const double pace = target_velocity - limits.spread, band = std::abs(pace) * limits.band;
      low = std::clamp(pace - band, low, high);
      high = std::clamp(pace + band, low, high);
    }
    if (only_forward(target_velocity, limits)) {
      low = std::max(low, 0.0);
      high = std::max(high, 0.0);
    }
    return std::clamp(wanted, low, high);
  }
  /// What can be reached in a step from the velocity of the last one.
  double reachable(double wanted, const PursuitLimits& limits) const noexcept {
    const double own = velocity_;
    if (own == 0.0) return std::clamp(wanted, -limits.acceleration, limits.acceleration);
    const bool mirrored = own < 0.0;
    const double speed = mirrored ? -own : own, to = mirrored ? -wanted : wanted;
    double lowest = speed - limits.deceleration;
    // What is left of the step when it stands goes into the other direction.
    if (lowest < 0.0) lowest = -(1.0 - speed / limits.deceleration) * limits.acceleration;
    // Both bounds, without a branch: which of them counts changes from step to step.
    const double reached = std::min(std::max(to, lowest), speed + limits.acceleration);
    return mirrored ? -reached : reached;
  }

  double position_ = 0.0, velocity_ = 0.0;
  double steady_ = 0.0;  // velocity that keeps the limits, beside which that of a counted target jumps
  double last_target_velocity_ = 0.0;
  CountedPace pace_;
  bool synchronous_ = false, locked_ = false;
};

}  // namespace lockstep
