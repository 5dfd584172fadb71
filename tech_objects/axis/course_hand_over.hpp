/// What axes that follow the setpoint see of it where it goes over from one course to another.
#pragma once

#include "tech_objects/profile/superimposed.hpp"

namespace lockstep {

/// For those that follow there is no step: what is ahead of the setpoint comes down to nothing. Two of them:
/// ahead of the setpoint itself, and ahead of that what axes see that follow its position since it was zero
/// to them. Thread: the cycle.
class CourseHandOver {
 public:
  /// @param period of the interpolator [s]
  void configure(double period) noexcept;

  /// Begins to bring down what is ahead of the setpoint. False: nothing could be planned, and it is gone.
  bool begin(const Setpoint& ahead, const Dynamics& dynamics) noexcept {
    return run_down(to_setpoint_, ahead, dynamics);
  }
  /// Begins to bring down the distance back from zero. False: nothing could be planned, and it is gone.
  bool begin_return(const Setpoint& ahead, const Dynamics& dynamics) noexcept {
    return run_down(from_zero_, ahead, dynamics);
  }
  /// Nothing is ahead of the setpoint any more.
  void settle() noexcept { to_setpoint_.begin(); }

  bool finished() const noexcept { return to_setpoint_.finished(); }
  bool returned() const noexcept { return from_zero_.finished(); }
  void advance() noexcept { to_setpoint_.advance(); }
  void advance_return() noexcept { from_zero_.advance(); }

  /// The setpoint with what is left ahead of it.
  Setpoint course(const Setpoint& setpoint, const Modulo& modulo) const noexcept {
    return with(to_setpoint_, setpoint, modulo);
  }
  /// That course with what is left of the distance back from zero.
  Setpoint returning(const Setpoint& course, const Modulo& modulo) const noexcept {
    return with(from_zero_, course, modulo);
  }

  // The setpoint is about to become the actual value of an axis that is switched off.
  void make_due(bool due) noexcept { due_ |= due; }
  bool due() const noexcept { return due_; }
  void take() noexcept { due_ = false; }

 private:
  static bool run_down(Superimposed& part, const Setpoint& ahead, const Dynamics& dynamics) noexcept;
  static Setpoint with(const Superimposed& part, const Setpoint& setpoint, const Modulo& modulo) noexcept {
    return {advanced(setpoint.position, part.value(), modulo), setpoint.velocity + part.velocity(),
            setpoint.acceleration + part.acceleration()};
  }

  Superimposed to_setpoint_;
  Superimposed from_zero_;
  bool due_ = false;
};

}  // namespace lockstep
