#include "tech_objects/drive.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/decay.hpp"

namespace lockstep {
namespace {

/// A delay as whole cycles and a part of one.
struct Cycles {
  std::size_t whole;
  double part;  // 0 … 1
};

Cycles cycles_of(double delay, double servo_cycle, std::size_t most) noexcept {
  const double cycles = std::clamp(delay / servo_cycle, 0.0, static_cast<double>(most));
  const double nearest = std::floor(cycles + 0.5);
  if (std::abs(cycles - nearest) < 1e-9) return {static_cast<std::size_t>(nearest), 0.0};
  const double whole = std::floor(cycles);
  return {static_cast<std::size_t>(whole), cycles - whole};
}

}  // namespace

void SimulatedDrive::configure(const SimulatedDriveSettings& settings, double servo_cycle) noexcept {
  written_.fill(0.0);
  cycle_ = 0;
  position_ = reported_ = {};
  velocity_ = 0.0;
  enabled_ = false;
  const Cycles dead = cycles_of(settings.dead_time, servo_cycle, kDelay - 2);
  const double time_constant = std::max(0.0, settings.time_constant);
  servo_cycle_ = servo_cycle;
  whole_cycles_ = dead.whole;
  before_ = piece(dead.part * servo_cycle, time_constant);
  after_ = piece((1.0 - dead.part) * servo_cycle, time_constant);
  resolution_ = std::max(0.0, settings.resolution);
  transport_delay_ = (static_cast<double>(dead.whole) + dead.part + 0.5) * servo_cycle;
  known_delay_ = transport_delay_ + time_constant;
}

SimulatedDrive::Piece SimulatedDrive::piece(double duration, double time_constant) noexcept {
  if (duration <= 0.0) return {};
  const double decay = time_constant > 0.0 ? decay_within(duration / time_constant) : 1.0;
  return {duration, decay, time_constant * decay};
}

/// Lag v' = (u - v) / τ over a piece: v ends at v + (u - v) decay, its integral is u t + (v - u) τ decay.
void SimulatedDrive::run(const Piece& piece, double velocity) noexcept {
  position_ = position_ + (velocity * piece.duration + (velocity_ - velocity) * piece.lag);
  velocity_ += (velocity - velocity_) * piece.decay;
}

void SimulatedDrive::write(double velocity) noexcept {
  written_[cycle_ % kDelay] = enabled_ ? velocity : 0.0;
  // The setpoint written `whole_cycles_` ago arrives after the broken part of the dead time.
  run(before_, written_[(cycle_ + kDelay - whole_cycles_ - 1) % kDelay]);
  run(after_, written_[(cycle_ + kDelay - whole_cycles_) % kDelay]);
  ++cycle_;
}

DriveActual SimulatedDrive::read() noexcept {
  if (resolution_ == 0.0) return {position_, velocity_, enabled_};
  const DoubleDouble increments = position_ / resolution_ + 0.5;
  double count = std::floor(increments.hi);
  if (count == increments.hi && increments.lo < 0.0) count -= 1.0;
  const DoubleDouble position = two_product(count, resolution_);
  const double velocity = (position - reported_).rounded() / servo_cycle_;
  reported_ = position;
  return {position, velocity, enabled_};
}

void PositionController::configure(const PositionControlSettings& settings, double servo_cycle) noexcept {
  const Cycles delay = cycles_of(settings.delay, servo_cycle, kDelay - 2);
  whole_cycles_ = delay.whole;
  part_ = delay.part;
  settings_ = settings;
}

void PositionController::reset(AxisPosition setpoint) noexcept {
  setpoints_.fill(setpoint);
}

void PositionController::reset(AxisPosition setpoint, double way, const Modulo& modulo) noexcept {
  for (std::size_t age = 0; age < kDelay; ++age)
    setpoints_[(cycle_ + kDelay - 1 - age) % kDelay] =
        advanced(setpoint, -way * static_cast<double>(age), modulo);
}

void PositionController::shift(double by, const Modulo& modulo) noexcept {
  for (AxisPosition& setpoint : setpoints_) setpoint = advanced(setpoint, by, modulo);
}

PositionControlled PositionController::step(AxisPosition setpoint, double velocity, AxisPosition actual,
                                            const Modulo& modulo) noexcept {
  setpoints_[cycle_ % kDelay] = setpoint;
  PositionControlled result;
  result.balanced = setpoints_[(cycle_ + kDelay - whole_cycles_) % kDelay];
  if (part_ > 0.0) {
    const AxisPosition older = setpoints_[(cycle_ + kDelay - whole_cycles_ - 1) % kDelay];
    result.balanced = advanced(result.balanced, difference(older, result.balanced, modulo) * part_, modulo);
  }
  ++cycle_;
  result.control_difference = rounded_difference(result.balanced, actual, modulo);
  const double wanted = 0.01 * settings_.kpc * velocity + settings_.kv * result.control_difference;
  result.velocity = std::clamp(wanted, -settings_.max_velocity, settings_.max_velocity);
  result.limited = result.velocity != wanted;
  return result;
}

}  // namespace lockstep
