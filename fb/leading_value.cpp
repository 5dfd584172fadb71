#include "fb/leading_value.hpp"

namespace lockstep {

void MC_LeadingValueAdditive::call(std::int64_t /*now*/) noexcept {
  ErrorId error = Enable ? first_error(kPins, *this) : ErrorId::none;
  if (Axis != nullptr) error = act_on(Axis->additive_request, error);
  Error = error != ErrorId::none;
  ErrorID = static_cast<WORD>(error);
  Busy = begun_ && !Error && Axis->additive_request.owner == this;
}

/// @param error of the inputs  @return that of the job, which begins with the first inputs that are permitted
ErrorId MC_LeadingValueAdditive::act_on(AdditiveRequest& request, ErrorId error) noexcept {
  if (!Enable) {
    if (request.owner == this) request = {};
    begun_ = false;
    return ErrorId::none;
  }
  if (!begun_ && error == ErrorId::none) {
    begun_ = true;
    request = {this, false, {}};  // the last one that begins counts
  }
  if (begun_ && request.owner != this) return ErrorId::none;  // it has been ended
  const bool locked = !Axis->enabled() && !Axis->simulating();
  if (begun_) {
    request.counts = !locked && (request.counts || error == ErrorId::none);
    if (error == ErrorId::none) request.value = {Position, Velocity, Acceleration};
  }
  return error == ErrorId::none && locked ? ErrorId::locked : error;
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
