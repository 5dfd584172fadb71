#include "tech_objects/drive/simulated_drive.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tech_objects/arithmetic/decay.hpp"
#include "tech_objects/drive/whole_cycles.hpp"

namespace lockstep {
namespace {

/// Steps of the drive's own position loop in a servo cycle, at most.
constexpr int kMaximumSteps = 256;
/// [u/s] Nothing that moves is as slow.
constexpr double kNoMotion = 1e-300;

}  // namespace

DriveProperties SimulatedDrive::configure(const DriveSettings& settings, double servo_cycle,
                                          double motor_angle) noexcept {
  unit_.configure(settings, servo_cycle);
  written_.fill(0.0);
  cycle_ = 0;
  targets_.fill({});
  next_target_ = {};
  loop_cycles_ = 0;
  position_ = reported_ = {};
  velocity_ = 0.0;
  ramp_ = last_setpoint_ = 0.0;
  rests_ = false;
  quick_stop_ = std::max(0.0, settings.quick_stop);
  plant_.configure(settings.plant, motor_angle, settings.signals.start_position, settings.time_constant,
                   servo_cycle);
  has_plant_ = plant_.exists();
  command_torque({});
  const Cycles dead = cycles_of(settings.dead_time, servo_cycle, kDelay - 2);
  const double time_constant = std::max(0.0, settings.time_constant);
  servo_cycle_ = servo_cycle;
  whole_cycles_ = dead.whole;
  ring_ = std::bit_ceil(dead.whole + 2);
  before_ = piece(dead.part * servo_cycle, time_constant);
  after_ = piece((1.0 - dead.part) * servo_cycle, time_constant);
  arrival_ = dead.part * servo_cycle;
  const double steps = servo_cycle / std::max(settings.position_cycle, servo_cycle / kMaximumSteps);
  steps_ = std::max(1, static_cast<int>(std::floor(steps + 0.5)));
  step_ = piece(servo_cycle / steps_, time_constant);
  resolution_ = std::max(0.0, settings.resolution);
  note_states();
  choose_path();
  const double transport_delay = (static_cast<double>(dead.whole) + dead.part + 0.5) * servo_cycle;
  return {.known_delay = transport_delay + time_constant,
          .transport_delay = transport_delay,
          .dead_time = transport_delay - 0.5 * servo_cycle,
          .tells_torque = has_plant_};
}

void SimulatedDrive::choose_path() noexcept {
  const bool delays = whole_cycles_ > 0 || before_.duration > 0.0;
  at_once_ = !delays && !unit_.has_faults() && operates_ && loop_cycles_ == 0;
}

SimulatedDrive::Piece SimulatedDrive::piece(double duration, double time_constant) noexcept {
  if (duration <= 0.0) return {};
  const double decay = time_constant > 0.0 ? decay_within(duration / time_constant) : 1.0;
  return {duration, {duration, 0.0}, {-time_constant * decay, decay}};
}

/// Lag v' = (u - v) / τ over a piece: v ends at v + (u - v) decay, its integral is u t + (v - u) τ decay.
void SimulatedDrive::run(const Piece& piece, double velocity) noexcept {
  // A sum of products, not a product of matrices: that may be fused on some processors.
  const Eigen::Vector2d change = piece.by_setpoint * velocity + piece.by_difference * (velocity - velocity_);
  position_ = position_ + change[0];
  velocity_ += change[1];
}

/// The setpoints that arrive in this cycle, the older and the newer one.
inline DoubleDouble SimulatedDrive::arriving() const noexcept {
  const double newer = written_[kept(cycle_ - whole_cycles_)];
  return {before_.duration > 0.0 ? written_[kept(cycle_ - whole_cycles_ - 1)] : newer, newer};
}

[[gnu::noinline]] void SimulatedDrive::look_for_rest(const Motion& before,
                                                     const DoubleDouble& setpoints) noexcept {
  const MachinePlant::Memory plant = plant_.memory();
  rests_ = same_bits(before.position, position_) && same_bits({before.velocity, 0.0}, {velocity_, 0.0}) &&
           same_bits({before.plant.torque, before.plant.known}, {plant.torque, plant.known});
  rested_ = setpoints;
}

/// First what most drives are in most of their cycles: on, without dead time.
void SimulatedDrive::write(double velocity) noexcept {
  if (!at_once_) return write_with_all(velocity);
  last_setpoint_ = velocity;
  if (std::abs(velocity_) < kNoMotion) {
    if (!rests_ || !same_bits(rested_, {velocity, velocity})) write_at_standstill(velocity);
    return;
  }
  const DoubleDouble position_before = position_;
  const double velocity_before = velocity_;
  run(after_, velocity);
  if (has_plant_ && !plant_.follow(velocity_before, velocity_, permitted_, additive_torque_))
    move_plant(position_before, velocity_before);
}

[[gnu::noinline]] void SimulatedDrive::write_at_standstill(double velocity) noexcept {
  const Motion before{position_, velocity_, plant_.memory()};
  run(after_, velocity);
  if (has_plant_) move_plant(before.position, before.velocity);
  look_for_rest(before, {velocity, velocity});
}

[[gnu::noinline]] void SimulatedDrive::write_with_all(double velocity) noexcept {
  if (unit_.has_faults()) {
    if (unit_.watch_causes()) ramp_ = quick_stop_ > 0.0 ? last_setpoint_ : 0.0;
    note_states();
  }
  if (states().operation()) last_setpoint_ = velocity;
  written_[kept(cycle_)] = states().operation() ? velocity : quick_stop_setpoint();
  const Motion before{position_, velocity_, plant_.memory()};
  if (loop_cycles_ > 0) {
    rests_ = false;
    run_position_loop();
  } else if (!rests_ || !same_bits(rested_, arriving())) {
    rests_ = false;
    // The setpoint written `whole_cycles_` ago arrives after the broken part of the dead time.
    if (before_.duration > 0.0) run(before_, written_[kept(cycle_ - whole_cycles_ - 1)]);
    run(after_, written_[kept(cycle_ - whole_cycles_)]);
    if (std::abs(velocity_) < kNoMotion) look_for_rest(before, arriving());
  }
  ++cycle_;
  if (has_plant_ || unit_.blocked()) {
    move_plant(before.position, before.velocity);
    rests_ = false;
  }
  if (states().stopping()) unit_.watch_stop(velocity_, ramp_);
  choose_path();
}

void SimulatedDrive::write_position(const PositionCommand& command) noexcept {
  next_target_ = {reported_ + command.xerr, command.kpc, command.pace, command.maximum};
  loop_cycles_ = kDelay;
  write_with_all(command.velocity);
}

/// The position loop of the drive: in steps of its own, with the position of each of them. Between two
/// commands the target goes on with its own velocity, however much of that is precontrolled: one that stood
/// would make the velocity rise and fall with each of them.
void SimulatedDrive::run_position_loop() noexcept {
  targets_[kept(cycle_)] = states().operation() ? next_target_ : Target{};
  next_target_ = {};
  --loop_cycles_;
  for (int i = 0; i < steps_; ++i) {
    const double since = static_cast<double>(i) * step_.duration - arrival_;
    const bool newer = since >= -1e-9 * servo_cycle_;
    const std::size_t slot = kept(cycle_ - whole_cycles_ - (newer ? 0 : 1));
    const Target& target = targets_[slot];
    double velocity = written_[slot];
    if (target.kpc > 0.0) {
      const double age = newer ? since : since + servo_cycle_;
      const double difference = (target.position - position_).rounded() + target.pace * age;
      velocity = std::clamp(velocity + target.kpc * difference, -target.maximum, target.maximum);
    }
    run(step_, velocity);
  }
}

/// Off, or on the way there: 0, or down the ramp of OFF3. That is nowhere ahead of the machine: where
/// something has held it back, or does, the drive would speed it up in place of stopping it.
double SimulatedDrive::quick_stop_setpoint() noexcept {
  if (quick_stop_ <= 0.0 || states().state() != DriveStates::State::quick_stop) return 0.0;
  const double step = quick_stop_ * servo_cycle_;
  ramp_ = std::clamp(ramp_, std::min(velocity_, 0.0), std::max(velocity_, 0.0));
  ramp_ -= std::clamp(ramp_, -step, step);
  return ramp_;
}

void SimulatedDrive::move_plant(const DoubleDouble& position_before, double velocity_before) noexcept {
  if (unit_.blocked()) {
    plant_.hold(velocity_, permitted_);
    position_ = position_before;
    velocity_ = 0.0;
    return;
  }
  const MachinePlant::Motion wanted{(position_ - position_before).rounded(), velocity_};
  const MachinePlant::Motion made = plant_.step({position_before.rounded(), velocity_before}, wanted,
                                                states().pulses(), permitted_, additive_torque_);
  if (made.distance != wanted.distance) position_ = position_before + made.distance;
  velocity_ = made.velocity;
}

void SimulatedDrive::control(std::uint16_t stw1, std::uint16_t stw2) noexcept {
  if (!unit_.hears()) return;
  if (unit_.control(stw1, stw2))
    ramp_ = states().state() == DriveStates::State::quick_stop && quick_stop_ > 0.0 ? last_setpoint_ : 0.0;
  if (!states().operation() && !states().stopping()) last_setpoint_ = 0.0;
  rests_ = false;
  note_states();
  choose_path();
}

}  // namespace lockstep
