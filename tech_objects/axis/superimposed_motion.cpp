#include "tech_objects/axis/superimposed_motion.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// What a limit still leaves of `used`; nothing that is used leaves it all.
double rest_of(double limit, double used) noexcept {
  return std::max(limit - used, 0.0);
}

/// What a superimposed motion that comes to rest is left at least of the limits, or leaves; and what it is
/// given if the base motion leaves it less.
constexpr double kMinimumPart = 0.1;
constexpr double kHalf = 0.5;

Dynamics part_of(const Dynamics& whole, double part) noexcept {
  const double acceleration = part * std::min(whole.acceleration, whole.deceleration);
  return {whole.velocity, acceleration, acceleration, part * whole.jerk};
}

/// What is wanted, but no more than there is; a jerk of 0 is none that limits.
Dynamics braking(const Dynamics& wanted, const Dynamics& maximum, double velocity) noexcept {
  const bool jerk_limited = wanted.jerk > 0.0 && maximum.jerk > 0.0;
  return {.velocity = velocity,
          .acceleration = std::min(wanted.acceleration, maximum.acceleration),
          .deceleration = std::min(wanted.deceleration, maximum.deceleration),
          .jerk = jerk_limited ? std::min(wanted.jerk, maximum.jerk) : std::max(wanted.jerk, maximum.jerk)};
}

}  // namespace

double SuperimposedMotion::maximum_velocity(double direction) const noexcept {
  const double v = part_.velocity(), a = part_.acceleration();
  const double jerk = part_.dynamics().jerk;
  const double run_down = jerk > 0.0 ? a * std::abs(a) / (2.0 * jerk) : 0.0;
  return std::max({direction * v, direction * (v + run_down), 0.0});
}

// ---- Beginning and ending
// ---------------------------------------------------------------------------------------

void SuperimposedMotion::begin(const Setpoint& base, double acceleration) noexcept {
  if (!part_.in_use()) {
    base_ = base;
    part_.begin();
  }
  part_.cut_acceleration(acceleration);
}

PlanResult SuperimposedMotion::begin_motion(const Job& job, const BaseMotion& base,
                                            MotionLimits& limits) noexcept {
  const bool halts = job.kind == JobKind::MC_HaltSuperimposed;
  wanted_.velocity = halts ? limits.velocity() : limits.velocity_or_default(job);
  const Dynamics share = quick_enough(first_share(base, limits), base, limits);
  return halts ? part_.stop(share, job.as<StopJob>().abort_acceleration)
               : part_.move_by(job.as<DistanceJob>().distance, share);
}

void SuperimposedMotion::brake(const BaseMotion& base, MotionLimits& limits) noexcept {
  part_.cut_acceleration(limits.maximum().acceleration);
  wanted_ = limits.maximum();
  stop(first_share(base, limits), true);
  part_.advance();
}

void SuperimposedMotion::stop(const Dynamics& dynamics, bool abort_acceleration) noexcept {
  if (part_.stop(dynamics, abort_acceleration) != PlanResult::ok) part_.rest();
}

void SuperimposedMotion::reset() noexcept {
  part_.reset();
  base_curbed_ = curbed_for_a_while_ = false;
}

// ---- Shares of the limits
// ---------------------------------------------------------------------------------------

/// Dynamic values with which a superimposed motion begins. One that is under way has to brake even if the
/// base motion leaves nothing, at least of the jerk: by what its profile has had until now. Values that were
/// given had no share of their own: if there is next to none, half of the limits, and the base motion is
/// planned anew with the other half, which gives way no faster than its own jerk.
Dynamics SuperimposedMotion::first_share(const BaseMotion& base, MotionLimits& limits) noexcept {
  share_ = share(base, limits);
  if (part_.resting()) return share_;
  if (part_.planned()) {
    if (share_.acceleration > 0.0 && share_.deceleration > 0.0) return share_;
    return braking(wanted_, part_.dynamics(), share_.velocity);
  }
  const Dynamics maximum = limits.maximum();
  if (base.single_axis) {
    const double whole = std::min(maximum.acceleration, maximum.deceleration);
    part_.cut_acceleration(rest_of(whole, std::max(std::abs(base_.acceleration), kMinimumPart * whole)));
  }
  const Dynamics minimum = braking(wanted_, part_of(maximum, kMinimumPart), share_.velocity);
  const bool enough = share_.acceleration >= minimum.acceleration &&
                      share_.deceleration >= minimum.deceleration &&
                      (share_.jerk <= 0.0 || share_.jerk >= minimum.jerk);
  if (enough) return share_;
  Dynamics half = braking(wanted_, part_of(maximum, kHalf), share_.velocity);
  const double jerk = base.motion.dynamics().jerk;
  if (jerk > 0.0) half.jerk = std::min(half.jerk, jerk);
  limits.forget();
  return half;
}

/// Dynamic values for the distance of MC_MoveSuperimposed in this cycle. A synchronous motion is not limited
/// by the limits.
Dynamics SuperimposedMotion::share(const BaseMotion& base, const MotionLimits& limits) const noexcept {
  Dynamics share = wanted_;
  share.velocity = std::min(share.velocity * limits.override_velocity() / 100.0, limits.velocity());
  if (base.led) return share;
  const Dynamics left = left_by(base, limits);
  share.velocity = std::min(share.velocity, left.velocity);
  share.acceleration = std::min(share.acceleration, left.acceleration);
  share.deceleration = std::min(share.deceleration, left.deceleration);
  if (share.jerk > 0.0) share.jerk = std::min(share.jerk, left.jerk);
  const bool jerk_left = share.jerk > 0.0 || wanted_.jerk <= 0.0;
  if (!jerk_left) share.acceleration = share.deceleration = 0.0;
  return share;
}

/// What the limits leave beside a base motion of the axis' own, from now until its end: as long as it changes
/// its velocity, all but the dynamic values that it has, or what it has taken over beyond them and runs down.
/// At a constant velocity it may have to change it again, and is left half of the limits, or what it was
/// started with.
Dynamics SuperimposedMotion::left_by(const BaseMotion& base, const MotionLimits& limits) const noexcept {
  Dynamics left = limits.maximum();
  left.acceleration = left.deceleration = std::min(left.acceleration, left.deceleration);
  left.velocity = velocity_left_by(base, limits.velocity(), part_.direction());
  if (!base.single_axis || (base.motion.finished() && base.job == nullptr)) return left;
  const Dynamics used = base.motion.demand(base_);
  const bool changes = !base.motion.finished();
  const auto part = [changes](double limit, double used_part) {
    return changes ? rest_of(limit, used_part) : std::max(limit - used_part, 0.5 * limit);
  };
  left.acceleration = left.deceleration = part(left.acceleration, used.acceleration);
  left.jerk = part(left.jerk, used.jerk);
  return left;
}

/// What is left of the velocity limit in a direction, 1 or -1; 0: in either [u/s] ≥ 0.
double SuperimposedMotion::velocity_left_by(const BaseMotion& base, double velocity_limit,
                                            int side) const noexcept {
  const bool changes = base.single_axis && !base.motion.finished();
  double used = side == 0 ? std::abs(base_.velocity) : std::max(side * base_.velocity, 0.0);
  if (changes) used = side == 0 ? base.motion.demand(base_).velocity : base.motion.fastest(base_, side);
  return rest_of(velocity_limit, used);
}

/// The velocity limit counts more than the jerk: a present acceleration is run down before it is exceeded.
Dynamics SuperimposedMotion::quick_enough(Dynamics share, const BaseMotion& base,
                                          const MotionLimits& limits) noexcept {
  const double a = part_.acceleration();
  const int side = a < 0.0 ? -1 : 1;
  const double maximum = base.led ? limits.velocity() : velocity_left_by(base, limits.velocity(), side);
  const double left = rest_of(maximum, side * part_.velocity());
  const double maximum_jerk = limits.maximum().jerk;
  if (share.jerk > 0.0 && a * a > 2.0 * share.jerk * left)
    share.jerk = std::min(a * a / (2.0 * left), maximum_jerk);
  part_.cut_acceleration(std::sqrt(2.0 * maximum_jerk * left));
  return share;
}

Dynamics SuperimposedMotion::wanted_within(const TO_Struct_DynamicLimits& limits) const noexcept {
  Dynamics wanted = wanted_;
  wanted.acceleration = std::min(wanted.acceleration, limits.MaxAcceleration);
  wanted.deceleration = std::min(wanted.deceleration, limits.MaxDeceleration);
  return wanted;
}

PlanResult SuperimposedMotion::follow_share(const BaseMotion& base, const MotionLimits& limits) noexcept {
  const Dynamics now = share(base, limits);
  if (now == share_) return PlanResult::ok;
  share_ = now;
  return part_.make_room(quick_enough(now, base, limits));
}

// ---- The base motion beside it
// ----------------------------------------------------------------------------------

/// Whether a base motion that is planned anew with these values leaves a motion against it as it is.
bool SuperimposedMotion::stays_against(const BaseMotion& base, const Job* job,
                                       const Dynamics& dynamics) const noexcept {
  const int side = part_.direction();
  if (job == nullptr || side == 0 || base.motion.fastest(base_, side) > 0.0) return false;
  const Dynamics& before = base.motion.dynamics();
  const bool less_jerk = dynamics.jerk > 0.0 && (before.jerk <= 0.0 || dynamics.jerk < before.jerk);
  switch (job->kind) {
    case JobKind::MC_MoveVelocity:
      return side * job->velocity <= 0.0;
    case JobKind::MC_MoveJog:
      return side * job->as<JogJob>().direction <= 0;
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:  // with less it may pass its target and come back
      return dynamics.deceleration >= before.deceleration && !less_jerk;
    default:
      return false;
  }
}

void SuperimposedMotion::curb(Dynamics& dynamics, const Setpoint& now, const BaseMotion& base, const Job* job,
                              const MotionLimits& limits) noexcept {
  if (uses_.acceleration <= 0.0 || base.led) return;
  const Dynamics whole = dynamics;
  const Dynamics maximum = limits.maximum();
  const auto cut = [](double& value, double left) {
    if (left > 0.0) value = std::min(value, left);
  };
  // The one may brake in the direction in which the other speeds up.
  cut(dynamics.acceleration, maximum.acceleration - uses_.acceleration);
  cut(dynamics.deceleration, maximum.deceleration - uses_.acceleration);
  if (dynamics.jerk > 0.0 && uses_.jerk > 0.0) cut(dynamics.jerk, maximum.jerk - uses_.jerk);
  if (!stays_against(base, job, dynamics))
    dynamics.velocity = std::min(dynamics.velocity, rest_of(maximum.velocity, uses_.velocity));
  const double beside = maximum_velocity(now.acceleration < 0.0 ? -1.0 : 1.0);
  limits.keep_below(dynamics, now.acceleration, limits.margin(now, beside));
  base_curbed_ |= dynamics != whole;
  curbed_for_a_while_ = base_curbed_ && runs_down();
}

/// Whether the superimposed motion uses more than its dynamic values.
bool SuperimposedMotion::runs_down() const noexcept {
  const Dynamics& own = part_.dynamics();
  return uses_.velocity > own.velocity || uses_.acceleration > std::max(own.acceleration, own.deceleration);
}

SuperimposedMotion::Demand SuperimposedMotion::demand() const noexcept {
  const bool planned = part_.planned();
  return {planned, planned ? part_.demand() : Dynamics{}};
}

bool SuperimposedMotion::take_demand(const Demand& before) noexcept {
  uses_ = before.planned || part_.planned() ? part_.demand() : Dynamics{};
  uses_.velocity = std::max(uses_.velocity, before.dynamics.velocity);
  uses_.acceleration = std::max(uses_.acceleration, before.dynamics.acceleration);
  if (!curbed_for_a_while_ || runs_down()) return false;
  curbed_for_a_while_ = false;
  return true;
}

bool SuperimposedMotion::give_back() noexcept {
  const bool curbed = base_curbed_;
  base_curbed_ = curbed_for_a_while_ = false;
  return curbed;
}

}  // namespace lockstep
