#include "fb/parameter.hpp"

namespace lockstep {
namespace {

constexpr DINT kLimitSwitchesActive = 1000;
constexpr DINT kFirstCommunicationTime = 1010;
constexpr DINT kLastCommunicationTime = 1012;

}  // namespace

void MC_WriteParameter::hand_over(Job& job) noexcept {
  if (const ErrorId error = write(); error != ErrorId::none) return job.fail(error);
  job.phase = JobPhase::done;
}

ErrorId MC_WriteParameter::write() const noexcept {
  if (ParameterNumber >= kFirstCommunicationTime && ParameterNumber <= kLastCommunicationTime)
    return ErrorId::communication_times;
  if (ParameterNumber != kLimitSwitchesActive || !among(Axis->kind, kAnyAxis))
    return ErrorId::parameter_number;
  if (Value != 0.0 && Value != 1.0) return ErrorId::parameter_type;
  return static_cast<lockstep::Axis*>(Axis)->activate_limit_switches(Value == 1.0);
}

void MC_SetSensor::hand_over(Job& job) noexcept {
  const ErrorId error = Axis->set_sensor(Sensor, Mode, ReferenceSensor);
  if (error != ErrorId::none) return job.fail(error);
  job.phase = JobPhase::done;
}

}  // namespace lockstep
