#include "fb/power.hpp"

namespace lockstep {

void MC_Power::call(std::int64_t /*now*/) noexcept {
  ErrorId error = check();
  if (error == ErrorId::none) {
    Axis->power.owner = this;
    Axis->power.enable = Enable;
    Axis->power.start_mode = StartMode;
    Axis->power.stop_mode = StopMode;
    Status = Enable && Axis->enabled();
    Busy = Enable || !Axis->off();
    if (Enable && Axis->enable_removed()) error = ErrorId::technology_alarm;
  } else {
    Status = false;
    Busy = false;
  }
  Error = error != ErrorId::none;
  ErrorID = static_cast<WORD>(error);
}

ErrorId MC_Power::check() noexcept {
  const Modes modes{StartMode, StopMode};
  if (Axis == nullptr || permitted_ != modes) {
    if (const ErrorId error = first_error(kPins, *this); error != ErrorId::none) return error;
    permitted_ = modes;
  }
  const bool other = Axis->power.owner != nullptr && Axis->power.owner != this;
  return other ? ErrorId::one_instance_only : ErrorId::none;
}

void MC_Reset::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Reset;
  job.mode = Restart ? 1 : 0;
}

}  // namespace lockstep
