// Camming within a synchronous motion: the ways onto a cam, from cam to cam, and out of one.
#include <algorithm>
#include <cmath>

#include "tech_objects/cam/cam.hpp"
#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {
namespace {

/// Of a pass [leading u]. One that is repeated is counted exactly over all positions that there are; a
/// shorter one is a step for whatever a position can tell.
constexpr double kShortestPass = 1e-12;
constexpr double kShortestRepeatedPass = 1e-6;
constexpr double kSamePlace = 1e-12;  // of a pass: rounding of a position given at an end of the cam

enum Profile : DINT {
  kDynamics = 0,
  kAhead = 1,
  kDirect = 2,
  kSubsequent = 3,
  kSubsequentFromHere = 4,  // and 5: kAtCamEnd
  kAheadFromHere = 6
};

/// A shift as it will be in this tick.
Shift one_tick_on(const Shift& shift, const LeadingStep& step) noexcept {
  Shift moved = shift;
  moved.advance(step);
  return moved;
}

bool under_way(const Shift& shift) noexcept {
  return shift.phase() != Shift::Phase::resting || shift.settling();
}

/// A position that no axis can take (FALSE for NaN).
bool possible(double position) noexcept {
  return std::abs(position) <= kPositionRange;
}

}  // namespace

// ---- Taking a job over
// -----------------------------------------------------------------------------------------

/// Leading value at which the cam starts, without MasterOffset [leading u].
double SynchronousMotion::cam_start() const noexcept {
  return cam_->function().start_leading_value() * cam_use_.master_scaling;
}

ErrorId SynchronousMotion::begin_cam(const Job& job) noexcept {
  const CamFunction& f = cam_->function();
  cam_use_ = {job.master_scaling, job.slave_scaling, static_cast<CamMode>(job.application_mode)};
  cam_sync_way_ = job.master_sync_position;
  master_offset_ = job.master_offset;
  slave_offset_ = job.slave_offset;
  const double length = f.end_leading_value() - f.start_leading_value();
  const double pass = length * std::abs(cam_use_.master_scaling);
  const double highest =
      std::max(std::abs(f.lowest_following_value()), std::abs(f.highest_following_value()));
  if (!(pass >= (cam_use_.mode == CamMode::once ? kShortestPass : kShortestRepeatedPass)))
    return ErrorId::master_scaling;
  if (!possible(highest * cam_use_.slave_scaling)) return ErrorId::slave_scaling;
  if (!possible(slave_offset_)) return ErrorId::slave_offset;
  if (cam_use_.mode == CamMode::cyclic && !CamFollowing::closes(f, cam_use_.slave_scaling, following_))
    return ErrorId::cam_elements_wrong;
  const double place = cam_sync_way_ / cam_use_.master_scaling;  // in the cam
  if (job.mode != kSubsequentFromHere &&
      !(place >= -kSamePlace * length && place <= (1.0 + kSamePlace) * length))
    return ErrorId::outside_cam;
  const double sync = cam_start() + master_offset_ + cam_sync_way_;
  if (!possible(sync)) return ErrorId::master_offset;
  master_sync_position_ = normalised({0, sync}, leading_modulo_).value;
  const double following = f.value(f.start_leading_value() + place).position * cam_use_.slave_scaling;
  slave_sync_position_ = normalised({0, following + slave_offset_}, following_).value;
  begin_with_offset(to_double_double(slave_offset_));
  if (job.mode == kSubsequentFromHere && !place_cam_here(leading_now_.position)) return ErrorId::outside_cam;
  return ErrorId::none;
}

/// The way of MasterSyncPosition from the start of the cam belongs to a leading position.
void SynchronousMotion::place_cam(AxisPosition leading) noexcept {
  follow_.set(cam_->function(), cam_use_, leading, to_double_double(cam_sync_way_), leading_modulo_,
              following_);
}

/// Places the cam by MasterOffset alone; false if a leading position lies outside of it. On a ring the cam
/// begins at the last pass of its start.
bool SynchronousMotion::place_cam_here(AxisPosition leading) noexcept {
  const AxisPosition start = normalised({0, cam_start() + master_offset_}, leading_modulo_);
  DoubleDouble way = two_difference(leading.value, start.value);
  const bool backward = cam_use_.master_scaling < 0.0;
  if (leading_modulo_.enabled && !backward && way.hi < 0.0) way = way + leading_modulo_.length;
  if (leading_modulo_.enabled && backward && way.hi > 0.0) way = way - leading_modulo_.length;
  follow_.set(cam_->function(), cam_use_, leading, way, leading_modulo_, following_);
  const double inside = backward ? -way.hi : way.hi;
  return inside >= -kSamePlace * follow_.pass_length() &&
         inside <= (1.0 + kSamePlace) * follow_.pass_length();
}

// ---- Waiting
// ----------------------------------------------------------------------------------------------------

SynchronousMotion::Start SynchronousMotion::watch_cam(const Setpoint& own,
                                                      const SynchronousMotion* active) noexcept {
  if (profile_reference_ == kAtCamEnd) return watch_cam_end(active);
  if (profile_reference_ == kDirect) return set_on_cam(own);
  if (stands_on_cam(own)) {
    synchronous_ = true;
    return Start::synchronous;
  }
  direction_ = sign(rounded_difference(leading_now_.position, leading_last_.position, leading_modulo_));
  if (direction_ == 0) return Start::not_yet;
  const Start start = profile_reference_ == kDynamics ? watch_time(own) : watch_cam_distance(own);
  if (start != Start::synchronizing) direction_ = 0;
  return start;
}

/// Whether both axes stand where they would be synchronous; then the cam is placed there. Of profile 6 that
/// is where the cam lies without being shifted.
bool SynchronousMotion::stands_on_cam(const Setpoint& own) noexcept {
  if (profile_reference_ == kSubsequentFromHere) {
    if (!own.standing() || leading_now_.velocity != 0.0) return false;
    if (!place_cam_here(leading_last_.position)) return false;
    master_sync_position_ = leading_last_.position.value;
    const AxisPosition there =
        advanced(follow_.value(leading_last_.position).position, slave_offset_, following_);
    slave_sync_position_ = there.value;
  }
  if (!standing_on_sync_positions(own)) return false;
  direction_ = 1;
  const double way = shortest_distance(leading_last_.position.value, master_sync_position_, leading_modulo_);
  if (profile_reference_ != kSubsequentFromHere) place_cam(leading_at(way));
  const double following = shortest_distance(own.position.value, slave_sync_position_, following_);
  take_joint(follow_.joined_at(leading_at(way), direction_),
             advanced(own.position, following, following_).turns);
  return true;
}

/// Where profile and cam meet: the cam is moved by whole turns, so that it is there.
void SynchronousMotion::take_joint(const CamPlace& place, std::int64_t turns) noexcept {
  joint_ = advanced(place.position, slave_offset_, following_);
  ratio_ = place.slope;
  if (!following_.enabled) return;
  follow_.add_turns(turns - joint_.turns);
  joint_.turns = turns;
}

/// Profiles 1, 3, 4 and 6: over a leading distance, from the last tick before the start is crossed.
SynchronousMotion::Start SynchronousMotion::watch_cam_distance(const Setpoint& own) noexcept {
  const bool ahead = profile_reference_ == kAhead || profile_reference_ == kAheadFromHere;
  double way = 0.0;  // to the start
  if (profile_reference_ == kAhead) way = way_to(master_sync_position_ - direction_ * start_distance_);
  if (profile_reference_ == kSubsequent) way = way_to(master_sync_position_);
  const double step =
      direction_ * rounded_difference(leading_now_.position, leading_last_.position, leading_modulo_);
  if (way < 0.0 || way > step) return Start::not_yet;

  profile_way_ = way + start_distance_;
  AxisPosition end = advanced(leading_last_.position, direction_ * profile_way_, leading_modulo_);
  if (profile_reference_ == kAheadFromHere) {
    master_sync_position_ = end.value;
    master_offset_ = end.value - cam_start() - cam_sync_way_;
  }
  if (ahead) end = leading_at(profile_way_);
  if (profile_reference_ == kSubsequentFromHere) {
    if (!place_cam_here(leading_last_.position)) return reject(ErrorId::outside_cam);
  } else {
    place_cam(ahead ? end : leading_at(way));
  }
  const double inside = follow_.way(end);
  const double tolerance = kSamePlace * follow_.pass_length();
  if (passed_once() && (inside < -tolerance || inside > follow_.pass_length() + tolerance))
    return reject(ErrorId::leading_distance);  // the cam is over before the axis follows it

  const CamPlace place = follow_.joined_at(end, direction_);
  take_joint(place, own.position.turns);
  curvature_ = stands_at(own, joint_) ? 0.0 : place.curvature;
  leading_start_ = leading_last_.position;
  const SyncStart start{.leading = leading_start_,
                        .leading_velocity = leading_last_.velocity,
                        .leading_acceleration = leading_last_.acceleration,
                        .following = own.position,
                        .velocity = own.velocity,
                        .acceleration = own.acceleration};
  SyncPlan plan = plan_along_tangent(start);
  if (plan == SyncPlan::kAxisMovesTheOtherWay && curvature_ != 0.0) {
    curvature_ = 0.0;  // only the acceleration of the cam stands against SyncDirection: it steps there
    plan = plan_along_tangent(start);
  }
  if (plan != SyncPlan::kReady) return reject(ErrorId::direction);
  // A profile within one tick is over before it is looked at.
  if (profile_way_ > step && shoots_beyond(distance_profile_.value(0.0), profile_way_))
    return reject(ErrorId::leading_distance);
  follow_.add_turns(distance_profile_.turns());
  joint_.turns += distance_profile_.turns();
  return begin_profile(Way::distance);
}

SyncPlan SynchronousMotion::plan_along_tangent(const SyncStart& start) noexcept {
  const SyncTarget target{.at_start = tangent(0.0).position, .slope = ratio_, .curvature = curvature_};
  return distance_profile_.plan(start, target, profile_way_, direction_ < 0,
                                static_cast<SyncDirection>(sync_direction_), leading_modulo_, following_);
}

/// Profile 0: the parabola that touches the cam in the synchronous position. Its bend counts as far as the
/// limits leave room for it; else the acceleration steps to that of the cam.
void SynchronousMotion::aim_at_cam(double way) noexcept {
  place_cam(leading_at(way));
  const CamPlace place = follow_.joined_at(leading_at(way), direction_);
  ratio_ = place.slope;
  const double bend = place.curvature * leading_now_.velocity * leading_now_.velocity;
  const double room = std::min(dynamics_.acceleration, dynamics_.deceleration);
  curvature_ = dynamics_.jerk > 0.0 && std::abs(bend) <= 0.5 * room ? place.curvature : 0.0;
  // In one direction a parabola that turns back, there or before, cannot be followed.
  const double begin_slope = ratio_ - curvature_ * direction_ * way;
  const bool against = forced_direction() * begin_slope * leading_now_.velocity < 0.0;
  if (forced_direction() != 0 && (ratio_ == 0.0 || against)) curvature_ = 0.0;
}

/// Whether the axis stands where the cam rests, and may not turn both ways: it stays. The acceleration steps
/// to that of the cam; to touch its bend as well the axis would have to come from where it must not go.
bool SynchronousMotion::stands_at(const Setpoint& own, AxisPosition joint) const noexcept {
  if (forced_direction() == 0 || ratio_ != 0.0 || !own.standing()) return false;
  return std::abs(shortest_distance(own.position.value, joint.value, following_)) <=
         kOnSynchronousValue * following_.length;
}

/// What a profile joins: the cam's tangent, or parabola, in the joint. @param way leading distance covered
Setpoint SynchronousMotion::tangent(double way) const noexcept {
  const double ahead = direction_ * (way - profile_way_);
  const double slope = ratio_ + curvature_ * ahead;
  const double velocity = leading_now_.velocity;
  return {advanced(joint_, ratio_ * ahead + 0.5 * curvature_ * ahead * ahead, following_), slope * velocity,
          curvature_ * velocity * velocity + slope * leading_now_.acceleration};
}

/// Profile 2: the positions at hand belong together from now on.
SynchronousMotion::Start SynchronousMotion::set_on_cam(const Setpoint& own) noexcept {
  place_cam(leading_last_.position);
  const AxisPosition place = follow_.value(leading_last_.position).position;
  if (following_.enabled) follow_.add_turns(own.position.turns - place.turns);
  const DoubleDouble apart = two_difference(own.position.value, place.value);
  begin_with_offset(apart);
  slave_offset_ = apart.hi;
  master_offset_ = leading_last_.position.value - cam_sync_way_ - cam_start();
  synchronous_ = true;
  return Start::synchronous;
}

/// Profile 5: where the active cam ends, or its pass, the new one takes over, whatever phase shift and offset
/// were in effect.
SynchronousMotion::Start SynchronousMotion::watch_cam_end(const SynchronousMotion* active) noexcept {
  const bool camming = active != nullptr && active->cam_ != nullptr && active->synchronous_ &&
                       active->leading_object() == leading_object();
  if (!camming) return reject(ErrorId::no_camming);
  if (active->sees_return()) return Start::not_yet;  // it is not where the leading axis is
  const DoubleDouble phase = active->phase_.value();
  const CamFollowing& old = active->follow_;
  // The active motion has not been advanced yet: what its phase shift will be decides whether it is at the
  // end.
  const DoubleDouble now =
      under_way(active->phase_) ? one_tick_on(active->phase_, leading_step()).value() : phase;
  const CamEnd end = old.end_before(advanced(leading_now_.position, now, leading_modulo_));
  if (end == CamEnd::none) return Start::not_yet;
  const CamFollowing::LeadingPlace place = old.end_place(end);
  const DoubleDouble leading = place.value - phase;
  const AxisPosition following = advanced(old.end_position(end), active->offset_.value(), following_);

  follow_.set_start(cam_->function(), cam_use_, place.turns, leading - cam_sync_way_, leading_modulo_,
                    following_);
  const CamFunction& f = cam_->function();
  const double at = f.start_leading_value() + cam_sync_way_ / cam_use_.master_scaling;
  const DoubleDouble apart = -two_product(f.value(at).position, cam_use_.slave_scaling) + following.value;
  follow_.add_turns(following.turns);
  begin_with_offset(apart);
  slave_offset_ = apart.hi;
  master_offset_ = normalised(0, leading, leading_modulo_).value - cam_sync_way_ - cam_start();
  synchronous_ = true;
  return Start::synchronous;
}

/// The new cam absorbs the position of both from the tick before; their velocities are no matter of either
/// cam and must not step. In this tick both go on as they would have, then they come to rest.
void SynchronousMotion::settle_shifts(const SynchronousMotion& ended, const Dynamics& dynamics) noexcept {
  const ProfileLimits limits{.velocity_max = dynamics.velocity,
                             .velocity_min = -dynamics.velocity,
                             .acceleration = dynamics.acceleration,
                             .deceleration = dynamics.deceleration,
                             .jerk = dynamics.jerk};
  if (under_way(ended.phase_)) {
    const Shift phase = one_tick_on(ended.phase_, leading_step());
    phase_shift().settle_at(phase.value() - ended.phase_.value(), phase, limits, period_);
  }
  if (under_way(ended.offset_)) {
    const Shift offset = one_tick_on(ended.offset_, leading_step());
    following_offset().settle_at(offset_.value() + (offset.value() - ended.offset_.value()), offset, limits,
                                 period_);
  }
}

// ---- Every tick
// -------------------------------------------------------------------------------------------------

/// effective leading value → + phase shift → cam, to `function_` and to `result`, as `evaluate_function`.
void SynchronousMotion::evaluate_cam(Setpoint& result) noexcept {
  AxisPosition leading = leading_now_.position;
  double velocity = leading_now_.velocity;
  double acceleration = leading_now_.acceleration;
  if (shifted_ && phase_.in_use()) {
    leading = advanced(leading, phase_.value(), leading_modulo_);
    velocity += phase_.velocity();
    acceleration += phase_.acceleration();
  }
  const CamPlace place = follow_.value(leading);
  result.position.turns = function_.position.turns = place.position.turns;
  result.position.value = function_.position.value = place.position.value;
  result.velocity = function_.velocity = place.slope * velocity;
  result.acceleration = function_.acceleration =
      place.curvature * velocity * velocity + place.slope * acceleration;
}

bool SynchronousMotion::rests_at_cam_end() const noexcept {
  return follow_.rests_at(follow_.ended()) && phase_.velocity() == 0.0 && offset_.velocity() == 0.0;
}

}  // namespace lockstep
