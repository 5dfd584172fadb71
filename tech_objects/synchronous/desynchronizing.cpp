#include "tech_objects/synchronous/desynchronizing.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/profile/profile.hpp"

namespace lockstep {
namespace {

/// Most that the velocity of an axis may make, over the leading distance, of its distance to the stop
/// position, as a multiple of that distance: a leading value that creeps would throw the axis far beyond.
constexpr double kSteepestDesynchronizing = 20.0;

/// The velocity of the smoothest path to rest is (1 - u)² (s + (2 s + c) u), with the slope and the
/// curvature at its beginning over the distance: it does not change its sign where c ≥ -3 s. What a function
/// is bent beyond that the acceleration steps.
double without_turning_back(double curvature, double slope, double distance) noexcept {
  return std::max(curvature, -3.0 * std::max(slope, 0.0) / distance);
}

/// Over another distance w it is less by 30 u² (1 - u)² (s / 2 + c / 12 - w): positive to the end where
/// c ≤ 20 w - 8 s. An axis that makes more than its gear would pass the stop position and come back: its
/// acceleration steps as well, so that it is braked early enough.
double without_passing(double curvature, double slope, double stop_distance, double distance) noexcept {
  const double maximum = (20.0 * stop_distance / distance - 8.0 * slope) / distance;
  return without_turning_back(std::min(curvature, maximum), slope, distance);
}

/// The smoothest path to rest over a leading distance: its velocity is a cubic of that distance.
double distance_over(const Chain& chain, double distance, AxisPosition leading, int heading) noexcept {
  if (!chain.function.is_cam()) return 0.5 * std::abs(chain.function.ratio()) * distance;
  const int led = sign(chain.leading.step().distance());
  const AxisPosition shifted = advanced(leading, chain.shifts.phase().value(), chain.leading.modulo());
  const CamFollowingValue place = chain.function.cam().joined_at(shifted, led);
  const double slope = heading * led * place.slope;
  const double curvature = without_turning_back(heading * place.curvature, slope, distance);
  return 0.5 * slope * distance + curvature * distance * distance / 12.0;
}

/// Distance that the axis needs to stop in the direction it is heading [u]; NaN if that cannot be planned.
double stopping_distance(const Setpoint& from, int heading, const Dynamics& dynamics) noexcept {
  Profile profile;
  const double velocity = std::max(std::abs(from.velocity), dynamics.velocity);
  const ProfileLimits limits =
      limits_of({velocity, dynamics.deceleration, dynamics.deceleration, dynamics.jerk});
  const MotionState state{0.0, from.velocity, from.acceleration};
  if (plan_stop(state, limits, PresentAcceleration::keep, profile) != PlanResult::ok) return std::nan("");
  return heading * profile.target().position;
}

}  // namespace

/// Whether the axis comes, within this tick, to the place from which it comes to rest at the stop position:
/// what braking takes is looked at before and after the tick. Over a leading distance: while the leading
/// value stands, whatever else moves the axis, it has not come to any start.
bool Desynchronizing::meets(const Chain& chain, const LeavingRequest& request, const Setpoint& last,
                            const Setpoint& candidate, const Dynamics& dynamics) noexcept {
  const Modulo& following = chain.function.following();
  const double step = rounded_difference(candidate.position, last.position, following);
  const int heading = sign(step);
  if (heading == 0 || (request.direction == SyncDirection::kPositive && heading < 0) ||
      (request.direction == SyncDirection::kNegative && heading > 0))
    return false;
  chain.leading.look_at_last();
  const LeadingStep& leading_step = chain.leading.step();
  const bool over_distance = request.over_distance;
  const double distance = request.distance;
  const double led = leading_step.distance();
  if (over_distance && led == 0.0) return false;
  const auto braking = [&](const Setpoint& own, AxisPosition leading) noexcept {
    return over_distance ? distance_over(chain, distance, leading, heading)
                         : stopping_distance(own, heading, dynamics);
  };
  const double before = braking(last, leading_step.last.position);
  const double change = std::abs(step) + braking(candidate, leading_step.now.position) - before;
  const double target = normalised({0, request.position}, following).value;
  // Distance to the stop position; on a ring as many turns more as braking needs.
  double spare = heading * (target - last.position.value) - before;
  if (following.enabled) {
    spare = std::fmod(spare, following.length);
    if (spare < 0.0) spare += following.length;
  }
  if (!(change > 0.0) || !(spare >= 0.0 && spare <= change) || !(before + spare > 0.0)) return false;
  const double led_distance = (before + spare) * std::abs(leading_step.last.velocity);
  if (over_distance && std::abs(last.velocity) * distance > kSteepestDesynchronizing * led_distance)
    return false;
  stop_distance_ = heading * (before + spare);
  distance_ = distance + spare / change * std::abs(led);
  set_position(last, target, following);
  return true;
}

void Desynchronizing::set_position(const Setpoint& last, double target, const Modulo& following) noexcept {
  position_ = advanced(last.position, stop_distance_, following);
  if (following.enabled) {
    // The distance is rounded: at the end of the ring the turn may be the neighbour's.
    const double off = position_.value - target;
    if (off > 0.5 * following.length) ++position_.turns;
    if (off < -0.5 * following.length) --position_.turns;
  }
  position_.value = target;
}

void Desynchronizing::begin(const LeadingStep& leading, const Setpoint& last) noexcept {
  complete_ = false;
  progress_.begin(leading.last.position, sign(leading.distance()));
  SyncOffset start{.position = -stop_distance_};
  const int direction = progress_.direction();
  const double distance_velocity = direction * leading.last.velocity;
  if (distance_velocity > 0.0) {
    start.slope = last.velocity / distance_velocity;
    start.curvature = (last.acceleration - start.slope * direction * leading.last.acceleration) /
                      (distance_velocity * distance_velocity);
  }
  const double heading = stop_distance_ < 0.0 ? -1.0 : 1.0;
  start.curvature = heading * without_passing(heading * start.curvature, heading * start.slope,
                                              std::abs(stop_distance_), distance_);
  remainder_.set(start, distance_);
}

void Desynchronizing::advance(const LeadingStep& leading, const Modulo& following,
                              Setpoint& setpoint) noexcept {
  const int direction = progress_.direction();
  const double distance = progress_.covered(leading);
  const SyncOffset left = remainder_.value(distance);
  complete_ = remainder_.complete(distance);
  setpoint.position = advanced(position_, left.position, following);
  setpoint.velocity = left.velocity(direction * leading.now.velocity);
  setpoint.acceleration =
      left.acceleration(direction * leading.now.velocity, direction * leading.now.acceleration);
}

}  // namespace lockstep
