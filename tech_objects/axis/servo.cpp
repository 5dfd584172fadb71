// MC_Servo of an axis with a drive: actual values, fine interpolation, position control.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/profile/fine_interpolation.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// The emergency ramp is what the drive is to do, whatever precontrol other motions have [%].
constexpr double kWholePrecontrol = 100.0;

/// By what the velocity of a motor that is given by its speed may be rounded, relative to it.
constexpr double kRounding = 1e-12;

}  // namespace

/// The encoder goes on from where it is, at the position that the axis has now.
void AxisOrders::restart_servo() noexcept {
  take_servo_settings();
  signals_watched_ = signals_always_watched();
  backlash_ = {};
  begin_encoders(actual_);
  reset_servo({setpoint_.position, 0.0});
  show_execution_time();
}

/// Settings that count from the start, or a restart, on.
void AxisOrders::take_servo_settings() noexcept {
  const bool inverted = drive_settings.inverted;
  setpoint_sign_ = data.Actor.InverseDirection != inverted ? -1.0 : 1.0;
  way_per_motor_turn_ = way_per_motor_turn();
  motor_limit_ = data.Actor.MotorType == MotorType::linear
                     ? data.Actor.LinearMotorDriveParameter.MaxVelocity
                     : data.Actor.DriveParameter.MaxSpeed / 60.0 * way_per_motor_turn_;
  encoders_.configure(data, drive_settings, has_drive_, modulo_, servo_period_);
  loop_.configure(modulo_, servo_period_);
  const double highest = motor_limit_ * (1.0 + kRounding);
  if (has_drive_ && data.DynamicLimits.MaxVelocity > highest) raise(alarm::kVelocityNotReachable);
}

void AxisOrders::configure_servo() {
  encoders_ = {};
  take_servo_settings();
  drive_ = drive_model->make();
  drive_properties_ = drive_->configure(drive_settings, servo_period_, motor_angle_per_unit());
  signals_watched_ = signals_always_watched();
  loop_.configure_controller(control_settings());
  begin_encoders(setpoint_.position);
  reset_servo({setpoint_.position, 0.0});
  show_execution_time();
}

/// A setpoint is handed to the drive, at the end of the fine interpolation, one interpolator cycle later.
void AxisOrders::show_execution_time() noexcept {
  data.StatusPositioning.SetpointExecutionTime = period_ + setpoint_delay();
}

/// By what the actual position is behind the setpoint of the servo at constant velocity [s].
double AxisOrders::setpoint_delay() const noexcept {
  return loop_.filter_delay(data.SetpointFilter.DynamicFilter) + control_delay();
}

/// What the balancing filter takes the controlled side to be late by [s]: with an axis model what that says
/// of the velocity loop, else what the drive knows of itself.
double AxisOrders::control_delay() const noexcept {
  const auto& model = data.DynamicAxisModel;
  const double lag = model.VelocityTimeConstant + model.AdditionalPositionTimeConstant;
  return lag > 0.0 ? drive_properties_.transport_delay + lag : drive_properties_.known_delay;
}

PositionControlSettings AxisOrders::control_settings() const noexcept {
  return {.kv = data.PositionControl.Kv,
          .kpc = emergency_ramp_ == EmergencyRamp::running ? kWholePrecontrol : data.PositionControl.Kpc,
          .delay = control_delay(),
          .max_velocity = motor_limit_,
          .lead = loop_in_drive() ? drive_properties_.dead_time : -1.0};
}

/// What the axis moves in one turn of the motor, through load gear and lead screw [u].
double AxisOrders::way_per_motor_turn() const noexcept {
  const double load_turns =
      static_cast<double>(data.LoadGear.Denominator) / static_cast<double>(data.LoadGear.Numerator);
  if (!has_position()) {
    constexpr double kSecondsPerMinute = 60.0, kSecondsPerHour = 3600.0;
    if (data.Units.VelocityUnit == kTurnsPerSecond) return load_turns;
    return load_turns * (data.Units.VelocityUnit == kTurnsPerMinute ? kSecondsPerMinute : kSecondsPerHour);
  }
  return load_turns * (data.Properties.MotionType == MotionType::rotary ? 360.0 : data.Mechanics.LeadScrew);
}

/// Of the motor in a plant [rad/u]; a linear motor moves as the axis does.
double AxisOrders::motor_angle_per_unit() const noexcept {
  constexpr double kTurn = 6.283185307179586;
  return data.Actor.MotorType == MotorType::linear ? 1.0 : kTurn / way_per_motor_turn_;
}

/// Simulated, the axis leaves its drive alone.
void AxisOrders::idle_servo() noexcept {
  encoders_.count(drive_->read().position);
  drive_->write(0.0);
}

void Axis::servo(std::int64_t /*now*/) noexcept {
  if (!has_drive_) return idle_servo();
  read_drive();
  ++servo_tick_;
  PositionLoop::Output controlled;
  if (power_state_ <= PowerState::drive_stops) {
    data.VelocitySetpoint = 0.0;
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
  } else {
    controlled = control_position();
  }
  if (power_state_ > PowerState::drive_stops && position_controlled_ && loop_in_drive())
    drive_->write_position({.velocity = setpoint_sign_ * data.VelocitySetpoint,
                            .xerr = setpoint_sign_ * controlled.xerr,
                            .kpc = data.PositionControl.Kv,
                            .pace = setpoint_sign_ * controlled.pace,
                            .most = motor_limit_});
  else
    drive_->write(setpoint_sign_ * data.VelocitySetpoint);
}

/// Actual values of this tick.
void AxisOrders::read_drive() noexcept {
  DriveActual now = drive_->read();
  encoders_.count(now.position);
  if (encoders_.several()) read_encoders(now);
  if (now.trouble || drive_in_trouble_) watch_drive(now);
  if (signals_watched_) watch_signals(encoders_.counted());
  encoders_.orient(now);
  drive_running_ = now.enabled && !now.silent;
  drive_inhibited_ = now.inhibited;
  actual_torque_ = setpoint_sign_ * now.torque;
  if (data.Actor.Interface.EnableTorqueData) data.StatusTorqueData.ActualTorque = actual_torque_;
  if (encoders_.lost())
    now.velocity = 0.0;
  else
    actual_ =
        encoders_.position_at(passes_backlash() ? now.position - DoubleDouble{play(), 0.0} : now.position);
  data.ActualAcceleration = (now.velocity - actual_velocity_) / servo_period_;
  actual_velocity_ = now.velocity;
  data.StatusSensor[encoders_.operative()].Velocity = actual_velocity_;
  show_place(encoders_.operative(), actual_);
  data.ActualSpeed = actual_velocity_ / way_per_motor_turn_ * 60.0;
}

/// The setpoint of this servo tick: between the last two interpolator results, one interpolator cycle later.
ServoSetpoint AxisOrders::fine_setpoint_now() const noexcept {
  if (servo_tick_ >= ratio_) return {setpoint_.position, setpoint_.velocity};
  const double way = rounded_difference(setpoint_.position, last_setpoint_.position, modulo_);
  const double part = static_cast<double>(servo_tick_) / ratio_;
  const FineSetpoint fine = fine_setpoint(way, last_setpoint_.velocity, setpoint_.velocity, period_, part);
  return {advanced(last_setpoint_.position, fine.way, modulo_), fine.velocity};
}

PositionLoop::Output AxisOrders::control_position() noexcept {
  const ServoSetpoint setpoint = fine_setpoint_now();
  if (!position_controlled_) {
    data.VelocitySetpoint = loop_.switched_over(setpoint.velocity, motor_limit_);
    if (!has_position()) limit_speed();
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
    return {};
  }
  PositionLoop::Input input{.setpoint = setpoint, .actual = actual_, .in_drive = loop_in_drive()};
  if (passes_backlash()) {
    input.passes = true;
    input.passing = backlash_.pass(data.Sensor[0].Backlash, setpoint_.velocity, servo_period_);
    set_bit(data.StatusWord2, Status2Bit::PassingBacklash, backlash_.passing());
  }
  const PositionControlSettings settings = control_settings();
  const PositionLoop::Output output = loop_.step(input, settings, data);
  data.VelocitySetpoint = output.velocity;
  data.StatusPositioning.SetpointExecutionTime = period_ + output.filter_delay + settings.delay;
  data.StatusPositioning.FollowingError = output.following_error;
  data.StatusServo.PositionAfterDynamicFilter = output.filtered;
  data.StatusServo.BalancedPosition = output.balanced;
  data.StatusServo.ControlDifference = output.difference;
  if (output.limited) raise(alarm::kSpeedSetpointLimited);
  if (data.FollowingError.EnableMonitoring && !position_monitoring_off())
    watch_following_error(output.controlled.velocity);
  return output;
}

/// @param velocity setpoint before the position controller [u/s]
void AxisOrders::watch_following_error(double velocity) noexcept {
  const double error = std::abs(data.StatusPositioning.FollowingError);
  switch (PositionLoop::level_of(error, velocity, data.DynamicLimits.MaxVelocity, data.FollowingError)) {
    case PositionLoop::FollowingErrorLevel::permitted:
      break;
    case PositionLoop::FollowingErrorLevel::warning:
      raise(alarm::kFollowingErrorWarning);
      break;
    case PositionLoop::FollowingErrorLevel::exceeded:
      raise(alarm::kFollowingError);
      break;
  }
}

/// The speed setpoint of a speed axis keeps to what its motor can do.
void AxisOrders::limit_speed() noexcept {
  if (std::abs(data.VelocitySetpoint) <= motor_limit_) return;
  data.VelocitySetpoint = std::copysign(motor_limit_, data.VelocitySetpoint);
  raise(alarm::kSpeedSetpointLimited);
}

/// Position control begins anew from a setpoint that has moved at its velocity until now.
void AxisOrders::reset_servo(const ServoSetpoint& setpoint) noexcept {
  loop_.reset(setpoint, data.SetpointFilter.DynamicFilter);
}

void AxisOrders::shift_servo(double by) noexcept {
  clamping_.shift(by, modulo_);
  encoders_.shift(by);
  loop_.shift(by);
  auto& shown = data.StatusServo;
  shown.BalancedPosition = loop_.balanced().value;
  shown.PositionAfterDynamicFilter = advanced({0, shown.PositionAfterDynamicFilter}, by, modulo_).value;
}

}  // namespace lockstep
