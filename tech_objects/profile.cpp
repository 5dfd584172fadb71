#include "tech_objects/profile.hpp"

#include <cmath>

#include "tech_objects/profile_position.hpp"

namespace lockstep {
namespace {

PlanResult check(const MotionState& start, double target_position, double target_velocity,
                 const ProfileLimits& limits) noexcept {
  if (!std::isfinite(start.position) || !std::isfinite(start.velocity) ||
      !std::isfinite(start.acceleration) || !std::isfinite(target_position) ||
      !std::isfinite(target_velocity))
    return PlanResult::not_finite;
  if (!std::isfinite(limits.velocity_max) || !std::isfinite(limits.velocity_min) ||
      !std::isfinite(limits.acceleration) || !std::isfinite(limits.deceleration) ||
      !std::isfinite(limits.jerk))
    return PlanResult::limits_invalid;
  if (limits.velocity_max <= 0.0 || limits.velocity_min >= 0.0 || limits.acceleration <= 0.0 ||
      limits.deceleration <= 0.0 || limits.jerk < 0.0)
    return PlanResult::limits_invalid;
  if (target_velocity > limits.velocity_max || target_velocity < limits.velocity_min)
    return PlanResult::beyond_limits;
  return PlanResult::ok;
}

bool representable(const Profile& profile) noexcept {
  if (!std::isfinite(profile.duration())) return false;
  for (const Profile::Phase& phase : profile.phases())
    if (!std::isfinite(phase.state.position) || !std::isfinite(phase.state.velocity) ||
        !std::isfinite(phase.state.acceleration))
      return false;
  return std::isfinite(profile.target().position);
}

}  // namespace

MotionState Profile::at(double t) const noexcept {
  if (!(t > 0.0)) return start_;
  if (t >= duration_)
    return {
        target_.velocity == 0.0 ? target_.position : target_.position + target_.velocity * (t - duration_),
        target_.velocity, 0.0};
  const Phase* phase = phases_.data();
  const Phase* const last = phase + (count_ - 1);
  while (phase != last && t >= phase[1].begin) ++phase;
  const double dt = t - phase->begin;
  const MotionState& s = phase->state;
  const double half_jerk = phase->jerk * 0.5;
  return {s.position + dt * (s.velocity + dt * (s.acceleration * 0.5 + dt * half_jerk * (1.0 / 3.0))),
          s.velocity + dt * (s.acceleration + dt * half_jerk), s.acceleration + dt * phase->jerk};
}

PlanResult plan_velocity(const MotionState& start, double target_velocity, const ProfileLimits& limits,
                         Profile& out) noexcept {
  if (const PlanResult checked = check(start, 0.0, target_velocity, limits); checked != PlanResult::ok)
    return checked;
  Profile profile;
  PositionPlanner{start, target_velocity, limits}.plan_direct(profile);
  if (!representable(profile)) return PlanResult::not_representable;
  out = profile;
  return PlanResult::ok;
}

PlanResult plan_position(const MotionState& start, double target_position, double target_velocity,
                         const ProfileLimits& limits, Profile& out) noexcept {
  if (const PlanResult checked = check(start, target_position, target_velocity, limits);
      checked != PlanResult::ok)
    return checked;
  Profile profile;
  PositionPlanner{start, target_velocity, limits}.plan_to(target_position, profile);
  if (!representable(profile)) return PlanResult::not_representable;
  out = profile;
  return PlanResult::ok;
}

PlanResult plan_stop(const MotionState& start, const ProfileLimits& limits, PresentAcceleration present,
                     Profile& out) noexcept {
  MotionState from = start;
  const bool speeds_up = start.velocity < 0.0 ? start.acceleration < 0.0 : start.acceleration > 0.0;
  if (present == PresentAcceleration::abort && (speeds_up || start.velocity == 0.0)) from.acceleration = 0.0;
  return plan_velocity(from, 0.0, limits, out);
}

}  // namespace lockstep
