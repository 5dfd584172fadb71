// Signals of the simulated machine: digital inputs, homing switches, hardware limit switches.
#include "tech_objects/axis/axis.hpp"

namespace lockstep {

bool Axis::signals_always_watched() const noexcept {
  return data.PositionLimits_HW.Active || !drive_settings.signals.digital_inputs.empty();
}

/// Each servo cycle, while there are signals that matter.
/// @param position of the drive, from where it was at the beginning [u]
void Axis::watch_signals(const DoubleDouble& position) noexcept {
  const MachineSignals& machine = drive_settings.signals;
  const double place = (position + machine.start_position).rounded();
  for (const DigitalInput& input : machine.digital_inputs) *input.tag = input.range.contains(place, turn());
  if (data.PositionLimits_HW.Active) {
    watch_limit_switch(-1, place);
    watch_limit_switch(1, place);
    beyond_limit_switch_ = limit_switches_[0].beyond || limit_switches_[1].beyond;
  }
  if (!mark_search_.active()) return;
  on_home_switch_ = on_home_switch(place);
  mark_search_.step(place, on_home_switch_, machine.zero_marks);
}

/// Whether the reference cam, or the switch at the digital input, is active.
bool Axis::on_home_switch(double place) const noexcept {
  return home_switch(homing_.phase != HomingPhase::none).active(drive_settings.signals, place, turn());
}

// ---- Hardware limit switches
// -------------------------------------------------------------------------------------
// @source S7-1500T axis functions, traversing range limitation; alarm 531

bool Axis::limit_switch_pressed(int side, double place) const noexcept {
  const auto& limits = data.PositionLimits_HW;
  if (side < 0) {
    if (limits.MinSwitchAddress != nullptr) return *limits.MinSwitchAddress == limits.MinSwitchLevel;
    return drive_settings.signals.limit_min && place <= *drive_settings.signals.limit_min;
  }
  if (limits.MaxSwitchAddress != nullptr) return *limits.MaxSwitchAddress == limits.MaxSwitchLevel;
  return drive_settings.signals.limit_max && place >= *drive_settings.signals.limit_max;
}

/// PositionLimits_HW.Active at run time, until a restart.
ErrorId Axis::activate_limit_switches(bool active) noexcept {
  const auto& limits = data.PositionLimits_HW;
  const MachineSignals& machine = drive_settings.signals;
  const bool configured = limits.MinSwitchAddress != nullptr || limits.MaxSwitchAddress != nullptr ||
                          machine.limit_min.has_value() || machine.limit_max.has_value();
  if (!has_drive_ || !configured) return ErrorId::limit_switches_missing;
  data.PositionLimits_HW.Active = active;
  if (!active) {
    limit_switches_ = {};
    beyond_limit_switch_ = false;
  }
  signals_watched_ = signals_always_watched() || mark_search_.active();
  return ErrorId::none;
}

AlarmReaction Axis::limit_switch_reaction() const noexcept {
  const auto& limits = data.PositionLimits_HW;
  const bool keeps_enable = limits.Mode == 0 && limits.ApproachBehavior == 1;
  const bool both = limit_switches_[0].beyond && limit_switches_[1].beyond;
  const bool locked = limit_switches_[0].locked || limit_switches_[1].locked;
  return keeps_enable && !both && !locked ? AlarmReaction::stop_emergency : AlarmReaction::remove_enable;
}

/// Beyond a switch is where it is pressed, and, if it can be overrun, until the axis has come back over it.
void Axis::watch_limit_switch(int side, double place) noexcept {
  LimitSwitch& limit = limit_switches_[side > 0 ? 1 : 0];
  const bool was_pressed = limit.pressed;
  limit.pressed = limit_switch_pressed(side, place);
  if (limit.beyond) {
    const bool inside = data.PositionLimits_HW.Mode == 0 || side * (place - limit.entered) < 0.0;
    if (!limit.pressed && inside && !limit.locked) limit.beyond = false;
    return;
  }
  if (!limit.pressed || was_pressed) return;
  limit.beyond = true;
  limit.entered = place;
  if (power_state_ != PowerState::on && power_state_ != PowerState::braking) return;
  const bool retreats = side * setpoint_.velocity < 0.0;
  // A moving axis that meets a switch from the wrong side has its switches swapped: neither way is safe.
  limit.locked = retreats && moving(actual_velocity_);
  if (limit.locked || !(retreats || homing_reverses()))
    raise(alarm::kHardwareLimitSwitch, limit_switch_reaction());
}

/// Beyond a switch the axis may only come back: another setpoint ends in the alarm before anyone sees it. Not
/// so where homing turns round, or has given up there and brakes.
void Axis::hold_limit_switches() noexcept {
  if (power_state_ != PowerState::on && power_state_ != PowerState::braking) return;
  if (homing_reverses() || data.ErrorDetail.Number == alarm::kMarkNotFound) return;
  const double v = setpoint_.velocity;
  const auto forbids = [v](const LimitSwitch& limit, int side) {
    return limit.beyond && (side * v > 0.0 || (limit.locked && v != 0.0));
  };
  if (!forbids(limit_switches_[0], -1) && !forbids(limit_switches_[1], 1)) return;
  const AlarmReaction reaction = limit_switch_reaction();
  if (data.ErrorDetail.Reaction >= static_cast<DINT>(reaction)) return;  // it brakes already
  const Setpoint made = setpoint_;
  setpoint_ = last_setpoint_;
  raise(alarm::kHardwareLimitSwitch, reaction);
  if (power_state_ == PowerState::on) single_.advance(setpoint_);
  if (power_state_ == PowerState::braking) setpoint_ = made;
}

}  // namespace lockstep
