#include "tech_objects/axis/switches.hpp"

namespace lockstep {

bool SwitchOrders::always_watched() const noexcept {
  return has_drive_ && (data.PositionLimits_HW.Active || !drive_->signals().digital_inputs.empty());
}

void SwitchOrders::renew_watch() noexcept {
  signals_watched_ = always_watched() || homing_.searching();
}

double SwitchOrders::read_inputs() noexcept {
  const MachineSignals& machine = drive_->signals();
  const double place = (encoders_.counted() + machine.start_position).rounded();
  for (const DigitalInput& input : machine.digital_inputs) *input.tag = input.range.contains(place, turn());
  return place;
}

void SwitchOrders::look_for_mark(double place) noexcept {
  if (homing_.searching()) homing_.pass(place, on_home_switch(place), drive_->signals().zero_marks);
}

// ---- Homing

HomeSwitch SwitchOrders::home_switch(bool active) const noexcept {
  const auto& sensor = data.Sensor[encoders_.operative()];
  if (active) return {sensor.ActiveHoming.DigitalInputAddress, sensor.ActiveHoming.SwitchLevel};
  return {sensor.PassiveHoming.DigitalInputAddress, sensor.PassiveHoming.SwitchLevel};
}

void SwitchOrders::search_mark(bool active, int direction) noexcept {
  const auto& sensor = data.Sensor[encoders_.operative()];
  const DINT mark = active ? sensor.ActiveHoming.Mode : sensor.PassiveHoming.Mode;
  const bool positive_side = active ? homing_.settings().positive_side : sensor.PassiveHoming.SideInput;
  homing_.search(static_cast<HomingMark>(mark), direction, positive_side, encoders_.ratio() < 0.0);
  signals_watched_ = true;
}

/// Whether the reference cam, or the switch at the digital input, is active.
bool SwitchOrders::on_home_switch(double place) const noexcept {
  return home_switch(homing_.active()).active(drive_->signals(), place, turn());
}

// ---- Hardware limit switches
// @source S7-1500T axis functions, traversing range limitation; alarm 531

/// PositionLimits_HW.Active at run time, until a restart.
ErrorId SwitchOrders::activate_limit_switches(bool active) noexcept {
  const auto& limits = data.PositionLimits_HW;
  if (!has_drive_) return ErrorId::limit_switches_missing;
  const MachineSignals& machine = drive_->signals();
  const bool configured = limits.MinSwitchAddress != nullptr || limits.MaxSwitchAddress != nullptr ||
                          machine.limit_min.has_value() || machine.limit_max.has_value();
  if (!configured) return ErrorId::limit_switches_missing;
  data.PositionLimits_HW.Active = active;
  if (!active) limit_switches_ = {};
  renew_watch();
  return ErrorId::none;
}

/// The signal of the machine counts for a switch without tag.
bool SwitchOrders::meets_limit_switch(int side, double place) noexcept {
  const auto& settings = data.PositionLimits_HW;
  const MachineSignals& machine = drive_->signals();
  const bool signal = side < 0 ? machine.limit_min && place <= *machine.limit_min
                               : machine.limit_max && place >= *machine.limit_max;
  const LimitSwitches::Approach approach{
      .place = place,
      .velocity = setpoint_.velocity,
      .controlled = power_state_ == PowerState::on || power_state_ == PowerState::braking,
      .moving = moving(actual_velocity_, data),
      .reverses = homing_reverses()};
  const bool pressed = LimitSwitches::pressed_at(side, settings, signal);
  return limit_switches_.watch(side, pressed, approach, settings);
}

}  // namespace lockstep
