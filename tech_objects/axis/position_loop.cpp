#include "tech_objects/axis/position_loop.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/types/published.hpp"

namespace lockstep {

void PositionLoop::configure(const Modulo& modulo, double cycle) noexcept {
  modulo_ = modulo;
  cycle_ = cycle;
  filter_.configure(modulo, cycle);
}

void PositionLoop::reset(const ServoSetpoint& setpoint, const TO_Struct_DynamicFilter& filter) noexcept {
  filter_.reset(setpoint, filter);
  balanced_ = advanced(setpoint.position, -(setpoint.velocity * filter_.delay(filter)), modulo_);
  following_lag_.set_behind(0.0);
  smoothing_.set_behind(0.0);
  switchover_.set_behind(0.0);
  if (setpoint.velocity == 0.0) return controller_.reset(balanced_);
  controller_.reset(balanced_, setpoint.velocity * cycle_, modulo_);
}

void PositionLoop::shift(double by) noexcept {
  filter_.shift(by);
  balanced_ = advanced(balanced_, by, modulo_);
  controller_.shift(by, modulo_);
}

PositionLoop::Output PositionLoop::step(const Input& input, const PositionControlSettings& control,
                                        const AxisData& data) noexcept {
  Output output{.controlled = input.setpoint};
  const TO_Struct_DynamicFilter& filter = data.SetpointFilter.DynamicFilter;
  if (filter.Mode == DynamicFilterMode::filter_and_dead_time) {
    output.filter_delay = filter_.delay(filter);
    output.controlled = filter_.step(input.setpoint, filter);
  }
  const auto& [position, velocity] = output.controlled;
  output.filtered = position.value;
  if (control != controller_.settings())
    tune(control, data.StatusServo.ControlDifference, data.PositionControl.SmoothingTimeByChangeDifference);
  const double smoothed = smoothing_.behind();  // what MC_SetSensor has changed and control is not to see yet
  if (smoothed != 0.0) smoothing_.step(0.0);
  const AxisPosition seen = smoothed == 0.0 ? input.actual : advanced(input.actual, -smoothed, modulo_);
  const PositionControlled controlled = controller_.step(position, velocity, seen, modulo_);
  const double maximum = control.max_velocity;
  output.velocity = controlled.velocity;
  if (input.in_drive) {  // the drive adds what the control difference asks for
    output.velocity = std::clamp(0.01 * control.kpc * velocity, -maximum, maximum);
    output.xerr = controlled.xerr;
    output.pace = velocity;
  }
  output.velocity = switched_over(output.velocity, maximum);
  if (input.passes) {
    output.velocity = std::clamp(output.velocity + input.passing, -maximum, maximum);
    output.pace += input.passing;
  }
  output.balanced = controlled.balanced.value;
  output.difference = controlled.control_difference;
  output.following_error = controlled.control_difference - smoothed;
  output.limited = controlled.limited;
  const double time = data.FollowingError.AdditionalSetpointDelayTime;
  if (time > 0.0 || following_lag_.behind() != 0.0)
    output.following_error -= delayed_error(controlled.balanced, time);
  balanced_ = controlled.balanced;
  return output;
}

/// By what the following error is less, counted against a setpoint that is delayed further [u].
double PositionLoop::delayed_error(AxisPosition balanced, double time) noexcept {
  if (time != following_lag_.time_constant()) following_lag_.tune(time, cycle_);
  following_lag_.step(rounded_difference(balanced, balanced_, modulo_));
  return following_lag_.behind();
}

/// Another Kv asks for another velocity at the control difference at hand: a switchover as well.
void PositionLoop::tune(const PositionControlSettings& control, double difference, double time) noexcept {
  const double change = (control.kv - controller_.settings().kv) * difference;
  if (time > 0.0 && change != 0.0) switch_over(switchover_.behind() + change, time);
  configure_controller(control);
}

// ---- Steps that are smoothed
// -----------------------------------------------------------------------------------------

void PositionLoop::deviate(double by, double time) noexcept {
  if (time <= 0.0) return smoothing_.set_behind(0.0);
  smoothing_.tune(time, cycle_);
  smoothing_.set_behind(smoothing_.behind() + by);
}

void PositionLoop::switch_over(double change, double time) noexcept {
  if (time <= 0.0) return;
  switchover_.tune(time, cycle_);
  switchover_.set_behind(change);
}

double PositionLoop::switched_over(double velocity, double limit) noexcept {
  if (switchover_.behind() == 0.0) return velocity;
  switchover_.step(0.0);
  return std::clamp(velocity - switchover_.behind(), -limit, limit);
}

// ---- Following error
// ----------------------------------------------------------------------------------------------

double PositionLoop::permissible_error(double velocity, double maximum,
                                       const TO_Struct_FollowingError& monitoring) noexcept {
  const double above = std::abs(velocity) - monitoring.MinVelocity;
  if (above <= 0.0) return monitoring.MinValue;
  const double span = maximum - monitoring.MinVelocity;
  if (above >= span) return monitoring.MaxValue;
  return monitoring.MinValue + (monitoring.MaxValue - monitoring.MinValue) * (above / span);
}

PositionLoop::FollowingErrorLevel PositionLoop::level_of(
    double error, double velocity, double maximum, const TO_Struct_FollowingError& monitoring) noexcept {
  const double warning = 0.01 * monitoring.WarningLevel;
  if (error < warning * std::min(monitoring.MinValue, monitoring.MaxValue))
    return FollowingErrorLevel::permitted;
  const double permissible = permissible_error(velocity, maximum, monitoring);
  if (error > permissible) return FollowingErrorLevel::exceeded;
  return error > warning * permissible ? FollowingErrorLevel::warning : FollowingErrorLevel::permitted;
}

}  // namespace lockstep
