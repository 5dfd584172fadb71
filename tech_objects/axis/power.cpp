#include "tech_objects/axis/power.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Below this share of VelocityThreshold an axis that is switched off rests.
constexpr double kRest = 0.01;

}  // namespace

void PowerOrders::step() noexcept {
  switch (power_state_) {
    case PowerState::off:
      if (power.enable && !enable_removed_) switch_on();
      break;
    case PowerState::switching_on:
      if (drive_running_) {
        take_up_motion();
      } else if (!power.enable) {
        switch_off();
      } else if (drive_inhibited_) {
        switch_on();  // it has stopped by itself meanwhile
      }
      break;
    case PowerState::on:
      if (!power.enable) begin_braking(power.stop_mode);
      break;
    case PowerState::braking:
      if (single_.finished()) switch_off();
      break;
    case PowerState::drive_stops:
      if (drive_inhibited_ || drive_in_trouble_) power_state_ = PowerState::off;
      break;
  }
}

void PowerOrders::switch_on() noexcept {
  if (has_drive_) {
    drive_control_.send(kControlOff);  // a drive that has stopped by itself wants to be told
    drive_control_.send(kControlOn);
    power_state_ = PowerState::switching_on;
    return;
  }
  take_up_motion();
}

/// The position at this moment becomes the setpoint. A moving axis brakes with maximum dynamics and returns
/// to it.
void PowerOrders::take_up_motion() noexcept {
  const Setpoint seen = hand_over_.led_setpoint();
  const bool controlled = power.start_mode == StartMode::position_control && has_position_;
  power_state_ = PowerState::on;
  motion_ = AxisMotion::single_axis;
  const bool at_once = power.start_mode == StartMode::without_position_control ||
                       data.PositionControl.VelocityModePowerOn == VelocityModePowerOn::at_once;
  const bool ramps = moving(actual_velocity_, data) && !at_once;
  if (has_drive_) setpoint_ = {actual_, ramps ? actual_velocity_ : 0.0, 0.0};
  const AxisPosition here = setpoint_.position;
  if (has_drive_) position_control_.begin_anew({here, 0.0});
  if (setpoint_.standing() || single_.move_to(setpoint_, here, 0.0, limits_.maximum()) != PlanResult::ok) {
    stops_.stand();
  }
  Setpoint now = setpoint_;
  if (!position_controlled_ || !controlled) now.position = seen.position;  // of which nobody knows
  hand_over_.begin(seen, now);
  hand_over_.switch_position_control(controlled);
}

void PowerOrders::begin_braking(PowerStopMode stop_mode) noexcept {
  ends_.end_all(JobPhase::aborted, ErrorId::none, AbortedBy::disabling);
  if (has_drive_ && (stop_mode == PowerStopMode::quick_stop || stop_mode == PowerStopMode::coast_down)) {
    const bool stops = stop_mode == PowerStopMode::quick_stop && power_state_ != PowerState::switching_on;
    switch_off();
    drive_control_.send(stop_mode == PowerStopMode::quick_stop ? kControlQuickStop : kControlCoast);
    if (stops) power_state_ = PowerState::drive_stops;
    return;
  }
  power_state_ = PowerState::braking;
  stops_.begin(stop_mode == PowerStopMode::maximum_dynamics ? limits_.maximum() : limits_.emergency(), false);
  if (stop_mode != PowerStopMode::maximum_dynamics) ask_for_emergency_ramp();
}

void PowerOrders::switch_off() noexcept {
  stops_.absorb_superimposed();
  coupling_.leave();
  if (has_drive_) drive_control_.send(kControlOff);
  power_state_ = PowerState::off;
  hand_over_.make_due(has_drive_ && motion_ != AxisMotion::none);
  motion_ = AxisMotion::none;
  if (!has_drive_) setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  single_.stand(setpoint_);
}

void PowerOrders::follow_actual() noexcept {
  if (!has_drive_) return;
  const double speed = std::abs(actual_velocity_);
  const double faded = std::max(2.0 * speed - kRest * data.StandstillSignal.VelocityThreshold, 0.0);
  setpoint_ = {actual_, std::copysign(std::min(speed, faded), actual_velocity_), 0.0};
  if (hand_over_.due()) hand_over_.to_actual();
}

}  // namespace lockstep
