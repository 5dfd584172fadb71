// Signals of the simulated machine: digital inputs, homing switches, hardware limit switches.
#include "tech_objects/axis/axis.hpp"

namespace lockstep {

bool AxisOrders::signals_always_watched() const noexcept {
  return has_drive_ && (data.PositionLimits_HW.Active || !drive_->signals().digital_inputs.empty());
}

/// Each servo cycle, while there are signals that matter.
/// @param position of the drive, from where it was at the beginning [u]
void AxisOrders::watch_signals(const DoubleDouble& position) noexcept {
  const MachineSignals& machine = drive_->signals();
  const double place = (position + machine.start_position).rounded();
  for (const DigitalInput& input : machine.digital_inputs) *input.tag = input.range.contains(place, turn());
  if (data.PositionLimits_HW.Active) {
    watch_limit_switch(-1, place, machine.limit_min && place <= *machine.limit_min);
    watch_limit_switch(1, place, machine.limit_max && place >= *machine.limit_max);
  }
  if (homing_.searching()) homing_.pass(place, on_home_switch(place), machine.zero_marks);
}

/// Whether the reference cam, or the switch at the digital input, is active.
bool AxisOrders::on_home_switch(double place) const noexcept {
  return home_switch(homing_.active()).active(drive_->signals(), place, turn());
}

// ---- Hardware limit switches
// -------------------------------------------------------------------------------------
// @source S7-1500T axis functions, traversing range limitation; alarm 531

/// PositionLimits_HW.Active at run time, until a restart.
ErrorId Axis::activate_limit_switches(bool active) noexcept {
  const auto& limits = data.PositionLimits_HW;
  if (!has_drive_) return ErrorId::limit_switches_missing;
  const MachineSignals& machine = drive_->signals();
  const bool configured = limits.MinSwitchAddress != nullptr || limits.MaxSwitchAddress != nullptr ||
                          machine.limit_min.has_value() || machine.limit_max.has_value();
  if (!configured) return ErrorId::limit_switches_missing;
  data.PositionLimits_HW.Active = active;
  if (!active) limit_switches_ = {};
  signals_watched_ = signals_always_watched() || homing_.searching();
  return ErrorId::none;
}

/// @param signal of the machine: counts for a switch without tag
void AxisOrders::watch_limit_switch(int side, double place, bool signal) noexcept {
  const auto& settings = data.PositionLimits_HW;
  const LimitSwitches::Approach approach{
      .place = place,
      .velocity = setpoint_.velocity,
      .controlled = power_state_ == PowerState::on || power_state_ == PowerState::braking,
      .moving = moving(actual_velocity_),
      .reverses = homing_reverses()};
  const bool pressed = LimitSwitches::pressed_at(side, settings, signal);
  if (limit_switches_.watch(side, pressed, approach, settings))
    raise(alarm::kHardwareLimitSwitch, limit_switches_.reaction(settings));
}

/// Beyond a switch the axis may only come back: another setpoint ends in the alarm before anyone sees it. Not
/// so where homing turns round, or has given up there and brakes.
void AxisOrders::hold_limit_switches() noexcept {
  if (power_state_ != PowerState::on && power_state_ != PowerState::braking) return;
  if (homing_reverses() || data.ErrorDetail.Number == alarm::kMarkNotFound) return;
  if (!limit_switches_.forbid(setpoint_.velocity)) return;
  const AlarmReaction reaction = limit_switches_.reaction(data.PositionLimits_HW);
  if (data.ErrorDetail.Reaction >= static_cast<DINT>(reaction)) return;  // it brakes already
  const Setpoint made = setpoint_;
  setpoint_ = last_setpoint_;
  raise(alarm::kHardwareLimitSwitch, reaction);
  if (power_state_ == PowerState::on) single_.advance(setpoint_);
  if (power_state_ == PowerState::braking) setpoint_ = made;
}

}  // namespace lockstep
