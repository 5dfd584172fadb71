// Onto a cam, and from cam to cam.
#include <algorithm>
#include <cmath>

#include "tech_objects/synchronous/synchronizing.hpp"

namespace lockstep {

// ---- Waiting
// ----------------------------------------------------------------------------------------------------

Synchronizing::Start Synchronizing::watch_cam(const Chain& chain, const Setpoint& own,
                                              const ChainView* active) noexcept {
  if (rule_ == SyncStartRule::at_cam_end) return watch_cam_end(chain, active);
  if (rule_ == SyncStartRule::direct) return set_on_cam(chain, own);
  if (stands_on_cam(chain, own)) return Start::synchronous;
  progress_.set_direction(sign(chain.leading.step().distance()));
  if (progress_.direction() == 0) return Start::not_yet;
  const Start start =
      rule_ == SyncStartRule::dynamics ? watch_time(chain, own) : watch_cam_distance(chain, own);
  if (start != Start::synchronizing) progress_.set_direction(0);
  return start;
}

/// Whether both axes stand where they would be synchronous; then the cam is placed there. From here on, that
/// is where the cam lies without being shifted.
bool Synchronizing::stands_on_cam(const Chain& chain, const Setpoint& own) noexcept {
  CamCoupling& cam = chain.function.cam();
  const Modulo& following = chain.function.following();
  const AxisPosition leading = chain.leading.last().position;
  const bool from_here = rule_ == SyncStartRule::subsequent_from_here;
  if (from_here) {
    if (!own.standing() || chain.leading.now().velocity != 0.0) return false;
    if (!cam.place_here(leading)) return false;
    leading_sync_position_ = leading.value;
    const AxisPosition there = advanced(cam.value(leading).position, cam.following_offset(), following);
    following_sync_position_ = there.value;
  }
  if (!standing_on_sync_positions(chain, own)) return false;
  progress_.set_direction(1);
  const double distance = shortest_distance(leading.value, leading_sync_position_, chain.leading.modulo());
  const AxisPosition place = leading_at(chain, distance);
  if (!from_here) cam.place(place);
  const double to_go = shortest_distance(own.position.value, following_sync_position_, following);
  take_joint(chain, cam.joined_at(place, progress_.direction()),
             advanced(own.position, to_go, following).turns);
  return true;
}

/// Where profile and cam meet: the cam is moved by whole turns, so that it is there.
void Synchronizing::take_joint(const Chain& chain, const CamFollowingValue& place,
                               std::int64_t turns) noexcept {
  CamCoupling& cam = chain.function.cam();
  const Modulo& following = chain.function.following();
  joint_ = advanced(place.position, cam.following_offset(), following);
  slope_ = place.slope;
  if (!following.enabled) return;
  cam.add_turns(turns - joint_.turns);
  joint_.turns = turns;
}

/// Over a leading distance, from the last tick before the start is crossed.
Synchronizing::Start Synchronizing::watch_cam_distance(const Chain& chain, const Setpoint& own) noexcept {
  CamCoupling& cam = chain.function.cam();
  const Modulo& following = chain.function.following();
  const Setpoint& from = chain.leading.last();
  const int direction = progress_.direction();
  double distance = 0.0;  // to the start
  if (rule_ == SyncStartRule::ahead)
    distance = distance_to(chain, leading_sync_position_ - direction * start_distance_);
  if (rule_ == SyncStartRule::subsequent) distance = distance_to(chain, leading_sync_position_);
  const double step = direction * chain.leading.step().distance();
  if (distance < 0.0 || distance > step) return Start::not_yet;

  distance_ = distance + start_distance_;
  AxisPosition end = advanced(from.position, direction * distance_, chain.leading.modulo());
  if (const SyncRefusal why = place_for_distance(chain, distance, end); why != SyncRefusal::none)
    return reject(why);
  if (cam.beyond_one_pass(end)) return reject(SyncRefusal::leading_distance);  // before the axis follows it

  const CamFollowingValue place = cam.joined_at(end, direction);
  take_joint(chain, place, own.position.turns);
  curvature_ = stands_at(own, joint_, following) ? 0.0 : place.curvature;
  const SyncStart start = start_from(from, own);
  SyncPlan plan = plan_along_tangent(chain, start);
  if (plan == SyncPlan::kAxisMovesInOppositeDirection && curvature_ != 0.0) {
    curvature_ = 0.0;  // only the acceleration of the cam stands against SyncDirection: it steps there
    plan = plan_along_tangent(chain, start);
  }
  if (plan != SyncPlan::kReady) return reject(SyncRefusal::direction);
  // A profile within one tick is over before it is looked at.
  if (distance_ > step && shoots_beyond(distance_profile_.value(0.0), distance_, following))
    return reject(SyncRefusal::leading_distance);
  cam.add_turns(distance_profile_.turns());
  joint_.turns += distance_profile_.turns();
  return begin_profile(Method::distance, from.position);
}

/// Places the cam for a profile that ends at a leading position, which may be given its exact name.
SyncRefusal Synchronizing::place_for_distance(const Chain& chain, double distance,
                                              AxisPosition& end) noexcept {
  CamCoupling& cam = chain.function.cam();
  if (rule_ == SyncStartRule::subsequent_from_here)
    return cam.place_here(chain.leading.last().position) ? SyncRefusal::none : SyncRefusal::outside_cam;
  if (rule_ == SyncStartRule::ahead_from_here) {
    leading_sync_position_ = end.value;
    cam.offset_to(end.value);
  }
  if (rule_ == SyncStartRule::subsequent) {
    cam.place(leading_at(chain, distance));
  } else {
    end = leading_at(chain, distance_);
    cam.place(end);
  }
  return SyncRefusal::none;
}

SyncPlan Synchronizing::plan_along_tangent(const Chain& chain, const SyncStart& start) noexcept {
  const SyncTarget target{.at_start = tangent(chain, 0.0).position, .slope = slope_, .curvature = curvature_};
  return distance_profile_.plan(start, target, distance_, progress_.direction() < 0, direction_,
                                chain.leading.modulo(), chain.function.following());
}

/// In time: the parabola that touches the cam in the synchronous position. Its bend counts as far as the
/// limits leave a margin for it; else the acceleration steps to that of the cam.
void Synchronizing::aim_at_cam(const Chain& chain, double distance) noexcept {
  CamCoupling& cam = chain.function.cam();
  const double velocity = chain.leading.now().velocity;
  const int direction = progress_.direction();
  const AxisPosition leading = leading_at(chain, distance);
  cam.place(leading);
  const CamFollowingValue place = cam.joined_at(leading, direction);
  slope_ = place.slope;
  const double bend = place.curvature * velocity * velocity;
  const double margin = std::min(dynamics_.acceleration, dynamics_.deceleration);
  curvature_ = dynamics_.jerk > 0.0 && std::abs(bend) <= 0.5 * margin ? place.curvature : 0.0;
  // In one direction a parabola that turns back, there or before, cannot be followed.
  const int forced = forced_direction(chain.function.following());
  const double begin_slope = slope_ - curvature_ * direction * distance;
  const bool against = forced * begin_slope * velocity < 0.0;
  if (forced != 0 && (slope_ == 0.0 || against)) curvature_ = 0.0;
}

/// Whether the axis stands where the cam rests, and may not turn both ways: it stays. The acceleration steps
/// to that of the cam; to touch its bend as well the axis would have to come from where it must not go.
bool Synchronizing::stands_at(const Setpoint& own, AxisPosition joint,
                              const Modulo& following) const noexcept {
  if (forced_direction(following) == 0 || slope_ != 0.0 || !own.standing()) return false;
  return std::abs(shortest_distance(own.position.value, joint.value, following)) <=
         kOnSynchronousValue * following.length;
}

/// What a profile joins: the cam's tangent, or parabola, in the joint. @param distance leading distance
/// covered
Setpoint Synchronizing::tangent(const Chain& chain, double distance) const noexcept {
  const double ahead = progress_.direction() * (distance - distance_);
  const double slope = slope_ + curvature_ * ahead;
  const double velocity = chain.leading.now().velocity;
  return {advanced(joint_, slope_ * ahead + 0.5 * curvature_ * ahead * ahead, chain.function.following()),
          slope * velocity, curvature_ * velocity * velocity + slope * chain.leading.now().acceleration};
}

/// The positions at hand belong together from now on.
Synchronizing::Start Synchronizing::set_on_cam(const Chain& chain, const Setpoint& own) noexcept {
  CamCoupling& cam = chain.function.cam();
  const DoubleDouble apart = cam.place_at(chain.leading.last().position, own.position);
  chain.shifts.begin_with_offset(apart);
  cam.set_following_offset(apart.hi);
  return Start::synchronous;
}

/// Where the active cam ends, or its pass, the new one takes over, whatever phase shift and offset were in
/// effect.
Synchronizing::Start Synchronizing::watch_cam_end(const Chain& chain, const ChainView* active) noexcept {
  const bool camming =
      active != nullptr && active->function.is_cam() && active->leading.of_same_source(chain.leading);
  if (!camming) return reject(SyncRefusal::no_cam_followed);
  if (active->leading.sees_return()) return Start::not_yet;  // it is not where the leading axis is
  const Shift& shift = active->shifts.phase();
  const DoubleDouble phase = shift.value();
  const CamCoupling& old = active->function.cam();
  // The active motion has not been advanced yet: what its phase shift will be decides whether it is at the
  // end.
  const DoubleDouble now = in_progress(shift) ? one_tick_on(shift, chain.leading.step()).value() : phase;
  const CamEnd end = old.end_before(advanced(chain.leading.now().position, now, chain.leading.modulo()));
  if (end == CamEnd::none) return Start::not_yet;
  const AxisPosition following =
      advanced(old.end_position(end), active->shifts.offset().value(), chain.function.following());
  CamCoupling& cam = chain.function.cam();
  const DoubleDouble apart = cam.place_at_end(old.end_place(end), phase, following);
  chain.shifts.begin_with_offset(apart);
  cam.set_following_offset(apart.hi);
  return Start::synchronous;
}

}  // namespace lockstep
