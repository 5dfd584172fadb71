// MC_Servo of an axis with a drive: actual values, fine interpolation, position control.
#include <algorithm>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/profile/fine_interpolation.hpp"

namespace lockstep {
namespace {

/// The emergency ramp is what the drive is to do, whatever precontrol other motions have [%].
constexpr double kWholePrecontrol = 100.0;

/// By what the velocity of a motor that is given by its speed may be rounded, relative to it.
constexpr double kRounding = 1e-12;

}  // namespace

/// The encoder goes on from where it is, at the position that the axis has now.
void Axis::restart_servo() noexcept {
  take_servo_settings();
  backlash_ = {};
  begin_sensors(actual_);
  reset_servo({setpoint_.position, 0.0});
  show_execution_time();
}

/// Settings that count from the start, or a restart, on.
void Axis::take_servo_settings() noexcept {
  const bool inverted = drive_settings.inverted;
  setpoint_sign_ = data.Actor.InverseDirection != inverted ? -1.0 : 1.0;
  way_per_motor_turn_ = way_per_motor_turn();
  motor_limit_ = data.Actor.MotorType == 1 ? data.Actor.LinearMotorDriveParameter.MaxVelocity
                                           : data.Actor.DriveParameter.MaxSpeed / 60.0 * way_per_motor_turn_;
  take_sensors();
  setpoint_filter_.configure(modulo_, servo_period_);
  signals_watched_ = signals_always_watched();
  const double highest = motor_limit_ * (1.0 + kRounding);
  if (has_drive_ && data.DynamicLimits.MaxVelocity > highest) raise(alarm::kVelocityNotReachable);
}

void Axis::configure_servo() {
  encoders_ = {};
  take_servo_settings();
  drive_.configure(drive_settings, servo_period_, motor_angle_per_unit());
  controller_.configure(control_settings(), servo_period_);
  begin_sensors(setpoint_.position);
  reset_servo({setpoint_.position, 0.0});
  show_execution_time();
}

/// A setpoint is handed to the drive, at the end of the fine interpolation, one interpolator cycle later.
void Axis::show_execution_time() noexcept {
  data.StatusPositioning.SetpointExecutionTime = period_ + setpoint_delay();
}

/// By what the actual position is behind the setpoint of the servo at constant velocity [s].
double Axis::setpoint_delay() const noexcept {
  return setpoint_filter_.delay(data.SetpointFilter.DynamicFilter) + control_delay();
}

/// What the balancing filter takes the controlled side to be late by [s]: with an axis model what that says
/// of the velocity loop, else what the drive knows of itself.
double Axis::control_delay() const noexcept {
  const auto& model = data.DynamicAxisModel;
  const double lag = model.VelocityTimeConstant + model.AdditionalPositionTimeConstant;
  return lag > 0.0 ? drive_.transport_delay() + lag : drive_.known_delay();
}

PositionControlSettings Axis::control_settings() const noexcept {
  return {.kv = data.PositionControl.Kv,
          .kpc = emergency_ramp_ == EmergencyRamp::running ? kWholePrecontrol : data.PositionControl.Kpc,
          .delay = control_delay(),
          .max_velocity = motor_limit_,
          .lead = loop_in_drive() ? drive_.dead_time() : -1.0};
}

/// What the axis moves in one turn of the motor, through load gear and lead screw [u].
double Axis::way_per_motor_turn() const noexcept {
  const double load_turns =
      static_cast<double>(data.LoadGear.Denominator) / static_cast<double>(data.LoadGear.Numerator);
  if (!has_position()) {
    constexpr double kSecondsPerMinute = 60.0, kSecondsPerHour = 3600.0;
    if (data.Units.VelocityUnit == kTurnsPerSecond) return load_turns;
    return load_turns * (data.Units.VelocityUnit == kTurnsPerMinute ? kSecondsPerMinute : kSecondsPerHour);
  }
  return load_turns * (data.Properties.MotionType == 1 ? 360.0 : data.Mechanics.LeadScrew);
}

/// Of the motor in a plant [rad/u]; a linear motor moves as the axis does.
double Axis::motor_angle_per_unit() const noexcept {
  constexpr double kTurn = 6.283185307179586;
  return data.Actor.MotorType == 1 ? 1.0 : kTurn / way_per_motor_turn_;
}

/// Simulated, the axis leaves its drive alone.
void Axis::idle_servo() noexcept {
  encoder_position_ = drive_.read().position;
  drive_.write(0.0);
}

void Axis::servo() noexcept {
  if (!has_drive_) return idle_servo();
  DriveActual now = drive_.read();
  encoder_position_ = now.position;
  if (several_encoders_) read_sensors(now);
  if (now.trouble || drive_in_trouble_) watch_drive(now);
  if (signals_watched_) watch_signals(encoder_position_);
  if (encoder_sign_ < 0.0) {
    now.position = -now.position;
    now.velocity = -now.velocity;
  }
  drive_running_ = now.enabled && !now.silent;
  drive_inhibited_ = now.inhibited;
  actual_torque_ = setpoint_sign_ * now.torque;
  if (data.Actor.Interface.EnableTorqueData) data.StatusTorqueData.ActualTorque = actual_torque_;
  if (sensor_lost_)
    now.velocity = 0.0;
  else
    actual_ = advanced(encoder_origin_,
                       passes_backlash() ? now.position - DoubleDouble{backlash_.passed, 0.0} : now.position,
                       modulo_);
  data.ActualAcceleration = (now.velocity - actual_velocity_) / servo_period_;
  actual_velocity_ = now.velocity;
  data.StatusSensor[operative_].Velocity = actual_velocity_;
  show_place(operative_, actual_);
  data.ActualSpeed = actual_velocity_ / way_per_motor_turn_ * 60.0;

  ++servo_tick_;
  if (power_state_ <= PowerState::drive_stops) {
    data.VelocitySetpoint = 0.0;
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
  } else {
    control_position();
  }
  if (power_state_ > PowerState::drive_stops && position_controlled_ && loop_in_drive())
    drive_.write_position({.velocity = setpoint_sign_ * data.VelocitySetpoint,
                           .xerr = setpoint_sign_ * xerr_,
                           .kpc = data.PositionControl.Kv,
                           .pace = setpoint_sign_ * pace_,
                           .most = control_settings().max_velocity});
  else
    drive_.write(setpoint_sign_ * data.VelocitySetpoint);
}

/// The setpoint of this servo tick: between the last two interpolator results, one interpolator cycle later.
void Axis::control_position() noexcept {
  const double way = rounded_difference(setpoint_.position, last_setpoint_.position, modulo_);
  const double part = static_cast<double>(servo_tick_) / ratio_;
  const bool whole = servo_tick_ >= ratio_;
  const FineSetpoint fine = fine_setpoint(way, last_setpoint_.velocity, setpoint_.velocity, period_, part);
  AxisPosition position = whole ? setpoint_.position : advanced(last_setpoint_.position, fine.way, modulo_);
  double velocity = whole ? setpoint_.velocity : fine.velocity;
  if (!position_controlled_) {
    data.VelocitySetpoint = smoothed_switchover(velocity);
    if (!has_position()) limit_speed();
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
    return;
  }
  double filter_delay = 0.0;
  if (data.SetpointFilter.DynamicFilter.Mode == 1) {
    filter_delay = setpoint_filter_.delay(data.SetpointFilter.DynamicFilter);
    const ServoSetpoint filtered =
        setpoint_filter_.step({position, velocity}, data.SetpointFilter.DynamicFilter);
    position = filtered.position;
    velocity = filtered.velocity;
  }
  data.StatusServo.PositionAfterDynamicFilter = position.value;
  const PositionControlSettings settings = control_settings();
  data.StatusPositioning.SetpointExecutionTime = period_ + filter_delay + settings.delay;
  if (settings != controller_.settings()) tune_controller(settings);
  const double smoothed = smoothing_.behind();  // what MC_SetSensor has changed and control is not to see yet
  if (smoothed != 0.0) smoothing_.step(0.0);
  const AxisPosition seen = smoothed == 0.0 ? actual_ : advanced(actual_, -smoothed, modulo_);
  const PositionControlled controlled = controller_.step(position, velocity, seen, modulo_);
  data.VelocitySetpoint = controlled.velocity;
  if (loop_in_drive()) {  // the drive adds what the control difference asks for
    const double precontrol = 0.01 * settings.kpc * velocity;
    data.VelocitySetpoint = std::clamp(precontrol, -settings.max_velocity, settings.max_velocity);
    xerr_ = controlled.xerr;
    pace_ = velocity;
  }
  data.VelocitySetpoint = smoothed_switchover(data.VelocitySetpoint);
  if (passes_backlash()) {
    const double passing = pass_backlash();
    data.VelocitySetpoint =
        std::clamp(data.VelocitySetpoint + passing, -settings.max_velocity, settings.max_velocity);
    pace_ += passing;
  }
  data.StatusServo.BalancedPosition = controlled.balanced.value;
  data.StatusServo.ControlDifference = controlled.control_difference;
  data.StatusPositioning.FollowingError = controlled.control_difference - smoothed;
  if (data.FollowingError.AdditionalSetpointDelayTime > 0.0 || following_lag_.behind() != 0.0)
    delay_following_error(controlled);
  last_balanced_ = controlled.balanced;
  if (controlled.limited) raise(alarm::kSpeedSetpointLimited);
  if (data.FollowingError.EnableMonitoring && !position_monitoring_off()) watch_following_error(velocity);
}

/// The speed setpoint of a speed axis keeps to what its motor can do.
void Axis::limit_speed() noexcept {
  if (std::abs(data.VelocitySetpoint) <= motor_limit_) return;
  data.VelocitySetpoint = std::copysign(motor_limit_, data.VelocitySetpoint);
  raise(alarm::kSpeedSetpointLimited);
}

/// Position control begins anew from a setpoint that has moved at its velocity until now.
void Axis::reset_servo(const ServoSetpoint& setpoint) noexcept {
  setpoint_filter_.reset(setpoint, data.SetpointFilter.DynamicFilter);
  const double behind = setpoint.velocity * setpoint_filter_.delay(data.SetpointFilter.DynamicFilter);
  last_balanced_ = advanced(setpoint.position, -behind, modulo_);
  following_lag_.set_behind(0.0);
  smoothing_.set_behind(0.0);
  switchover_.set_behind(0.0);
  if (setpoint.velocity == 0.0) return controller_.reset(last_balanced_);
  controller_.reset(last_balanced_, setpoint.velocity * servo_period_, modulo_);
}

/// The following error counts against a setpoint that is delayed further.
void Axis::delay_following_error(const PositionControlled& controlled) noexcept {
  const double time = data.FollowingError.AdditionalSetpointDelayTime;
  if (time != following_lag_.time_constant()) following_lag_.tune(time, servo_period_);
  following_lag_.step(rounded_difference(controlled.balanced, last_balanced_, modulo_));
  data.StatusPositioning.FollowingError -= following_lag_.behind();
}

void Axis::shift_servo(double by) noexcept {
  forces_.clamped_at = advanced(forces_.clamped_at, by, modulo_);
  setpoint_filter_.shift(by);
  last_balanced_ = advanced(last_balanced_, by, modulo_);
  encoder_origin_ = advanced(encoder_origin_, by, modulo_);
  controller_.shift(by, modulo_);
  auto& shown = data.StatusServo;
  shown.BalancedPosition = last_balanced_.value;
  shown.PositionAfterDynamicFilter = advanced({0, shown.PositionAfterDynamicFilter}, by, modulo_).value;
}

}  // namespace lockstep
