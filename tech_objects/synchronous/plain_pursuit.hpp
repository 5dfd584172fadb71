/// Onto a target whose velocity is known, and then along with it: all that it keeps is where it is and how
/// fast. Velocities are distances per step. Nothing here allocates or throws.
#pragma once

#include <algorithm>
#include <cmath>

#include "tech_objects/arithmetic/seldom_cut.hpp"
#include "tech_objects/synchronous/braking_speed.hpp"
#include "tech_objects/synchronous/pursuit_limits.hpp"

namespace lockstep {

class PlainPursuit {
 public:
  /// Goes on from here. @param velocity [u/step]
  void begin(double position, double velocity) noexcept {
    position_ = position;
    velocity_ = velocity;
  }
  /// One step. @param target where to be at its end [u]  @param target_velocity [u/step]
  void step(double target, double target_velocity, const PursuitLimits& limits) noexcept {
    step(target, target - position_ - target_velocity, target_velocity, limits);
  }
  /// One step towards a target that has stepped beside its velocity. @param rest beyond going along [u]
  /// @param pace velocity of the target without those steps [u/step]
  void step(double target, double rest, double pace, const PursuitLimits& limits) noexcept {
    const double whole = target - position_;
    velocity_ = reachable(bounded(pace + approach(rest, pace, limits), rest, pace, limits), limits);
    position_ = velocity_ == whole ? target : position_ + velocity_;
  }
  /// One step towards a velocity alone.
  void follow(double target_velocity, const PursuitLimits& limits) noexcept {
    velocity_ = reachable(bounded(target_velocity, 0.0, target_velocity, limits), limits);
    position_ += velocity_;
  }
  /// Called by another name: what it is at moves, it does not.
  void shift(double by) noexcept { position_ += by; }

  double position() const noexcept { return position_; }
  double velocity() const noexcept { return velocity_; }  ///< [u/step] of the last step

  /// A velocity within limits. @param rest 0: the target is met, and goes along  @param target_velocity of it
  static double bounded(double wanted, double rest, double target_velocity,
                        const PursuitLimits& limits) noexcept {
    const bool symmetric = limits.band < 0.0 && limits.reversal == PursuitLimits::Reversal::free;
    return symmetric ? seldom_cut(wanted, limits.velocity)
                     : bounded_by_all(wanted, rest, target_velocity, limits);
  }

 private:
  /// `bounded`, where a band or a direction counts as well.
  [[gnu::noinline]] static double bounded_by_all(double wanted, double rest, double target_velocity,
                                                 const PursuitLimits& limits) noexcept {
    double low = -limits.velocity, high = limits.velocity;
    if (limits.band >= 0.0 && (rest != 0.0 || limits.spread != 0.0)) {
      const double pace = target_velocity - limits.spread, band = std::abs(pace) * limits.band;
      low = std::clamp(pace - band, low, high);
      high = std::clamp(pace + band, low, high);
    }
    if (limits.only_forward(target_velocity)) {
      low = std::max(low, 0.0);
      high = std::max(high, 0.0);
    }
    return std::clamp(wanted, low, high);
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
};

}  // namespace lockstep
