// MC_Servo of an axis with a drive: actual values, fine interpolation, position control.
#include "tech_objects/axis.hpp"

namespace lockstep {
namespace {

/// Position and velocity between two interpolator ticks, on a cubic through both.
struct FineSetpoint {
  double way = 0.0;       // from the earlier tick [u]
  double velocity = 0.0;  // [u/s]
};

/// @param way between the ticks [u]  @param u part of the interpolator cycle, 0 to 1
FineSetpoint between(double way, double from_velocity, double to_velocity, double period, double u) noexcept {
  const double a = from_velocity * period;
  const double b = to_velocity * period;
  const double cubic = a + b - 2.0 * way;
  const double square = 3.0 * way - 2.0 * a - b;
  return {((cubic * u + square) * u + a) * u, ((3.0 * cubic * u + 2.0 * square) * u + a) / period};
}

}  // namespace

/// The encoder goes on from where it is, at the position that the axis has now.
void Axis::restart_servo() noexcept {
  encoder_origin_ = advanced(actual_, -encoder_position_, modulo_);
  controller_.reset(setpoint_.position);
  data.StatusPositioning.SetpointExecutionTime = period_ + drive_.known_delay();
}

void Axis::configure_servo() {
  drive_.configure(drive_settings, servo_period_);
  controller_.configure(control_settings(), servo_period_);
  controller_.reset(setpoint_.position);
  encoder_origin_ = setpoint_.position;
  // A setpoint is handed to the drive, at the end of the fine interpolation, one interpolator cycle later.
  data.StatusPositioning.SetpointExecutionTime = period_ + drive_.known_delay();
}

PositionControlSettings Axis::control_settings() const noexcept {
  return {.kv = data.PositionControl.Kv,
          .kpc = data.PositionControl.Kpc,
          .delay = drive_.known_delay(),
          .max_velocity = data.Actor.DriveParameter.MaxSpeed / 60.0 * way_per_motor_turn()};
}

/// What the axis moves in one turn of the motor, through load gear and lead screw [u].
double Axis::way_per_motor_turn() const noexcept {
  const double load_turns =
      static_cast<double>(data.LoadGear.Denominator) / static_cast<double>(data.LoadGear.Numerator);
  return load_turns * (data.Properties.MotionType == 1 ? 360.0 : data.Mechanics.LeadScrew);
}

void Axis::servo() noexcept {
  const DriveActual now = drive_.read();
  drive_running_ = now.enabled;
  encoder_position_ = now.position;
  actual_ = advanced(encoder_origin_, now.position, modulo_);
  data.ActualAcceleration = (now.velocity - actual_velocity_) / servo_period_;
  actual_velocity_ = now.velocity;
  data.StatusSensor[0].Position = actual_.value;
  data.StatusSensor[0].Velocity = actual_velocity_;
  data.ActualSpeed = actual_velocity_ / way_per_motor_turn() * 60.0;

  ++servo_tick_;
  if (power_state_ == PowerState::off || power_state_ == PowerState::switching_on) {
    data.VelocitySetpoint = 0.0;
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
  } else {
    control_position();
  }
  drive_.write(data.VelocitySetpoint);
}

/// The setpoint of this servo tick: between the last two interpolator results, one interpolator cycle later.
void Axis::control_position() noexcept {
  const double way = difference(setpoint_.position, last_setpoint_.position, modulo_).rounded();
  const double part = static_cast<double>(servo_tick_) / ratio_;
  const bool whole = servo_tick_ >= ratio_;
  const FineSetpoint fine = between(way, last_setpoint_.velocity, setpoint_.velocity, period_, part);
  const AxisPosition position =
      whole ? setpoint_.position : advanced(last_setpoint_.position, fine.way, modulo_);
  const double velocity = whole ? setpoint_.velocity : fine.velocity;
  if (!position_controlled_) {
    data.VelocitySetpoint = velocity;
    data.StatusPositioning.FollowingError = 0.0;
    data.StatusServo.ControlDifference = 0.0;
    return;
  }
  controller_.configure(control_settings(), servo_period_);
  const PositionControlled controlled = controller_.step(position, velocity, actual_, modulo_);
  data.VelocitySetpoint = controlled.velocity;
  data.StatusServo.BalancedPosition = controlled.balanced.value;
  data.StatusServo.ControlDifference = controlled.control_difference;
  data.StatusPositioning.FollowingError = controlled.control_difference;
  if (controlled.limited) raise(alarm::kSpeedSetpointLimited);
  if (data.FollowingError.EnableMonitoring) watch_following_error(velocity);
}

void Axis::shift_servo(double by) noexcept {
  encoder_origin_ = advanced(encoder_origin_, by, modulo_);
  controller_.shift(by, modulo_);
}

}  // namespace lockstep
