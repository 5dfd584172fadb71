#include "tech_objects/axis/position_names.hpp"

#include <cmath>

namespace lockstep {

bool PositionNames::fit(double by) const noexcept {
  const double shifted = advanced(setpoint_.position, by, modulo_).value;
  return std::isfinite(by) && std::abs(shifted) <= kPositionRange && modulo_.contains(shifted);
}

double PositionNames::distance_to(double home_position) const noexcept {
  return shortest_distance(actual_.value, home_position, modulo_);
}

void PositionNames::shift(double by) noexcept {
  setpoint_.position = advanced(setpoint_.position, by, modulo_);
  last_setpoint_.position = advanced(last_setpoint_.position, by, modulo_);
  superimposed_.shift_base(by, modulo_);
  actual_ = advanced(actual_, by, modulo_);
  leading_.shift_leading(by);
  hand_over_.shift(by);
  single_.shift(by);
  // What waits to blend may have another distance to its target: that is where the axis calls it so then.
  if (jobs_[kBuffered] != nullptr && jobs_[kBase] != nullptr && motion_ == AxisMotion::single_axis)
    junction_.plan();
  shift_coupling(by);
  if (has_drive_) shift_servo(by);
}

/// What leads the axis has the new names as well, so that nothing moves.
void PositionNames::shift_coupling(double by) noexcept {
  synchronous_.shift_following(by);
  if (coupled_.cam == nullptr || motion_ == AxisMotion::desynchronizing) return;
  data.StatusSynchronizedMotion.SlaveOffset = synchronous_.following_offset_at_start();
  Job* const offset = jobs_[kOffset];
  if (offset == nullptr || offset->kind != JobKind::MC_OffsetRelative) return;
  auto& shift = offset->as<ShiftJob>();
  shift.base = shift.base + by;
}

void PositionNames::shift_servo(double by) noexcept {
  clamping_.shift(by, modulo_);
  encoders_.shift(by);
  loop_.shift(by);
  auto& shown = data.StatusServo;
  shown.BalancedPosition = loop_.balanced().value;
  shown.PositionAfterDynamicFilter = advanced({0, shown.PositionAfterDynamicFilter}, by, modulo_).value;
}

bool PositionNames::assign(AxisPosition place, double position) noexcept {
  const double by = shortest_distance(place.value, position, modulo_);
  if (!fit(by)) return false;
  shift(by);
  encoders_.shift_beside(by);
  if (modulo_.enabled && !encoders_.absolute(encoders_.operative())) {
    counted_from_ = first_turn(advanced(place, by, modulo_), modulo_);
  }
  show();
  homed_ = true;
  sensors_.adjust(encoders_.operative(), false);
  return true;
}

void PositionNames::show() noexcept {
  const bool positioning = motion_ == AxisMotion::single_axis && jobs_[kBase] != nullptr &&
                           single_.aim() == SingleAxisMotion::Aim::position;
  if (positioning) motion_orders_.show_target(single_.target());
  if (has_drive_) sensors_.show_places();
}

void PositionNames::begin_encoders(AxisPosition here) noexcept {
  const std::size_t operative = encoders_.operative();
  encoders_.begin(encoders_.origin_at(operative, here, sensors_.play()));
  if (encoders_.absolute(operative)) {
    const AxisPosition origin = sensors_.adjusted_origin(operative);
    shift(encoders_.distance_to_origin(origin));
    encoders_.begin(origin);
    counted_from_ = 0;
    homed_ = encoder_adjustments[operative].adjusted;
  }
  for (std::size_t i = 0; i < Encoders::kCount; ++i) {
    if (!encoders_.beside(i)) continue;
    const AxisPosition origin = encoders_.absolute(i) ? sensors_.adjusted_origin(i)
                                                      : encoders_.origin_at(i, actual_, sensors_.play());
    encoders_.begin_beside(i, origin, sensors_.play());
  }
}

}  // namespace lockstep
