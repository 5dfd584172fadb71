#include "fb/leading_value.hpp"

namespace lockstep {

void MC_LeadingValueAdditive::call(std::int64_t /*now*/) noexcept {
  const bool rising = Enable && !last_enable_;
  last_enable_ = Enable;
  const ErrorId error = Enable ? check() : ErrorId::none;
  if (rising) overridden_ = false;
  AdditiveRequest* request = Axis == nullptr ? nullptr : &Axis->additive_request;
  if (rising && error == ErrorId::none) {
    request->owner = this;  // the last one enabled counts
  } else if (request != nullptr && request->owner != this && Enable && Busy) {
    overridden_ = true;
  }
  const bool mine = request != nullptr && request->owner == this;
  if (mine && !Enable) request->owner = nullptr;
  if (mine && Enable && error == ErrorId::none) request->value = {Position, Velocity, Acceleration};
  Busy = mine && Enable;
  Error = error != ErrorId::none && !overridden_;
  if (Error) Busy = false;
  ErrorID = static_cast<WORD>(Error ? error : ErrorId::none);
}

ErrorId MC_LeadingValueAdditive::check() const noexcept {
  if (const ErrorId error = first_error(kPins, *this); error != ErrorId::none) return error;
  return Axis->enabled() || Axis->simulating() ? ErrorId::none : ErrorId::locked;
}

void MC_SynchronizedMotionSimulation::call(std::int64_t /*now*/) noexcept {
  if (Slave == nullptr) {
    InSimulation = Busy = false;
    Error = Enable;
    ErrorID = static_cast<WORD>(Enable ? ErrorId::no_technology_object : ErrorId::none);
    return;
  }
  SimulationRequest& request = Slave->simulation_request;
  if (Enable) request.owner = this;
  const bool mine = request.owner == this;
  if (mine) request.enable = Enable;
  const ErrorId error = mine ? request.error : ErrorId::none;
  InSimulation = mine && Slave->simulating();
  Error = error != ErrorId::none;
  ErrorID = static_cast<WORD>(error);
  Busy = mine && !Error && (Enable || Slave->simulating());
}

}  // namespace lockstep
