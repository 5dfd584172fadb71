#include "tech_objects/axis/direct_homing.hpp"

#include <cmath>

#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// Modes whose position is a distance from where the axis is.
bool is_relative(HomeMode mode) noexcept {
  return mode == HomeMode::direct_relative || mode == HomeMode::adjust_absolute_relative ||
         mode == HomeMode::setpoint_relative;
}

}  // namespace

bool adjusts_encoder(HomeMode mode) noexcept {
  return mode == HomeMode::adjust_absolute_relative || mode == HomeMode::adjust_absolute ||
         mode == HomeMode::adjust_incremental;
}

void DirectHoming::home(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  const bool adjusts = adjusts_encoder(asked.mode);
  if (adjusts && sensors_.sensor_of(job) != encoders_.operative()) return home_sensor_beside(job);
  const bool to_setpoint = asked.mode == HomeMode::setpoint;
  const bool relative = is_relative(asked.mode);
  const double by = relative      ? asked.position
                    : to_setpoint ? shortest_distance(setpoint_.position.value, asked.position, modulo_)
                                  : names_.distance_to(asked.position);
  if (!names_.fit(by)) return job.fail(ErrorId::position);
  names_.shift(by);
  if (!adjusts) encoders_.shift_beside(by);
  if (to_setpoint || (!relative && !has_drive_)) {
    // No following error in between: the setpoint is the given position to the last bit.
    const AxisPosition exact = normalised({setpoint_.position.turns, asked.position}, modulo_);
    setpoint_.position.value = exact.value;
    const bool idle = jobs_[kBase] == nullptr && !superimposed_.in_use();
    if (setpoint_.standing() && motion_ == AxisMotion::single_axis && idle) single_.stand(setpoint_);
    if (!has_drive_) actual_ = setpoint_.position;
  }
  if (asked.mode == HomeMode::adjust_absolute) counted_from_ = actual_.turns;
  names_.show();
  if (adjusts) sensors_.adjust(encoders_.operative(), true);
  homed_ = true;
  asked.mark_position = relative ? actual_.value : asked.position;
  job.phase = JobPhase::done;
}

/// Modes 6, 7, 13 at an encoder that is not operative: only what that one tells changes.
void DirectHoming::home_sensor_beside(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  const std::size_t sensor = sensors_.sensor_of(job);
  const AxisPosition seen = encoders_.position(sensor, actual_);
  const bool relative = asked.mode == HomeMode::adjust_absolute_relative;
  const double by = relative ? asked.position : shortest_distance(seen.value, asked.position, modulo_);
  const AxisPosition renamed = advanced(seen, by, modulo_);
  if (!std::isfinite(by) || !modulo_.contains(renamed.value)) return job.fail(ErrorId::position);
  encoders_.rename(sensor, by);
  sensors_.show_place(sensor, renamed);
  sensors_.adjust(sensor, true);
  asked.mark_position = relative ? renamed.value : asked.position;
  job.phase = JobPhase::done;
}

}  // namespace lockstep
