/// An offset that is taken up over a time: at once, in equal steps, or as a trapezoid.
/// Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 33-27; MG.33.L5.03: trapezoid
#pragma once

#include <algorithm>

#include "tech_objects/synchronous/pursuit.hpp"

namespace lockstep {

class OffsetSpread {
 public:
  /// How offsets are taken up from now on: one of `distance` in `time`.
  /// @param distance [u] ≥ 0  @param time [ms]; 0 or no distance: at once  @param trapezoid of 20 % speeding
  /// up and 20 % braking; else equal steps
  void set(double distance, double time, bool trapezoid) noexcept {
    constexpr double kRamp = 0.2;
    at_once_ = !(distance > 0.0) || !(time > 0.0);
    if (at_once_) return;
    limits_.velocity = trapezoid ? distance / ((1.0 - kRamp) * time) : distance / time;
    limits_.acceleration = limits_.deceleration = trapezoid ? limits_.velocity / (kRamp * time) : kAny;
  }
  /// What is wanted from now on, in equal steps of this time alone [ms].
  void want_within(double offset, double time) noexcept {
    want(offset);
    at_once_ = !(time > 1.0);
    if (at_once_) return;
    limits_.velocity = std::abs(offset - moved_.position()) / time;
    limits_.acceleration = limits_.deceleration = kAny;
  }
  void begin(double offset) noexcept {
    want(offset);
    moved_.begin(offset, 0.0);
  }
  void want(double offset) noexcept {
    wanted_ = offset;
    rests_ = false;
  }
  /// One millisecond.
  double step() noexcept {
    if (rests_) return wanted_;
    rests_ = moved_.position() == wanted_ && moved_.velocity() == 0.0;
    if (rests_) return wanted_;
    if (at_once_)
      moved_.begin(wanted_, 0.0);
    else if (limits_.acceleration == kAny)
      step_equally();
    else
      moved_.step(wanted_, 0.0, limits_);
    return moved_.position();
  }

  double wanted() const noexcept { return wanted_; }              ///< [u]
  double reached() const noexcept { return moved_.position(); }   ///< [u]
  double velocity() const noexcept { return moved_.velocity(); }  ///< [u/ms]

 private:
  static constexpr double kAny = 1e30;  // [u/ms²]

  /// Without ramps there is nothing to pursue.
  void step_equally() noexcept {
    const double rest = wanted_ - moved_.position();
    const double by = std::clamp(rest, -limits_.velocity, limits_.velocity);
    moved_.move_to(by == rest ? wanted_ : moved_.position() + by, by);
  }

  bool at_once_ = true;
  bool rests_ = false;  // at what is wanted
  double wanted_ = 0.0;
  Pursuit moved_;
  PursuitLimits limits_;
};

}  // namespace lockstep
