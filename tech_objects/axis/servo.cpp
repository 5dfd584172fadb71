#include "tech_objects/axis/servo.hpp"

#include <cmath>

#include "tech_objects/axis/rounding.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/profile/fine_interpolation.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// The emergency ramp is what the drive is to do, whatever precontrol other motions have [%].
constexpr double kWholePrecontrol = 100.0;

}  // namespace

void ServoOrders::take_settings() noexcept {
  const bool inverted = drive_settings.inverted;
  setpoint_sign_ = data.Actor.InverseDirection != inverted ? -1.0 : 1.0;
  distance_per_motor_turn_ = distance_per_motor_turn();
  motor_limit_ = data.Actor.MotorType == MotorType::linear
                     ? data.Actor.LinearMotorDriveParameter.MaxVelocity
                     : data.Actor.DriveParameter.MaxSpeed / 60.0 * distance_per_motor_turn_;
  encoders_.configure(data, drive_settings, has_drive_, modulo_, servo_period_);
  loop_.configure(modulo_, servo_period_);
  const double highest = motor_limit_ * (1.0 + kRelativeRounding);
  if (has_drive_ && data.DynamicLimits.MaxVelocity > highest)
    reactions_.raise(alarm::kVelocityNotReachable,
                     {.value = data.DynamicLimits.MaxVelocity, .limit = motor_limit_});
}

void ServoOrders::show_execution_time() noexcept {
  data.StatusPositioning.SetpointExecutionTime = period_ + position_control_.setpoint_delay();
}

PositionControlSettings ServoOrders::control_settings() const noexcept {
  return {.kv = data.PositionControl.Kv,
          .kpc = emergency_ramp_ == EmergencyRamp::running ? kWholePrecontrol : data.PositionControl.Kpc,
          .delay = position_control_.control_delay(),
          .max_velocity = motor_limit_,
          .lead = position_control_.loop_in_drive() ? drive_properties_.dead_time : -1.0};
}

/// What the axis moves in one turn of the motor, through load gear and lead screw [u].
double ServoOrders::distance_per_motor_turn() const noexcept {
  const double load_turns =
      static_cast<double>(data.LoadGear.Denominator) / static_cast<double>(data.LoadGear.Numerator);
  if (!has_position_) {
    constexpr double kSecondsPerMinute = 60.0, kSecondsPerHour = 3600.0;
    if (data.Units.VelocityUnit == kTurnsPerSecond) return load_turns;
    return load_turns * (data.Units.VelocityUnit == kTurnsPerMinute ? kSecondsPerMinute : kSecondsPerHour);
  }
  return load_turns * (data.Properties.MotionType == MotionType::rotary ? 360.0 : data.Mechanics.LeadScrew);
}

double ServoOrders::motor_angle_per_unit() const noexcept {
  constexpr double kTurn = 6.283185307179586;
  return data.Actor.MotorType == MotorType::linear ? 1.0 : kTurn / distance_per_motor_turn_;
}

// ---- Every servo cycle

void ServoOrders::idle() noexcept {
  encoders_.count(drive_->read().position);
  drive_->write(0.0);
}

void ServoOrders::step() noexcept {
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
  if (power_state_ > PowerState::drive_stops && position_controlled_ && position_control_.loop_in_drive())
    drive_->write_position({.velocity = setpoint_sign_ * data.VelocitySetpoint,
                            .xerr = setpoint_sign_ * controlled.xerr,
                            .kpc = data.PositionControl.Kv,
                            .pace = setpoint_sign_ * controlled.pace,
                            .maximum = motor_limit_});
  else
    drive_->write(setpoint_sign_ * data.VelocitySetpoint);
}

/// Actual values of this tick.
void ServoOrders::read_drive() noexcept {
  DriveActual now = drive_->read();
  encoders_.count(now.position);
  if (encoders_.several()) sensors_.read(now);
  if (now.trouble || drive_in_trouble_) faults_.watch(now);
  if (signals_watched_) watch_signals();
  encoders_.orient(now);
  drive_running_ = now.enabled && !now.silent;
  drive_inhibited_ = now.inhibited;
  actual_torque_ = setpoint_sign_ * now.torque;
  if (data.Actor.Interface.EnableTorqueData) data.StatusTorqueData.ActualTorque = actual_torque_;
  if (encoders_.lost())
    now.velocity = 0.0;
  else
    actual_ = encoders_.read_position(
        sensors_.passes_backlash() ? now.position - DoubleDouble{sensors_.play(), 0.0} : now.position);
  data.ActualAcceleration = (now.velocity - actual_velocity_) / servo_period_;
  actual_velocity_ = now.velocity;
  data.StatusSensor[encoders_.operative()].Velocity = actual_velocity_;
  sensors_.show_place(encoders_.operative(), actual_);
  data.ActualSpeed = actual_velocity_ / distance_per_motor_turn_ * 60.0;
}

void ServoOrders::watch_signals() noexcept {
  const double place = switches_.read_inputs();
  if (data.PositionLimits_HW.Active)
    for (const int side : {-1, 1})
      if (switches_.meets_limit_switch(side, place))
        reactions_.raise(alarm::kHardwareLimitSwitch, switches_.reaction(),
                         {.cause = side_of(side), .value = actual_.value});
  switches_.look_for_mark(place);
}

/// The setpoint of this servo tick: between the last two interpolator results, one interpolator cycle later.
ServoSetpoint ServoOrders::fine_setpoint_now() const noexcept {
  if (servo_tick_ >= ratio_) return {setpoint_.position, setpoint_.velocity};
  const double distance = rounded_difference(setpoint_.position, last_setpoint_.position, modulo_);
  const double part = static_cast<double>(servo_tick_) / ratio_;
  const FineSetpoint fine =
      fine_setpoint(distance, last_setpoint_.velocity, setpoint_.velocity, period_, part);
  return {advanced(last_setpoint_.position, fine.distance, modulo_), fine.velocity};
}

PositionLoop::Output ServoOrders::control_position() noexcept {
  const ServoSetpoint setpoint = fine_setpoint_now();
  if (!position_controlled_) {
    data.VelocitySetpoint = loop_.switched_over(setpoint.velocity, motor_limit_);
    if (!has_position_) limit_speed();
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
    return {};
  }
  PositionLoop::Input input{
      .setpoint = setpoint, .actual = actual_, .in_drive = position_control_.loop_in_drive()};
  if (sensors_.passes_backlash()) {
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
  if (output.limited)
    reactions_.raise(alarm::kSpeedSetpointLimited, {.value = output.velocity, .limit = motor_limit_});
  if (data.FollowingError.EnableMonitoring && !forces_.position_monitoring_off(data))
    watch_following_error(output.controlled.velocity);
  return output;
}

/// @param velocity setpoint before the position controller [u/s]
void ServoOrders::watch_following_error(double velocity) noexcept {
  const double error = std::abs(data.StatusPositioning.FollowingError);
  const auto following_error = [&](double share) {
    const double maximum = data.DynamicLimits.MaxVelocity;
    const double permitted = PositionLoop::permissible_error(velocity, maximum, data.FollowingError);
    return AlarmDetail{.sensor = static_cast<std::uint8_t>(encoders_.operative() + 1),
                       .value = data.StatusPositioning.FollowingError,
                       .limit = share * permitted};
  };
  switch (PositionLoop::level_of(error, velocity, data.DynamicLimits.MaxVelocity, data.FollowingError)) {
    case PositionLoop::FollowingErrorLevel::permitted:
      break;
    case PositionLoop::FollowingErrorLevel::warning:
      reactions_.raise(alarm::kFollowingErrorWarning,
                       following_error(0.01 * data.FollowingError.WarningLevel));
      break;
    case PositionLoop::FollowingErrorLevel::exceeded:
      reactions_.raise(alarm::kFollowingError, following_error(1.0));
      break;
  }
}

/// The speed setpoint of a speed axis keeps to what its motor can do.
void ServoOrders::limit_speed() noexcept {
  if (std::abs(data.VelocitySetpoint) <= motor_limit_) return;
  const AlarmDetail detail{.value = data.VelocitySetpoint, .limit = motor_limit_};
  data.VelocitySetpoint = std::copysign(motor_limit_, data.VelocitySetpoint);
  reactions_.raise(alarm::kSpeedSetpointLimited, detail);
}

}  // namespace lockstep
