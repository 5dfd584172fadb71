#include "tech_objects/drive/simulated_control_unit.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// A stop of the drive's own: at rest once this part of the velocity, or this velocity [u/s], is left; given
/// up after [s].
constexpr double kRest = 1e-3;
constexpr double kRestVelocity = 0.01;
constexpr double kLongestStop = 10.0;

}  // namespace

void SimulatedControlUnit::configure(const DriveSettings& settings, double servo_cycle) noexcept {
  signals_ = settings.signals;
  sensors_ = settings.sensors;
  faults_ = settings.faults;
  has_faults_ = faults_.drive != nullptr || faults_.encoder != nullptr || faults_.communication != nullptr ||
                faults_.blocked != nullptr;
  states_ = {};
  told_ = {};
  stw1_ = kControlOff;
  stw2_ = 0;
  blocked_ = false;
  stopping_cycles_ = 0;
  stop_velocity_ = 0.0;
  maximum_stop_cycles_ = kLongestStop / servo_cycle;
}

bool SimulatedControlUnit::watch_causes() noexcept {
  const bool drive = is_on(faults_.drive) || is_on(faults_.encoder);
  const bool silent = !hears();
  blocked_ = is_on(faults_.blocked);
  states_.hold_fault(drive || silent);
  if (drive) {
    states_.fail(false);
    return false;
  }
  if (!silent || states_.fault()) return false;
  states_.fail(true);
  stopping_cycles_ = 0;
  return true;
}

void SimulatedControlUnit::watch_stop(double velocity, double setpoint) noexcept {
  if (stopping_cycles_++ == 0) stop_velocity_ = std::abs(velocity);
  const bool rests = std::abs(velocity) <= std::max(kRest * stop_velocity_, kRestVelocity) && setpoint == 0.0;
  if (!rests && stopping_cycles_ < maximum_stop_cycles_) return;
  stopping_cycles_ = 0;
  states_.stopped();
}

}  // namespace lockstep
