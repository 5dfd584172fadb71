#include "tech_objects/drive/position_controller.hpp"

#include <algorithm>

#include "tech_objects/drive/whole_cycles.hpp"

namespace lockstep {

void PositionController::configure(const PositionControlSettings& settings, double servo_cycle) noexcept {
  const Cycles delay = cycles_of(settings.delay, servo_cycle, kDelay - 2);
  whole_cycles_ = delay.whole;
  part_ = delay.part;
  settings_ = settings;
  if (settings.lead < 0.0) return;
  const Cycles ahead = cycles_of(settings.delay - settings.lead, servo_cycle, kDelay - 2);
  whole_ahead_ = ahead.whole;
  part_ahead_ = ahead.part;
}

void PositionController::reset(AxisPosition setpoint) noexcept {
  setpoints_.fill(setpoint);
}

void PositionController::reset(AxisPosition setpoint, double distance, const Modulo& modulo) noexcept {
  for (std::size_t age = 0; age < kDelay; ++age)
    setpoints_[(cycle_ + kDelay - 1 - age) % kDelay] =
        advanced(setpoint, -distance * static_cast<double>(age), modulo);
}

void PositionController::shift(double by, const Modulo& modulo) noexcept {
  for (AxisPosition& setpoint : setpoints_) setpoint = advanced(setpoint, by, modulo);
}

/// The setpoint some cycles ago, between two of them on a straight line.
AxisPosition PositionController::delayed(std::size_t whole, double part,
                                         const Modulo& modulo) const noexcept {
  const AxisPosition newer = setpoints_[(cycle_ + kDelay - whole) % kDelay];
  if (part <= 0.0) return newer;
  const AxisPosition older = setpoints_[(cycle_ + kDelay - whole - 1) % kDelay];
  return advanced(newer, difference(older, newer, modulo) * part, modulo);
}

PositionControlled PositionController::step(AxisPosition setpoint, double velocity, AxisPosition actual,
                                            const Modulo& modulo) noexcept {
  setpoints_[cycle_ % kDelay] = setpoint;
  PositionControlled result;
  result.balanced = delayed(whole_cycles_, part_, modulo);
  if (settings_.lead >= 0.0)
    result.xerr = rounded_difference(delayed(whole_ahead_, part_ahead_, modulo), actual, modulo);
  ++cycle_;
  result.control_difference = rounded_difference(result.balanced, actual, modulo);
  const double wanted = 0.01 * settings_.kpc * velocity + settings_.kv * result.control_difference;
  result.velocity = std::clamp(wanted, -settings_.max_velocity, settings_.max_velocity);
  result.limited = result.velocity != wanted;
  return result;
}

}  // namespace lockstep
