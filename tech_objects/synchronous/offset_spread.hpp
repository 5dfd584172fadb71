/// An offset that is taken up over a time: at once, in equal steps, or as a trapezoid.
/// Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 33-27; MG.33.L5.03: trapezoid
#pragma once

#include <algorithm>
#include <cmath>

#include "tech_objects/synchronous/plain_pursuit.hpp"

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
    velocity_ = trapezoid ? distance / ((1.0 - kRamp) * time) : distance / time;
    acceleration_ = trapezoid ? velocity_ / (kRamp * time) : kAny;
  }
  /// What is wanted from now on, in equal steps of this time alone [ms].
  void want_within(double offset, double time) noexcept {
    want(offset);
    at_once_ = !(time > 1.0);
    if (at_once_) return;
    velocity_ = std::abs(offset - moved_.position()) / time;
    acceleration_ = kAny;
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
    else if (acceleration_ == kAny)
      step_equally();
    else
      step_with_ramps();
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
    // Without a branch: to which side it goes changes from one correction to the next.
    const double by = std::copysign(std::min(std::abs(rest), velocity_), rest);
    moved_.begin(by == rest ? wanted_ : moved_.position() + by, by);
  }
  [[gnu::noinline]] void step_with_ramps() noexcept {
    moved_.step(wanted_, 0.0,
                {.velocity = velocity_, .acceleration = acceleration_, .deceleration = acceleration_});
  }

  bool at_once_ = true;
  bool rests_ = false;  // at what is wanted
  double wanted_ = 0.0;
  PlainPursuit moved_;
  double velocity_ = 0.0, acceleration_ = 1.0;  // at most [u/ms], [u/ms²]
};

}  // namespace lockstep
