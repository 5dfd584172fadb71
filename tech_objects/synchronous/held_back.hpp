/// What an axis that may not reverse has been held back by, ahead of its target: it goes along with the
/// target all the same, and gives that back over a time, as a trapezoid. Nothing here allocates or throws.
/// @source MG.33.L5.03, 32-68 and 33-27: errors that a setting of REVERS has accumulated
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tech_objects/synchronous/plain_pursuit.hpp"
#include "tech_objects/synchronous/pursuit.hpp"
#include "tech_objects/synchronous/pursuit_limits.hpp"

namespace lockstep {

class HeldBack {
 public:
  /// @param distance what is given back in `time` [u]; with either 0 nothing is: the axis waits until its
  /// target comes  @param time [ms]  @param dither a target that goes forward by so much does go [u]
  void set(double distance, double time, double dither) noexcept {
    constexpr double kRamp = 0.2;
    active_ = distance > 0.0 && time > 0.0;
    dither_ = dither;
    if (!active_) return begin();
    maximum_ = distance / ((1.0 - kRamp) * time);
    acceleration_ = maximum_ / (kRamp * time);
  }
  /// Nothing is held back.
  void begin() noexcept {
    state_ = State::free;
    given_.begin(0.0, 0.0);
  }
  bool active() const noexcept { return active_; }
  /// One millisecond, before that of the axis, while `active`. @param target where it would be at the end [u]
  /// @param velocity of the target [u/step]  @param axis as the last step has left it  @param forward whether
  /// it may not reverse
  void step(double target, double velocity, const Pursuit& axis, bool forward,
            const PursuitLimits& of_axis) noexcept {
    constexpr double kShare = 1.0 / 64.0;  // of one millisecond in the mean velocity
    mean_ += (velocity - mean_) * kShare;
    if (std::abs(mean_) < 1e-300) mean_ = 0.0;  // a processor is slow with what is below 2⁻¹⁰²²
    const double ahead = axis.position() - (target - velocity);
    if (forward && axis.velocity() <= 0.0 && ahead > by() && state_ != State::starts) {
      if (state_ != State::waits) turned_ = target;
      state_ = State::waits;
    }
    if (state_ == State::waits) {
      turned_ = std::min(turned_, target);
      if (!forward || ahead <= by())
        state_ = State::gives;
      else if (target - turned_ > dither_)
        state_ = State::starts;
    }
    if (state_ == State::starts) return start(ahead, target, velocity, axis.velocity(), of_axis);
    if (state_ == State::gives) give(forward);
  }

  double by() const noexcept { return given_.position(); }        ///< [u] ahead of the target
  double velocity() const noexcept { return given_.velocity(); }  ///< [u/step]

 private:
  enum class State : std::uint8_t { free, waits, starts, gives };

  /// Up to the velocity of the target, wherever it is.
  void start(double ahead, double target, double velocity, double own,
             const PursuitLimits& of_axis) noexcept {
    if (ahead <= 0.0) return begin();
    given_.begin(ahead, 0.0);
    turned_ = std::max(turned_, target);
    if (turned_ - target > dither_) {
      state_ = State::waits;
      turned_ = target;
    } else if (std::abs(own - velocity) <= of_axis.acceleration + of_axis.uncertainty) {
      state_ = State::gives;
    }
  }
  /// Not faster than the target goes forward.
  void give(bool forward) noexcept {
    const double velocity = forward ? std::clamp(mean_, 0.0, maximum_) : maximum_;
    if (-given_.velocity() > velocity) given_.begin(given_.position(), -velocity);
    given_.step(0.0, 0.0,
                {.velocity = velocity, .acceleration = acceleration_, .deceleration = acceleration_});
    if (given_.position() == 0.0 && given_.velocity() == 0.0) state_ = State::free;
  }

  State state_ = State::free;
  double dither_ = 0.0, mean_ = 0.0;
  double maximum_ = 0.0, acceleration_ = 1.0;  // of giving back [u/ms], [u/ms²]
  double turned_ = 0.0;                        // where the target has turned
  PlainPursuit given_;
  bool active_ = false;  // last, beside what those need who ask for no more
};

}  // namespace lockstep
