// Out of a gear or cam to rest at a position: MC_GearOut, and what MC_CamOut shares with it.
#include <algorithm>
#include <cmath>

#include "tech_objects/cam/cam.hpp"
#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {
namespace {

/// Most that the velocity of an axis may make, over the leading distance, of its way to the stop position, as
/// a multiple of that way: a leading value that creeps would throw the axis far beyond.
constexpr double kSteepest = 20.0;

}  // namespace

/// Whether the axis comes, within this tick, to the place from which it comes to rest at the stop position:
/// what braking takes is looked at before and after the tick. Over a leading distance: while the leading
/// value stands, whatever else moves the axis, it has not come to any start.
bool SynchronousMotion::meets_sync_out(const Job& job, const Setpoint& last, const Setpoint& candidate,
                                       const Dynamics& dynamics) noexcept {
  const double step = rounded_difference(candidate.position, last.position, following_);
  const int heading = sign(step);
  if (heading == 0 || (job.direction == 1 && heading < 0) || (job.direction == 2 && heading > 0))
    return false;
  if (!additive_->in_use && leading_->source->leads_as_it_is(leading_->coupling))
    leading_last_ = leading_->source->last_leading_state(leading_->coupling);
  const bool over_distance = job.mode == 1;
  const double distance = job.master_start_distance;
  const double led = leading_step().way();
  if (over_distance && led == 0.0) return false;
  const auto braking = [&](const Setpoint& own, AxisPosition leading) noexcept {
    return over_distance ? way_over(distance, leading, heading) : stopping_way(own, heading, dynamics);
  };
  const double before = braking(last, leading_last_.position);
  const double change = std::abs(step) + braking(candidate, leading_now_.position) - before;
  const double target = normalised({0, job.position}, following_).value;
  // Way to the stop position; on a ring as many turns more as braking needs.
  double spare = heading * (target - last.position.value) - before;
  if (following_.enabled) {
    spare = std::fmod(spare, following_.length);
    if (spare < 0.0) spare += following_.length;
  }
  if (!(change > 0.0) || !(spare >= 0.0 && spare <= change) || !(before + spare > 0.0)) return false;
  const double led_way = (before + spare) * std::abs(leading_last_.velocity);
  if (over_distance && std::abs(last.velocity) * distance > kSteepest * led_way) return false;
  out_way_ = heading * (before + spare);
  out_distance_ = distance + spare / change * std::abs(led);
  set_out_position(last, target);
  return true;
}

/// The least curved way to rest over a leading distance: its velocity is a cubic of that distance.
double SynchronousMotion::way_over(double distance, AxisPosition leading, int heading) const noexcept {
  if (cam_ == nullptr) return 0.5 * std::abs(ratio_) * distance;
  const int led = sign(leading_step().way());
  const CamPlace place = follow_.joined_at(advanced(leading, phase_.value(), leading_modulo_), led);
  const double slope = heading * led * place.slope;
  const double curvature = without_turning_back(heading * place.curvature, slope, distance);
  return 0.5 * slope * distance + curvature * distance * distance / 12.0;
}

void SynchronousMotion::set_out_position(const Setpoint& last, double target) noexcept {
  out_position_ = advanced(last.position, out_way_, following_);
  if (following_.enabled) {
    // The way is rounded: at the end of the ring the turn may be the neighbour's.
    const double off = out_position_.value - target;
    if (off > 0.5 * following_.length) ++out_position_.turns;
    if (off < -0.5 * following_.length) --out_position_.turns;
  }
  out_position_.value = target;
}

/// Way that the axis needs to stop in the direction it is heading [u]; NaN if that cannot be planned.
double SynchronousMotion::stopping_way(const Setpoint& from, int heading,
                                       const Dynamics& dynamics) const noexcept {
  Profile profile;
  const double velocity = std::max(std::abs(from.velocity), dynamics.velocity);
  const ProfileLimits limits{.velocity_max = velocity,
                             .velocity_min = -velocity,
                             .acceleration = dynamics.deceleration,
                             .deceleration = dynamics.deceleration,
                             .jerk = dynamics.jerk};
  const MotionState state{0.0, from.velocity, from.acceleration};
  if (plan_stop(state, limits, PresentAcceleration::keep, profile) != PlanResult::ok) return std::nan("");
  return heading * profile.target().position;
}

/// The velocity of the least curved way to rest is (1 - u)² (s + (2 s + c) u), with the slope and the
/// curvature at its beginning over the distance: it does not change its sign where c ≥ -3 s. What a function
/// is bent beyond that the acceleration steps.
double SynchronousMotion::without_turning_back(double curvature, double slope, double distance) noexcept {
  return std::max(curvature, -3.0 * std::max(slope, 0.0) / distance);
}

/// Over another way w it is less by 30 u² (1 - u)² (s / 2 + c / 12 - w): positive to the end where
/// c ≤ 20 w - 8 s. An axis that makes more than its gear would pass the stop position and come back: its
/// acceleration steps as well, so that it is braked early enough.
double SynchronousMotion::without_passing(double curvature, double slope, double way,
                                          double distance) noexcept {
  const double most = (20.0 * way / distance - 8.0 * slope) / distance;
  return without_turning_back(std::min(curvature, most), slope, distance);
}

void SynchronousMotion::begin_sync_out(const Setpoint& last) noexcept {
  way_ = Way::out;
  phase_.reset();
  offset_.reset();
  shifted_ = false;
  synchronous_ = false;
  reversed_ = false;
  desynchronized_ = false;
  look_at_leading();
  direction_ = sign(leading_step().way());
  progress_ = 0.0;
  furthest_ = 0.0;
  leading_start_ = leading_last_.position;
  SyncOffset start{.position = -out_way_};
  const double way_velocity = direction_ * leading_last_.velocity;
  if (way_velocity > 0.0) {
    start.slope = last.velocity / way_velocity;
    start.curvature = (last.acceleration - start.slope * direction_ * leading_last_.acceleration) /
                      (way_velocity * way_velocity);
  }
  const double heading = out_way_ < 0.0 ? -1.0 : 1.0;
  start.curvature = heading * without_passing(heading * start.curvature, heading * start.slope,
                                              std::abs(out_way_), out_distance_);
  out_remainder_.set(start, out_distance_);
}

/// MC_GearOut profile 1: what is left of the way to the stop position.
void SynchronousMotion::advance_out(Setpoint& setpoint) noexcept {
  const double way = covered();
  const SyncOffset left = out_remainder_.value(way);
  desynchronized_ = out_remainder_.complete(way);
  setpoint.position = advanced(out_position_, left.position, following_);
  setpoint.velocity = left.velocity(direction_ * leading_now_.velocity);
  setpoint.acceleration =
      left.acceleration(direction_ * leading_now_.velocity, direction_ * leading_now_.acceleration);
  function_ = setpoint;
}

}  // namespace lockstep
