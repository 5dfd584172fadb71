#include "fb/parameter.hpp"

namespace lockstep {
namespace {

constexpr DINT kLimitSwitchesActive = 1000;
constexpr DINT kFirstCommunicationTime = 1010;
constexpr DINT kLastCommunicationTime = 1012;

}  // namespace

void MC_WriteParameter::request(Job& job) const noexcept {
  job.kind = JobKind::MC_WriteParameter;
  job.asks = LimitSwitchesJob{.active = Value == 1.0};
}

void MC_WriteParameter::hand_over(Job& job) noexcept {
  if (const ErrorId error = refusal(); error != ErrorId::none) return job.fail(error);
  ExecuteBlock::hand_over(job);
}

ErrorId MC_WriteParameter::refusal() const noexcept {
  if (ParameterNumber >= kFirstCommunicationTime && ParameterNumber <= kLastCommunicationTime)
    return ErrorId::communication_times;
  if (ParameterNumber != kLimitSwitchesActive || !among(Axis->kind, kAnyAxis))
    return ErrorId::parameter_number;
  return Value == 0.0 || Value == 1.0 ? ErrorId::none : ErrorId::parameter_type;
}

void MC_SetSensor::request(Job& job) const noexcept {
  job.kind = JobKind::MC_SetSensor;
  job.asks =
      SensorJob{.sensor = Sensor, .mode = static_cast<SetSensorMode>(Mode), .reference = ReferenceSensor};
}

}  // namespace lockstep
