#include "tech_objects/axis/emergency.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/axis/rounding.hpp"
#include "tech_objects/axis/software_limits.hpp"

namespace lockstep {
void EmergencyOrders::step() noexcept {
  if (emergency_ramp_ == EmergencyRamp::due) return brake_from_actual();
  if (motion_ != AxisMotion::single_axis || setpoint_.standing()) emergency_ramp_ = EmergencyRamp::none;
}

/// The setpoint becomes the actual state and brakes from there; no following error is worked off any more. At
/// a fixed stop it stays: what holds the part is the following error. An axis that rests in its positioning
/// window has nothing to brake.
void EmergencyOrders::brake_from_actual() noexcept {
  emergency_ramp_ = EmergencyRamp::none;
  const bool stops = motion_ == AxisMotion::single_axis && single_.aim() == SingleAxisMotion::Aim::stand;
  if (!stops || encoders_.lost() || clamping_.found()) return;
  const double away = position_controlled_ ? rounded_difference(actual_, setpoint_.position, modulo_) : 0.0;
  const bool rests = setpoint_.standing() && !moving(actual_velocity_, data);
  if (rests && std::abs(away) <= data.PositioningMonitoring.Window) return;
  const Setpoint seen = hand_over_.led_setpoint();
  const double commanded = commanded_velocity();
  take_actual_state(commanded);
  if (single_.stop(setpoint_, limits_.emergency(), false) != PlanResult::ok) {
    setpoint_.velocity = 0.0;  // no ramp can be planned from such a state: stand
    single_.stand(setpoint_);
  }
  emergency_ramp_ = EmergencyRamp::running;
  loop_.switch_over(setpoint_.velocity - commanded, data.PositionControl.SmoothingTimeByChangeDifference);
  hand_over_.begin(seen, setpoint_);
}

/// Under position control ahead by what filter and drive are late: there the drive still runs on to. One that
/// brakes already is told of no higher velocity than it has been.
void EmergencyOrders::take_actual_state(double commanded) noexcept {
  const Setpoint before = setpoint_;
  const double velocity = std::clamp(actual_velocity_, std::min(commanded, 0.0), std::max(commanded, 0.0));
  setpoint_ = {before.position, velocity, 0.0};
  if (position_controlled_) {
    setpoint_.position = advanced(actual_, actual_velocity_ * position_control_.setpoint_delay(), modulo_);
    if (data.PositionLimits_SW.Active && homed_) stay_within_limits(before);
    position_control_.begin_anew({setpoint_.position, actual_velocity_});
  }
  last_setpoint_ = setpoint_;
}

/// Where the setpoint could stop in front of a software limit switch, so can the actual state, though it may
/// be a little ahead or faster: what is missing remains as following error.
void EmergencyOrders::stay_within_limits(const Setpoint& before) noexcept {
  const double deceleration = std::max(limits_.maximum().deceleration, limits_.emergency().deceleration);
  const auto margin = [&](const Setpoint& from, int side, double limit) {
    const double v = std::max(side * from.velocity, 0.0);
    const AxisPosition border{before.position.turns, limit};
    return side * rounded_difference(border, from.position, modulo_) - v * v / (2.0 * deceleration);
  };
  const SoftwareLimits::Range range = SoftwareLimits::in_effect(data.PositionLimits_SW, modulo_);
  for (const int side : {1, -1}) {
    const double limit = side > 0 ? range.maximum : range.minimum;
    if (!std::isfinite(limit) || margin(before, side, limit) < -kRelativeRounding * (1.0 + std::abs(limit)))
      continue;
    const double missing = -margin(setpoint_, side, limit);
    if (missing > 0.0) setpoint_.position = advanced(setpoint_.position, -side * missing, modulo_);
  }
}

// ---- The drive

/// What the drive has been told last, by axis and position loop together [u/s].
double EmergencyOrders::commanded_velocity() const noexcept {
  if (!position_controlled_ || !position_control_.loop_in_drive()) return data.VelocitySetpoint;
  return data.VelocitySetpoint + data.PositionControl.Kv * data.StatusServo.ControlDifference;
}

}  // namespace lockstep
