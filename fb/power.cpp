#include "fb/power.hpp"

namespace lockstep {

/// In most calls the instance is in charge, with inputs that are permitted.
void MC_Power::call(std::int64_t /*now*/) noexcept {
  if (!in_charge()) return call_without_charge();
  PowerRequest& power = Axis->power;
  power.start_mode = static_cast<lockstep::StartMode>(StartMode);
  power.stop_mode = static_cast<PowerStopMode>(StopMode);
  const bool enable = Enable;
  power.enable = enable;
  Status = enable && Axis->enabled();
  Busy = enable || !Axis->off();
  const bool failed = enable && Axis->enable_removed();
  Error = failed;
  ErrorID = static_cast<WORD>(failed ? ErrorId::technology_alarm : ErrorId::none);
}

[[gnu::noinline]] void MC_Power::call_without_charge() noexcept {
  const bool owns = Axis != nullptr && Axis->power.owner == this;
  ErrorId error = take_charge();
  if (error == ErrorId::none || owns) {
    PowerRequest& power = Axis->power;
    if (error == ErrorId::none) {
      power.start_mode = static_cast<lockstep::StartMode>(StartMode);
      power.stop_mode = static_cast<PowerStopMode>(StopMode);
    }
    // A mode that is not permitted enables nothing, and must not keep anything from being stopped.
    power.enable = Enable && (error == ErrorId::none || power.enable);
    Status = power.enable && Axis->enabled();
    Busy = power.enable || !Axis->off();
    if (power.enable && Axis->enable_removed() && error == ErrorId::none) error = ErrorId::technology_alarm;
  } else {
    Status = false;
    Busy = false;
  }
  Error = error != ErrorId::none;
  ErrorID = static_cast<WORD>(error);
}

bool MC_Power::in_charge() const noexcept {
  return Axis != nullptr && Axis->power.owner == this && permitted_ == Modes{StartMode, StopMode};
}

ErrorId MC_Power::take_charge() noexcept {
  if (const ErrorId error = first_error(kPins, *this); error != ErrorId::none) return error;
  permitted_ = {StartMode, StopMode};
  if (Axis->power.owner != nullptr && Axis->power.owner != this) return ErrorId::one_instance_only;
  Axis->power.owner = this;
  return ErrorId::none;
}

void MC_Reset::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Reset;
  job.asks = ResetJob{.restart = Restart};
}

}  // namespace lockstep
