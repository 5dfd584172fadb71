#include "tech_objects/synchronous/cam_coupling.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// Of a pass [leading u]. One that is repeated is counted exactly over all positions that there are; a
/// shorter one is a step for whatever a position can tell.
constexpr double kShortestPass = 1e-12;
constexpr double kShortestRepeatedPass = 1e-6;
constexpr double kSamePlace = 1e-12;  // of a pass: rounding of a position given at an end of the cam

/// A position that no axis can take (FALSE for NaN).
bool possible(double position) noexcept {
  return std::abs(position) <= kPositionRange;
}

}  // namespace

/// Leading value at which the cam starts, without its offset [leading u].
double CamCoupling::start() const noexcept {
  return curve_->start_leading_value() * use_.master_scaling;
}

SyncRefusal CamCoupling::begin(const CouplingRequest& request, const Modulo& leading,
                               const Modulo& following) noexcept {
  const CamFunction& f = *request.curve;
  curve_ = &f;
  use_ = request.use;
  sync_distance_ = request.leading_position;
  leading_offset_ = request.leading_offset;
  following_offset_ = request.following_offset;
  leading_ = leading;
  following_ = following;
  const double length = f.end_leading_value() - f.start_leading_value();
  const double pass = length * std::abs(use_.master_scaling);
  const double highest =
      std::max(std::abs(f.lowest_following_value()), std::abs(f.highest_following_value()));
  if (!(pass >= (use_.mode == CamMode::once ? kShortestPass : kShortestRepeatedPass)))
    return SyncRefusal::leading_scaling;
  if (!possible(highest * use_.slave_scaling)) return SyncRefusal::following_scaling;
  if (!possible(following_offset_)) return SyncRefusal::following_offset;
  if (use_.mode == CamMode::cyclic && !CamFollowing::closes(f, use_.slave_scaling, following_))
    return SyncRefusal::cam_not_closed;
  const double place = sync_distance_ / use_.master_scaling;  // in the cam
  if (request.start != SyncStartRule::subsequent_from_here &&
      !(place >= -kSamePlace * length && place <= (1.0 + kSamePlace) * length))
    return SyncRefusal::outside_cam;
  return possible(start() + leading_offset_ + sync_distance_) ? SyncRefusal::none
                                                              : SyncRefusal::leading_offset;
}

double CamCoupling::leading_sync_position() const noexcept {
  return normalised({0, start() + leading_offset_ + sync_distance_}, leading_).value;
}

double CamCoupling::following_sync_position() const noexcept {
  const double place = sync_distance_ / use_.master_scaling;
  const double following = curve_->value(curve_->start_leading_value() + place).position * use_.slave_scaling;
  return normalised({0, following + following_offset_}, following_).value;
}

void CamCoupling::place(AxisPosition leading) noexcept {
  set(*curve_, use_, leading, to_double_double(sync_distance_), leading_, following_);
}

bool CamCoupling::place_here(AxisPosition leading) noexcept {
  const AxisPosition begin = normalised({0, start() + leading_offset_}, leading_);
  DoubleDouble distance = two_difference(leading.value, begin.value);
  const bool backward = use_.master_scaling < 0.0;
  if (leading_.enabled && !backward && distance.hi < 0.0) distance = distance + leading_.length;
  if (leading_.enabled && backward && distance.hi > 0.0) distance = distance - leading_.length;
  set(*curve_, use_, leading, distance, leading_, following_);
  const double inside = backward ? -distance.hi : distance.hi;
  return inside >= -kSamePlace * pass_length() && inside <= (1.0 + kSamePlace) * pass_length();
}

void CamCoupling::offset_to(double leading) noexcept {
  leading_offset_ = leading - start() - sync_distance_;
}

DoubleDouble CamCoupling::place_at(AxisPosition leading, AxisPosition following) noexcept {
  place(leading);
  const AxisPosition place = value(leading).position;
  if (following_.enabled) add_turns(following.turns - place.turns);
  leading_offset_ = leading.value - sync_distance_ - start();
  return two_difference(following.value, place.value);
}

DoubleDouble CamCoupling::place_at_end(const CamFollowing::LeadingPosition& end, DoubleDouble phase,
                                       AxisPosition following) noexcept {
  const DoubleDouble leading = end.value - phase;
  set_start(*curve_, use_, end.turns, leading - sync_distance_, leading_, following_);
  const double at = curve_->start_leading_value() + sync_distance_ / use_.master_scaling;
  const DoubleDouble apart = -two_product(curve_->value(at).position, use_.slave_scaling) + following.value;
  add_turns(following.turns);
  leading_offset_ = normalised(0, leading, leading_).value - sync_distance_ - start();
  return apart;
}

bool CamCoupling::beyond_one_pass(AxisPosition leading) const noexcept {
  if (!passed_once()) return false;
  const double inside = distance(leading);
  const double tolerance = kSamePlace * pass_length();
  return inside < -tolerance || inside > pass_length() + tolerance;
}

}  // namespace lockstep
