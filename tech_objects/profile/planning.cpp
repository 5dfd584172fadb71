// The planning functions of profile.hpp: what may be planned, and whether the plan has come out.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/profile/position.hpp"
#include "tech_objects/profile/profile.hpp"

namespace lockstep {
namespace {

constexpr double kMinimum = 1e-100;
constexpr double kMaximum = 1e100;

bool finite(const ProfileLimits& limits) noexcept {
  return std::isfinite(limits.velocity_max) && std::isfinite(limits.velocity_min) &&
         std::isfinite(limits.acceleration) && std::isfinite(limits.deceleration) &&
         std::isfinite(limits.jerk);
}

bool in_range(double magnitude) noexcept {
  return magnitude >= kMinimum && magnitude <= kMaximum;
}

PlanResult check(const MotionState& start, double target_position, double target_velocity,
                 const ProfileLimits& limits) noexcept {
  if (!std::isfinite(start.position) || !std::isfinite(start.velocity) ||
      !std::isfinite(start.acceleration) || !std::isfinite(target_position) ||
      !std::isfinite(target_velocity))
    return PlanResult::not_finite;
  if (!finite(limits) || limits.velocity_max <= 0.0 || limits.velocity_min >= 0.0 ||
      limits.acceleration <= 0.0 || limits.deceleration <= 0.0 || limits.jerk < 0.0)
    return PlanResult::limits_invalid;
  if (target_velocity > limits.velocity_max || target_velocity < limits.velocity_min)
    return PlanResult::beyond_limits;
  if (!in_range(limits.velocity_max) || !in_range(-limits.velocity_min) || !in_range(limits.acceleration) ||
      !in_range(limits.deceleration) || (limits.jerk != 0.0 && !in_range(limits.jerk)) ||
      std::abs(start.position) > kMaximum || std::abs(start.velocity) > kMaximum ||
      std::abs(start.acceleration) > kMaximum || std::abs(target_position) > kMaximum)
    return PlanResult::not_representable;
  return PlanResult::ok;
}

/// Squares and products of extreme numbers may have left the range on the way: then the phases do not lead to
/// the target.
bool reaches_target(const Profile& profile) noexcept {
  const MotionState& target = profile.target();
  if (profile.phases().empty())
    return std::abs(profile.start().position - target.position) <= 1e-12 * std::abs(target.position);
  double fastest = std::abs(target.velocity);
  for (const Profile::Phase& phase : profile.phases())
    fastest = std::max(fastest, std::abs(phase.state.velocity));
  const double reached = profile.phases().back().at(profile.duration()).position;
  const double distances =
      std::abs(profile.start().position) + std::abs(target.position) + fastest * profile.duration();
  return std::abs(reached - target.position) <= 1e-9 * distances &&
         distances <= std::numeric_limits<double>::max();
}

}  // namespace

PlanResult plan_velocity(const MotionState& start, double target_velocity, const ProfileLimits& limits,
                         Profile& out) noexcept {
  if (const PlanResult checked = check(start, 0.0, target_velocity, limits); checked != PlanResult::ok)
    return checked;
  Profile profile;
  PositionPlanner{start, target_velocity, limits}.plan_direct(profile);
  if (!reaches_target(profile)) return PlanResult::not_representable;
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
  if (!reaches_target(profile)) return PlanResult::not_representable;
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
