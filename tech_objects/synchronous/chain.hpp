/// The parts of a synchronous motion that stand while an axis joins it, and while it leaves it.
#pragma once

#include "tech_objects/synchronous/leading_coupling.hpp"
#include "tech_objects/synchronous/shifts.hpp"
#include "tech_objects/synchronous/synchronous_function.hpp"

namespace lockstep {

/// leading value → function → + offset, each the owner of its state.
struct Chain {
  LeadingCoupling& leading;
  SynchronousFunction& function;
  Shifts& shifts;
  double period;  ///< [s]
};

/// That of another motion, to look at.
struct ChainView {
  const LeadingCoupling& leading;
  const SynchronousFunction& function;
  const Shifts& shifts;
};

/// How far the leading value has come since the start of what is made of it, and whether it has turned back.
class LeadingProgress {
 public:
  /// @param direction of the leading value: 1, -1; 0: it has not moved yet
  void begin(AxisPosition start, int direction) noexcept {
    start_ = start;
    direction_ = direction;
    progress_ = 0.0;
    furthest_ = 0.0;
    reversed_ = false;
  }
  void set_direction(int direction) noexcept { direction_ = direction; }
  int direction() const noexcept { return direction_; }

  /// Leading distance since the start, in its direction [u].
  double covered(const LeadingStep& step) const noexcept {
    return direction_ * rounded_difference(step.now.position, start_, step.modulo);
  }
  /// Each tick. The progress is the very place at which a profile is read, so that a leading axis homed
  /// backwards counts as the reversal that it is for the profile; or the sum of all steps.
  /// @param tolerance leading distance by which the leading value may turn back [u]
  void watch(const LeadingStep& step, double tolerance, bool sum_of_steps) noexcept {
    const double distance = step.distance();
    if (direction_ == 0) direction_ = sign(distance);
    progress_ = sum_of_steps ? progress_ + direction_ * distance : covered(step);
    if (progress_ > furthest_) furthest_ = progress_;
    reversed_ = furthest_ - progress_ > tolerance;
  }
  bool reversed() const noexcept { return reversed_; }
  /// Whether it has turned back within the tolerance.
  bool behind() const noexcept { return progress_ < furthest_; }

  /// The turns of the leading axis are other ones by so many.
  void turn_leading(std::int64_t turns) noexcept { start_.turns += turns; }

 private:
  AxisPosition start_;
  int direction_ = 0;
  double progress_ = 0.0;
  double furthest_ = 0.0;  // maximum progress
  bool reversed_ = false;
};

}  // namespace lockstep
