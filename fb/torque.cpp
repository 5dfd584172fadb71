#include "fb/torque.hpp"

#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

void TorqueBlock::call(std::int64_t /*now*/) noexcept {
  const bool rising = Enable && !last_enable_;
  last_enable_ = Enable;
  const ErrorId error = Enable ? enabled(rising) : disabled();
  const bool active = Axis != nullptr && owner() == this;
  Error = error != ErrorId::none;
  Busy = active;  // also beside an error that does not end what the axis does
  ErrorID = static_cast<WORD>(error);
  show(active);
}

/// What was rejected stays so until Enable falls.
ErrorId TorqueBlock::enabled(bool rising) noexcept {
  ErrorId error = check_inputs();
  if (error == ErrorId::none && Axis != nullptr && owner() != this) {
    if (!rising) return rejected_;
    error = owner() != nullptr ? ErrorId::one_instance_only : refusal();
    if (error == ErrorId::none) owner() = this;
  }
  if (rising) rejected_ = error;
  if (error != ErrorId::none) return error;
  request();
  return pause();
}

ErrorId TorqueBlock::disabled() noexcept {
  rejected_ = ErrorId::none;
  if (Axis == nullptr || owner() != this) return ErrorId::none;
  if (const ErrorId error = hold(); error != ErrorId::none) return error;
  owner() = nullptr;
  return ErrorId::none;
}

ErrorId TorqueBlock::check_inputs() const noexcept {
  if (const ErrorId error = first_error(pin_table(), *this); error != ErrorId::none) return error;
  return check_together();
}

ErrorId MC_TorqueLimiting::check_together() const noexcept {
  return chooses(Mode, TorqueLimitingMode::fixed_stop_detection) && Axis != nullptr && !Axis->has_position()
             ? ErrorId::mode
             : ErrorId::none;
}

ErrorId MC_TorqueLimiting::hold() const noexcept {
  return Axis->clamping().holds() ? ErrorId::clamping : ErrorId::none;
}

void MC_TorqueLimiting::request() const noexcept {
  Axis->forces().limiting.limit = Limit;
  Axis->forces().limiting.mode = static_cast<TorqueLimitingMode>(Mode);
}

void MC_TorqueLimiting::show(bool active) noexcept {
  InClamping = active && Axis->clamping().holds();
  InLimitation = active && Axis->forces().in_limitation();
}

ErrorId MC_TorqueRange::check_together() const noexcept {
  return UpperLimit > LowerLimit ? ErrorId::none : ErrorId::torque_limits_order;
}

void MC_TorqueRange::request() const noexcept {
  Axis->forces().range.lower = LowerLimit;
  Axis->forces().range.upper = UpperLimit;
}

void MC_TorqueAdditive::request() const noexcept {
  Axis->forces().additive.value = Value;
}

}  // namespace lockstep
