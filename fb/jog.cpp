#include "fb/jog.hpp"

#include <cmath>

namespace lockstep {

void MC_MoveJog::call(std::int64_t /*now*/) noexcept {
  const bool wanted = JogForward || JogBackward;
  if (!wanted) {
    released_ = true;
    aborted_ = false;
    error_ = ErrorId::none;
    if (job_.running()) update(0);
  } else if (error_ == ErrorId::none && !aborted_) {
    const ErrorId error = JogForward && JogBackward ? ErrorId::direction : check();
    if (error != ErrorId::none) {
      brake(error);
    } else if (job_.running()) {
      update(JogForward ? 1 : -1);
    } else if (released_) {
      job_ = Job{};
      job_.kind = JobKind::MC_MoveJog;
      update(JogForward ? 1 : -1);
      released_ = false;
      Axis->submit(job_);
    }
  }
  if (job_.phase == JobPhase::failed && wanted && error_ == ErrorId::none) error_ = job_.error;
  if (job_.phase == JobPhase::aborted && wanted) aborted_ = true;
  if (job_.ended()) job_.phase = JobPhase::idle;

  Error = error_ != ErrorId::none;
  ErrorID = static_cast<WORD>(error_);
  CommandAborted = aborted_ && !Error;
  Busy = job_.running() && !Error;
  InVelocity = Busy && wanted && job_.phase == JobPhase::reached;
}

ErrorId MC_MoveJog::check() const noexcept {
  return first_error(kPins, *this);
}

/// The inputs of a running job count in every call; the axis compares them with what it has planned.
void MC_MoveJog::update(int direction) noexcept {
  job_.asks = JogJob{.direction = direction};
  if (direction == 0) return;  // the last valid dynamics brake
  job_.velocity = std::abs(Velocity);
  job_.acceleration = Acceleration;
  job_.deceleration = Deceleration;
  job_.jerk = Jerk;
  job_.position_controlled = PositionControlled;
}

void MC_MoveJog::brake(ErrorId error) noexcept {
  error_ = error;
  released_ = false;
  if (job_.running()) update(0);
}

}  // namespace lockstep
