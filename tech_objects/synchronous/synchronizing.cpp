// What gear and cam share on the way in, and the gear.
#include "tech_objects/synchronous/synchronizing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/profile/velocity_tracking.hpp"

namespace lockstep {
namespace {

/// How close "standing on the synchronous position" is, relative to the position: rounding of the last
/// motion.
constexpr double kSamePosition = 1e-14;

/// No distance that an axis could be seen to make in a tick [u].
constexpr double kNoDistance = 1e-6;

/// Most that velocity and acceleration of the axis may make of its distance over the leading distance, as a
/// multiple of that distance: the quintic then stays within some ten times the distance.
constexpr double kSteepestSynchronizing = 100.0;

bool same_place(double distance, double position) noexcept {
  return std::abs(distance) <= kSamePosition * std::max(1.0, std::abs(position));
}

}  // namespace

// ---- Beginning
// --------------------------------------------------------------------------------------------------

void Synchronizing::couple(const CouplingRequest& request, double ratio) noexcept {
  method_ = Method::none;
  progress_.begin({}, 0);
  slope_ = ratio;
  curvature_ = 0.0;
  dynamics_ = request.dynamics;
  watched_acceleration_ = 0.0;
}

SyncRefusal Synchronizing::begin_waiting(const CouplingRequest& request, const Chain& chain,
                                         const Setpoint& own) noexcept {
  const Modulo& leading = chain.leading.modulo();
  const Modulo& following = chain.function.following();
  rule_ = request.start;
  direction_ = request.direction;
  start_distance_ = request.leading_distance;
  if (chain.function.is_cam()) {
    CamCoupling& cam = chain.function.cam();
    if (const SyncRefusal why = cam.begin(request, leading, following); why != SyncRefusal::none) return why;
    leading_sync_position_ = cam.leading_sync_position();
    following_sync_position_ = cam.following_sync_position();
    chain.shifts.begin_with_offset(to_double_double(cam.following_offset()));
    if (rule_ == SyncStartRule::subsequent_from_here && !cam.place_here(chain.leading.now().position))
      return SyncRefusal::outside_cam;
  } else {
    leading_sync_position_ = normalised({0, request.leading_position}, leading).value;
    following_sync_position_ = normalised({0, request.following_position}, following).value;
  }
  if (rule_ != SyncStartRule::ahead || leading.enabled || standing_on_sync_positions(chain, own))
    return SyncRefusal::none;
  // On a line the whole distance has to be ahead; a standing leading axis is judged in both directions.
  const double to_go = leading_sync_position_ - chain.leading.now().position.value;
  const int heading = sign(chain.leading.now().velocity);
  const bool is_ahead = heading == 0 || heading * to_go >= 0.0;
  return is_ahead && std::abs(to_go) < start_distance_ ? SyncRefusal::leading_distance : SyncRefusal::none;
}

bool Synchronizing::standing_on_sync_positions(const Chain& chain, const Setpoint& own) const noexcept {
  const Modulo& following = chain.function.following();
  const double leading = chain.leading.now().position.value;
  const double here = own.position.value;
  return own.standing() && chain.leading.now().velocity == 0.0 && chain.leading.last().velocity == 0.0 &&
         same_place(shortest_distance(leading, leading_sync_position_, chain.leading.modulo()), leading) &&
         (same_place(shortest_distance(here, following_sync_position_, following), here) ||
          on_following_sync_position(here, following));
}

/// On a ring up to what the rounding of several motions leaves. The axis is put there in one tick, so that a
/// long ring must not make it more than nobody sees.
bool Synchronizing::on_following_sync_position(double here, const Modulo& following) const noexcept {
  return following.enabled && std::abs(shortest_distance(here, following_sync_position_, following)) <=
                                  std::min(kOnSynchronousValue * following.length, kNoDistance);
}

Synchronizing::Start Synchronizing::reject(SyncRefusal why) noexcept {
  refusal_ = why;
  return Start::rejected;
}

// ---- Waiting
// ----------------------------------------------------------------------------------------------------

Synchronizing::Start Synchronizing::watch(const Chain& chain, const Setpoint& own,
                                          const ChainView* active) noexcept {
  watch_acceleration(chain);
  // Once it has been zero there is no leading value yet: what was zero meanwhile does not matter.
  if (chain.leading.forget_zero()) return Start::not_yet;
  return chain.function.is_cam() ? watch_cam(chain, own, active) : watch_gear(chain, own);
}

/// What the velocity of the leading value changes by, over so many ticks that the noise of an encoder does
/// not count: an extrapolated leading value tells no acceleration.
void Synchronizing::watch_acceleration(const Chain& chain) noexcept {
  const double change = (chain.leading.now().velocity - chain.leading.last().velocity) / chain.period;
  watched_acceleration_ += (change - watched_acceleration_) / kWatchedTicks;
}

Synchronizing::Start Synchronizing::watch_gear(const Chain& chain, const Setpoint& own) noexcept {
  const Modulo& following = chain.function.following();
  if (standing_on_sync_positions(chain, own)) {
    progress_.set_direction(1);
    const double distance = shortest_distance(chain.leading.last().position.value, leading_sync_position_,
                                              chain.leading.modulo());
    const double to_go = shortest_distance(own.position.value, following_sync_position_, following);
    anchor(chain, distance, advanced(own.position, to_go, following));
    return Start::synchronous;
  }
  progress_.set_direction(sign(chain.leading.step().distance()));
  if (progress_.direction() == 0) return Start::not_yet;
  const Start start = rule_ == SyncStartRule::dynamics ? watch_time(chain, own) : watch_distance(chain, own);
  if (start != Start::synchronizing) progress_.set_direction(0);
  return start;
}

/// Distance from the last leading position to a place, in the direction of motion [u]; negative: a linear
/// axis has passed it.
double Synchronizing::distance_to(const Chain& chain, double place) const noexcept {
  const Modulo& modulo = chain.leading.modulo();
  const double from = chain.leading.last().position.value;
  if (!modulo.enabled) return progress_.direction() * (place - from);
  const double target = normalised({0, place}, modulo).value;
  if (target == from) return 0.0;
  return progress_.direction() > 0 ? positive_distance(from, target, modulo)
                                   : -negative_distance(from, target, modulo);
}

/// Places the gear: the synchronous positions belong together, the leading one a distance ahead of the last
/// tick.
void Synchronizing::anchor(const Chain& chain, double distance, AxisPosition following) noexcept {
  following.value = following_sync_position_;
  chain.function.place_gear(leading_at(chain, distance), following);
}

/// The synchronous position of the leading axis, a distance ahead of the last tick.
AxisPosition Synchronizing::leading_at(const Chain& chain, double distance) const noexcept {
  const Modulo& modulo = chain.leading.modulo();
  AxisPosition leading = advanced(chain.leading.last().position, progress_.direction() * distance, modulo);
  if (modulo.enabled) {
    // The distance is rounded: at the end of the ring the turn may be the neighbour's.
    const double off = leading.value - leading_sync_position_;
    if (off > 0.5 * modulo.length) ++leading.turns;
    if (off < -0.5 * modulo.length) --leading.turns;
  }
  leading.value = leading_sync_position_;
  return leading;
}

/// Over a leading distance: starts at the last tick before the start position is crossed and spans the rest.
Synchronizing::Start Synchronizing::watch_distance(const Chain& chain, const Setpoint& own) noexcept {
  const bool in_advance = rule_ == SyncStartRule::ahead;
  const int direction = progress_.direction();
  const double start_place =
      in_advance ? leading_sync_position_ - direction * start_distance_ : leading_sync_position_;
  const double distance = distance_to(chain, start_place);
  const double step = direction * chain.leading.step().distance();
  if (distance < 0.0 || distance > step) return Start::not_yet;

  const double distance_to_sync = in_advance ? distance + start_distance_ : distance;
  distance_ = distance + start_distance_;
  AxisPosition following{own.position.turns, following_sync_position_};
  anchor(chain, distance_to_sync, following);
  const Setpoint& from = chain.leading.last();
  const SyncStart start = start_from(from, own);
  const SyncTarget target{.at_start = chain.function.gear_value(from.position),
                          .slope = chain.function.gear().ratio().rounded()};
  const SyncPlan plan = distance_profile_.plan(start, target, distance_, direction < 0, direction_,
                                               chain.leading.modulo(), chain.function.following());
  if (plan != SyncPlan::kReady) return reject(SyncRefusal::direction);
  if (shoots_beyond(distance_profile_.value(0.0), distance_, chain.function.following()))
    return reject(SyncRefusal::leading_distance);
  following.turns += distance_profile_.turns();
  anchor(chain, distance_to_sync, following);
  return begin_profile(Method::distance, from.position);
}

/// Whether velocity and acceleration of the axis, led on by a leading axis that creeps, would carry it far
/// beyond the distance that it has to make.
bool Synchronizing::shoots_beyond(const SyncOffset& start, double distance,
                                  const Modulo& following) const noexcept {
  const double turn = following.enabled ? following.length : std::numeric_limits<double>::infinity();
  const double natural = std::min(std::abs(start.position), turn) + std::abs(slope_) * distance;
  const double own = std::abs(start.slope) * distance + std::abs(start.curvature) * distance * distance;
  return own > kSteepestSynchronizing * natural;
}

Synchronizing::Start Synchronizing::begin_profile(Method method, AxisPosition start) noexcept {
  method_ = method;
  progress_.begin(start, progress_.direction());
  return Start::synchronizing;
}

// ---- Every tick
// -------------------------------------------------------------------------------------------------

/// Towards velocity and acceleration of the function; where both are met, the function begins.
bool Synchronizing::track(const Chain& chain, Setpoint& setpoint) noexcept {
  const GearFunction& gear = chain.function.gear();
  const Setpoint& leading = chain.leading.now();
  const bool holding = progress_.behind();  // reversed within the tolerance
  const double velocity = holding ? 0.0 : gear.velocity(leading.velocity);
  const double acceleration = holding ? 0.0 : gear.acceleration(leading.acceleration);
  const TrackingStep step =
      track_velocity({setpoint.velocity, setpoint.acceleration}, {velocity, acceleration},
                     {.velocity = dynamics_.velocity,
                      .acceleration = dynamics_.acceleration,
                      .deceleration = dynamics_.deceleration,
                      .jerk = dynamics_.jerk},
                     chain.period);
  setpoint.position = advanced(setpoint.position, step.distance, chain.function.following());
  setpoint.velocity = step.velocity;
  setpoint.acceleration = step.acceleration;
  chain.function.show(setpoint);
  if (!step.synchronous || holding) return false;
  if (!chain.leading.velocity_only()) chain.function.place_gear(leading.position, setpoint.position);
  return true;
}

bool Synchronizing::follow_profile(const Chain& chain, Setpoint& setpoint) const noexcept {
  const double distance = progress_.covered(chain.leading.step());
  if (distance >= distance_) return false;
  const SyncOffset rest = ahead(distance);
  const double distance_velocity = progress_.direction() * chain.leading.now().velocity;
  const double distance_acceleration = progress_.direction() * chain.leading.now().acceleration;
  const Setpoint joined = chain.function.is_cam() ? tangent(chain, distance) : chain.function.value();
  setpoint.position = advanced(joined.position, rest.position, chain.function.following());
  setpoint.velocity = joined.velocity + rest.velocity(distance_velocity);
  setpoint.acceleration = joined.acceleration + rest.acceleration(distance_velocity, distance_acceleration);
  return true;
}

/// What the axis is ahead of its function, over the leading distance covered.
SyncOffset Synchronizing::ahead(double distance) const noexcept {
  if (method_ == Method::distance) return distance_profile_.value(distance);
  const MotionState state = time_profile_.at(distance / time_velocity_);
  if (distance < 0.0) {  // turned back before the start, within the tolerance
    const double slope = state.velocity / time_velocity_;
    return {state.position + slope * distance, slope, 0.0};
  }
  return {state.position, state.velocity / time_velocity_,
          state.acceleration / (time_velocity_ * time_velocity_)};
}

}  // namespace lockstep
