#include "tech_objects/drive/linear_motor_drive.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/drive/encoder_source.hpp"

namespace lockstep {
namespace {

/// [mm/s] A machine that is no faster rests.
constexpr double kMotorRestVelocity = 0.01;

}  // namespace

DriveProperties LinearMotorDrive::configure(const DriveSettings& settings, double servo_cycle,
                                            double /*motor_angle*/) noexcept {
  const LinearMotorSettings& motor = settings.linear_motor;
  unit_.configure(settings, servo_cycle);
  force_ = {};
  brake_ = motor.brake;
  servo_cycle_ = servo_cycle;
  control_cycles_ = std::clamp(static_cast<int>(std::floor(servo_cycle / motor.control_cycle + 0.5)), 1,
                               kMaximumControlCycles);
  control_cycle_ = servo_cycle / control_cycles_;
  start_ = settings.signals.start_position;
  resolution_ = std::max(0.0, settings.resolution);
  plant_.configure(motor.plant, start_);
  loop_.configure(motor.loop, control_cycle_);
  proportional_ = motor.loop.proportional;
  force_constant_ = motor.force_constant;
  quick_stop_ = std::max(0.0, settings.quick_stop);
  hardest_stop_ = force_constant_ * motor.loop.maximum_current / plant_.mass();
  current_ = mean_force_ = velocity_ = reported_ = 0.0;
  aim_where_it_is();
  // The ramp between two setpoints is behind the later one by a servo cycle.
  return {.known_delay = servo_cycle, .transport_delay = servo_cycle, .tells_torque = true};
}

/// The target rests where the motor is, and nothing is left of what went before.
void LinearMotorDrive::aim_where_it_is() noexcept {
  target_ = {plant_.position(), 0.0, 0.0};
  loop_.reset(plant_.position());
}

void LinearMotorDrive::begin_cycle() noexcept {
  mean_force_ = 0.0;
  if (unit_.has_faults()) unit_.watch_causes();
}

void LinearMotorDrive::write(double velocity) noexcept {
  begin_cycle();
  if (!unit_.states().pulses()) return coast();
  if (!unit_.states().operation()) velocity = stop_setpoint();
  target_.acceleration = (velocity - target_.velocity) / servo_cycle_;
  run(target_.acceleration, true);
  target_.velocity = velocity;
  if (unit_.states().stopping()) unit_.watch_stop(plant_.velocity(), target_.velocity);
}

void LinearMotorDrive::write_position(const PositionCommand& command) noexcept {
  begin_cycle();
  if (!unit_.states().operation()) return write(0.0);
  const double pace = std::clamp(command.pace, -command.maximum, command.maximum);
  target_ = {start_ + reported_ + command.xerr, pace, (pace - target_.velocity) / servo_cycle_};
  run(0.0, false);
}

/// A servo cycle of the loop. @param acceleration of the target meanwhile [mm/s²]
/// @param waits whether the target waits for a motor that has not the current to follow
void LinearMotorDrive::run(double acceleration, bool waits) noexcept {
  const CurrentBand band{force_.band.lower / force_constant_, force_.band.upper / force_constant_};
  const double additive = force_.additive / force_constant_;
  for (int i = 0; i < control_cycles_; ++i) {
    current_ = loop_.step(target_, plant_.position(), band, additive);
    if (waits) wait();
    target_.position += (target_.velocity + 0.5 * acceleration * control_cycle_) * control_cycle_;
    target_.velocity += acceleration * control_cycle_;
    move(force_constant_ * current_);
  }
}

/// What the current does not reach the target does not run ahead of, or the motor would have to make up for
/// it once it is free.
void LinearMotorDrive::wait() noexcept {
  const double error = target_.position - plant_.position();
  if (!(loop_.excess() * error > 0.0)) return;
  const double ahead = std::min(std::abs(loop_.excess()) / proportional_, std::abs(error));
  target_.position -= std::copysign(ahead, error);
}

/// Without current: the machine is what it is, and the target is wherever it is. A brake holds it once it
/// rests.
void LinearMotorDrive::coast() noexcept {
  current_ = 0.0;
  for (int i = 0; i < control_cycles_; ++i) {
    const double before = plant_.velocity();
    const bool rests = std::abs(before) <= kMotorRestVelocity;
    if (!(brake_ && rests)) move(0.0);
    if (brake_ && (rests || before * plant_.velocity() <= 0.0)) plant_.stop();
  }
  aim_where_it_is();
}

void LinearMotorDrive::move(double force) noexcept {
  mean_force_ += force / control_cycles_;
  if (unit_.blocked())
    plant_.stop();
  else
    plant_.step(force, control_cycle_);
}

/// [mm/s] Down the ramp of a stop, and nowhere ahead of the machine: where something holds it back the drive
/// would speed it up in place of stopping it.
double LinearMotorDrive::stop_setpoint() noexcept {
  const bool quick = quick_stop_ > 0.0 && unit_.states().state() == DriveStates::State::quick_stop;
  const double step = (quick ? quick_stop_ : hardest_stop_) * servo_cycle_;
  const double velocity = plant_.velocity();
  const double ramp = std::clamp(target_.velocity, std::min(velocity, 0.0), std::max(velocity, 0.0));
  return ramp - std::clamp(ramp, -step, step);
}

void LinearMotorDrive::control(std::uint16_t stw1, std::uint16_t stw2) noexcept {
  if (unit_.hears()) unit_.control(stw1, stw2);
}

DriveActual LinearMotorDrive::read() noexcept {
  return unit_.tell(mean_force_, [this](DriveActual& now) { read_encoder(now); });
}

void LinearMotorDrive::read_encoder(DriveActual& now) noexcept {
  now.position = moved();
  now.velocity = plant_.velocity();
  if (resolution_ > 0.0) {
    now.position = quantised(now.position, resolution_);
    now.velocity = (now.position.rounded() - reported_) / servo_cycle_;
  }
  reported_ = now.position.rounded();
}

}  // namespace lockstep
