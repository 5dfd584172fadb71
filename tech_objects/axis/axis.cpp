#include "tech_objects/axis/axis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tech_objects/drive/drive_models.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// Below this share of VelocityThreshold an axis that is switched off rests.
constexpr double kRest = 0.01;

}  // namespace

Axis::Axis(ObjectKind object_kind, std::string object_name, DB_ANY object_number)
    : AxisOrders(object_kind, std::move(object_name), object_number) {
  drive_model = kDriveModels;
  if (!has_position()) data.Units.VelocityUnit = kTurnsPerMinute;
}

void Axis::configure(double servo_period, int ratio) {
  servo_period_ = servo_period;
  ratio_ = ratio;
  period_ = servo_period * ratio;
  start_values_ = data;
  position_controlled_ = has_position();
  take_start_values();
  setpoint_ = Setpoint{};
  setpoint_.position = normalised({0, 0.0}, modulo_);
  last_setpoint_ = setpoint_;
  actual_ = setpoint_.position;
  single_.stand(setpoint_);
  reset_leading(actual_);
  for (const LeadingValue& leading : leading_values)
    if (leading.coupling == Coupling::actual) leading.source->lead_by_actual_value();
  if (!is_virtual()) configure_servo();
  show_sensor();
  publish();
}

void AxisOrders::take_start_values() noexcept {
  const bool simulated = data.Simulation.Mode == 1 && !is_virtual();
  has_drive_ = !is_virtual() && !simulated;
  set_bit(data.StatusWord, StatusBit::AxisSimulation, simulated);
  modulo_ = {data.Modulo.Enable, data.Modulo.Length, data.Modulo.StartValue};
  // Without a position it may turn for ever.
  if (!has_position()) modulo_ = {true, 1e6, 0.0};
  single_.configure(modulo_, period_);
  superimposed_.configure(period_);
  arrival_.configure(period_);
  blending_.configure(period_);
  hand_over_.configure(period_);
  emergency_ramp_ = EmergencyRamp::none;
  const double tolerance = data.Synchronization.MasterReversionTolerance;
  synchronous_.configure(modulo_, period_, tolerance, additive_);
  awaited_.configure(modulo_, period_, tolerance, additive_);
  configure_leading(period_, data.Extrapolation);
}

// ---- Power
// ------------------------------------------------------------------------------------------------------

void AxisOrders::step_power() noexcept {
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

void AxisOrders::switch_on() noexcept {
  if (has_drive_) {
    control_drive(kControlOff);  // a drive that has stopped by itself wants to be told
    control_drive(kControlOn);
    power_state_ = PowerState::switching_on;
    return;
  }
  take_up_motion();
}

/// The position at this moment becomes the setpoint. A moving axis brakes with maximum dynamics and returns
/// to it.
void AxisOrders::take_up_motion() noexcept {
  const Setpoint seen = led_setpoint();
  const bool controlled = power.start_mode == StartMode::position_control && has_position();
  power_state_ = PowerState::on;
  motion_ = Motion::single_axis;
  const bool at_once = power.start_mode == StartMode::without_position_control ||
                       data.PositionControl.VelocityModePowerOn == 1;
  const bool ramps = moving(actual_velocity_) && !at_once;
  if (has_drive_) setpoint_ = {actual_, ramps ? actual_velocity_ : 0.0, 0.0};
  const AxisPosition here = setpoint_.position;
  if (has_drive_) reset_servo({here, 0.0});
  if (setpoint_.standing() || single_.move_to(setpoint_, here, 0.0, limits_.maximum()) != PlanResult::ok) {
    setpoint_.velocity = 0.0;
    setpoint_.acceleration = 0.0;
    single_.stand(setpoint_);
  }
  Setpoint now = setpoint_;
  if (!position_controlled_ || !controlled) now.position = seen.position;  // of which nobody knows
  hand_over(seen, now);
  lead_with_position_control(controlled);
}

void AxisOrders::begin_braking(PowerStopMode stop_mode) noexcept {
  end_all_jobs(JobPhase::aborted, ErrorId::none);
  if (has_drive_ && (stop_mode == PowerStopMode::quick_stop || stop_mode == PowerStopMode::coast_down)) {
    const bool stops = stop_mode == PowerStopMode::quick_stop && power_state_ != PowerState::switching_on;
    switch_off();
    control_drive(stop_mode == PowerStopMode::quick_stop ? kControlQuickStop : kControlCoast);
    if (stops) power_state_ = PowerState::drive_stops;
    return;
  }
  power_state_ = PowerState::braking;
  begin_stop(stop_mode == PowerStopMode::maximum_dynamics ? limits_.maximum() : limits_.emergency(), false);
  if (stop_mode != PowerStopMode::maximum_dynamics) ask_for_emergency_ramp();
}

void AxisOrders::switch_off() noexcept {
  absorb_superimposed();
  leave_synchronous();
  if (has_drive_) control_drive(kControlOff);
  power_state_ = PowerState::off;
  hand_over_.make_due(has_drive_ && motion_ != Motion::none);
  motion_ = Motion::none;
  if (!has_drive_) setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  single_.stand(setpoint_);
}

/// Switched off, the setpoint tracks the actual value. Its velocity fades to none far below the threshold of
/// the standstill signal, without a step.
void AxisOrders::follow_actual() noexcept {
  if (!has_drive_) return;
  const double speed = std::abs(actual_velocity_);
  const double faded = std::max(2.0 * speed - kRest * data.StandstillSignal.VelocityThreshold, 0.0);
  setpoint_ = {actual_, std::copysign(std::min(speed, faded), actual_velocity_), 0.0};
  if (hand_over_.due()) hand_over_to_actual();
}

/// Taken up anew, position control begins where the axis is: with the setpoint ahead by what the drive is
/// late.
void AxisOrders::set_position_control(bool on) noexcept {
  if (!has_position()) return;
  if (on && !position_controlled_ && !control_switched_ && has_drive_) {
    setpoint_.position = advanced(actual_, actual_velocity_ * setpoint_delay(), modulo_);
    last_setpoint_.position = setpoint_.position;
    reset_servo({setpoint_.position, actual_velocity_});
  }
  lead_with_position_control(on);
}

// ---- Alarms
// -----------------------------------------------------------------------------------------------------

void AxisOrders::raise(int alarm_number) noexcept {
  raise(alarm_number, static_cast<AlarmReaction>(find_alarm(alarm_number)->reaction));
}

/// For alarms whose reaction is a matter of configuration.
void AxisOrders::raise(int alarm_number, AlarmReaction reaction) noexcept {
  const Alarm* alarm = find_alarm(alarm_number);
  alarm_notes.raised(alarm_number, static_cast<int>(reaction));
  if (reaction == AlarmReaction::none) {
    set_bit(data.WarningWord, static_cast<unsigned>(alarm->warning_bit), true);
    return;
  }
  set_bit(data.ErrorWord, static_cast<unsigned>(alarm->error_bit), true);
  set_bit(data.StatusWord, StatusBit::Error, true);
  const DINT strength = static_cast<DINT>(reaction);
  if (strength <= data.ErrorDetail.Reaction) return;  // a weaker reaction changes nothing
  data.ErrorDetail.Number = static_cast<UDINT>(alarm->number);
  data.ErrorDetail.Reaction = strength;
  react(reaction);
}

void AxisOrders::react(AlarmReaction reaction) noexcept {
  Dynamics dynamics = limits_.maximum();
  if (reaction == AlarmReaction::stop_current) dynamics = single_.dynamics();
  if (reaction == AlarmReaction::stop_emergency) dynamics = limits_.emergency();
  if (jobs_.stops_harder_than(reaction))
    return end_simulated_gear(JobPhase::failed, ErrorId::technology_alarm);
  end_all_jobs(JobPhase::failed, ErrorId::technology_alarm);
  end_simulated_gear(JobPhase::failed, ErrorId::technology_alarm);
  if (reaction == AlarmReaction::remove_enable || reaction == AlarmReaction::track_setpoints) {
    enable_removed_ = true;
    if (power_state_ == PowerState::off) return;
    // The drive stops by its own ramp; a virtual axis, which has none, takes the emergency ramp.
    begin_braking(PowerStopMode::quick_stop);
    return;
  }
  if (power_state_ != PowerState::on) return;
  begin_stop(dynamics, false);
  if (reaction == AlarmReaction::stop_emergency) ask_for_emergency_ramp();
}

ErrorId AxisOrders::reset(bool restart) noexcept {
  // An alarm may have removed the enable; while MC_Power still asks for it the axis is not disabled.
  if (restart && (power.enable || power_state_ != PowerState::off)) {
    raise(alarm::kRestartNotCarriedOut);
    return ErrorId::restart_refused;
  }
  data.ErrorWord = DWORD{};
  data.WarningWord = DWORD{};
  data.ErrorDetail = {};
  alarm_notes.acknowledged();
  enable_removed_ = false;
  if (restart) this->restart();
  if (has_drive_ && (encoders_.lost() || drive_->in_trouble())) acknowledge_drive();
  return ErrorId::none;
}

/// The start values count from now on. The axis is where it was, on a ring of its own perhaps.
void AxisOrders::restart() noexcept {
  end_all_jobs(JobPhase::aborted, ErrorId::none);
  jobs_.unlock();
  end_simulated_gear(JobPhase::aborted, ErrorId::none);
  additive_request = {};
  data = start_values_;
  drive_shown_ = kNothingShown;
  start_values_changed = false;
  homed_ = false;
  position_controlled_ = has_position();
  take_start_values();
  setpoint_ = {normalised({0, setpoint_.position.value}, modulo_), 0.0, 0.0};
  last_setpoint_ = setpoint_;
  actual_ = normalised({0, actual_.value}, modulo_);
  single_.stand(setpoint_);
  reset_leading(actual_);
  counted_from_ = 0;
  limit_switches_ = {};
  free_bits_ = {};
  if (!is_virtual()) restart_servo();
  show_sensor();
  restarted = true;
  ++restarts_;
  coupling_changed = true;
}

void Axis::watch_leading_object() noexcept {
  const Job* const waiting = jobs_[kWaiting];
  const auto lost = [](const LeadingObject& leading) {
    return leading.restarted || !leading.actual_values_valid();
  };
  const bool led_by_lost = (led() || simulating()) && lost(*coupled_.leading);
  if (led_by_lost || (waiting != nullptr && lost(*master_of(*waiting)))) raise(alarm::kLeadingAxis);
}

// ---- One interpolator cycle
// -------------------------------------------------------------------------------------

void Axis::step() noexcept {
  last_setpoint_ = setpoint_;
  servo_tick_ = 0;
  if (has_drive_) step_forces();
  if (power_state_ != PowerState::on || !power.enable) step_power();
  if (additive_request.counts || additive_.in_use) take_additive();
  if (simulation_request.owner != nullptr) watch_simulation();
  if (jobs_[kWaiting] != nullptr) watch_waiting();
  if (emergency_ramp_ != EmergencyRamp::none) step_emergency_ramp();
  if (superimposed_.in_use())
    step_superimposed();
  else
    step_base();
  if (data.PositionLimits_SW.Active) {
    watch_position_limits();
  } else {
    software_limits_.release();
  }
  if (has_drive_ && limit_switches_.beyond_any()) hold_limit_switches();
  guard();
  if (handing_over_) step_hand_over();
  control_switched_ = false;
  if (!has_drive_) {
    // A virtual axis is where its setpoint is, in the same tick. Written part by part, as they have just been
    // computed: copied as a whole they would have to reach memory first.
    actual_.turns = setpoint_.position.turns;
    actual_.value = setpoint_.position.value;
    actual_velocity_ = setpoint_.velocity;
  }
  if (leads_by_actual_value()) extrapolate(actual_, actual_velocity_, data.Extrapolation);
}

/// The base motion: of the axis' own, or led by another axis.
void AxisOrders::step_base() noexcept {
  if (homing_now_) step_homing();
  switch (motion_) {
    case Motion::none:
      follow_actual();
      break;
    case Motion::single_axis:
      step_single_axis();
      break;
    case Motion::given:
      step_given();
      break;
    case Motion::synchronizing:
    case Motion::synchronous:
    case Motion::desynchronizing:
      step_synchronous();
      break;
  }
}

/// Last look at the setpoint before anyone sees it: finite, and within the range of positions.
void AxisOrders::guard() noexcept {
  const bool finite = std::isfinite(setpoint_.position.value) && std::isfinite(setpoint_.velocity) &&
                      std::isfinite(setpoint_.acceleration);
  if (finite && far_from_end_of_range()) return;
  if (finite) return watch_range();
  absorb_superimposed();
  setpoint_ = {last_setpoint_.position, 0.0, 0.0};
  single_.stand(setpoint_);
  raise(alarm::kInternal);
}

namespace {

/// The axis that an object is; nullptr for others, which depend on nothing.
Axis* as_axis(LeadingObject* leading) noexcept {
  return leading != nullptr && among(leading->kind, kAnyAxis) ? static_cast<Axis*>(leading) : nullptr;
}

}  // namespace

Axis* Axis::coupled_leading_axis() const noexcept {
  return led() || simulating() ? as_axis(coupled_.leading) : nullptr;
}

Axis* Axis::awaited_leading_axis() const noexcept {
  return jobs_[kWaiting] != nullptr ? as_axis(master_of(*jobs_[kWaiting])) : nullptr;
}

}  // namespace lockstep
