#include "tech_objects/axis/position_control.hpp"

namespace lockstep {

void PositionControlOrders::set(bool on) noexcept {
  if (!has_position_) return;
  if (on && !position_controlled_ && !hand_over_.switched() && has_drive_) {
    setpoint_.position = advanced(actual_, actual_velocity_ * setpoint_delay(), modulo_);
    last_setpoint_.position = setpoint_.position;
    begin_anew({setpoint_.position, actual_velocity_});
  }
  hand_over_.switch_position_control(on);
}

void PositionControlOrders::begin_anew(const ServoSetpoint& setpoint) noexcept {
  loop_.reset(setpoint, data.SetpointFilter.DynamicFilter);
}

double PositionControlOrders::setpoint_delay() const noexcept {
  return loop_.filter_delay(data.SetpointFilter.DynamicFilter) + control_delay();
}

double PositionControlOrders::control_delay() const noexcept {
  const auto& model = data.DynamicAxisModel;
  const double lag = model.VelocityTimeConstant + model.AdditionalPositionTimeConstant;
  return lag > 0.0 ? drive_properties_.transport_delay + lag : drive_properties_.known_delay;
}

}  // namespace lockstep
