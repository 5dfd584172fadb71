#include "tech_objects/profile/single_axis_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

/// Ticks after which an endless motion counts anew from where it is, so that its local positions stay small.
constexpr std::int64_t kRebaseTicks = 4096;

/// By what distances are apart by rounding, relative to them.
constexpr double kSameDirection = 1e-12;

/// Stands in for a velocity limit of zero (an override of 0 %), since the planner wants a positive one [u/s].
constexpr double kNoVelocity = 1e-12;

ProfileLimits profile_limits(const Dynamics& dynamics) noexcept {
  Dynamics positive = dynamics;
  positive.velocity = std::max(dynamics.velocity, kNoVelocity);
  return limits_of(positive);
}

MotionState local_state(const Setpoint& from) noexcept {
  return {0.0, from.velocity, from.acceleration};
}

/// Times in a phase at which the motion turns back, from its beginning [s]; NaN or outside: none.
std::array<double, 2> turning_times(const Profile::Phase& phase) noexcept {
  const double v = phase.state.velocity;
  const double a = phase.state.acceleration;
  if (phase.jerk == 0.0) return {-v / a, -v / a};
  const double root = std::sqrt(a * a - 2.0 * phase.jerk * v);
  return {(-a - root) / phase.jerk, (-a + root) / phase.jerk};
}

}  // namespace

void SingleAxisMotion::configure(const Modulo& modulo, double period) noexcept {
  modulo_ = modulo;
  period_ = period;
}

void SingleAxisMotion::begin(const Setpoint& from, Aim aim, const Dynamics& dynamics) noexcept {
  aim_ = aim;
  dynamics_ = dynamics;
  origin_.set(from.position);
  ticks_ = 0;
  walk_.begin();
  finished_ = false;
}

void SingleAxisMotion::stand(const Setpoint& from) noexcept {
  begin(from, Aim::stand, dynamics_);
  profile_ = Profile{};
  target_ = from.position;
  exact_target_ = true;
  target_velocity_ = 0.0;
  finished_ = true;
}

PlanResult SingleAxisMotion::move_to(const Setpoint& from, AxisPosition target, double distance,
                                     const Dynamics& dynamics, double end_velocity) noexcept {
  const PlanResult result =
      plan_position(local_state(from), distance, end_velocity, profile_limits(dynamics), profile_);
  if (result != PlanResult::ok) return result;
  begin(from, Aim::position, dynamics);
  target_ = target;
  exact_target_ = true;
  target_velocity_ = end_velocity;
  return result;
}

bool SingleAxisMotion::passes_ahead(const Setpoint& from, double distance, double end_velocity,
                                    const Dynamics& dynamics) const noexcept {
  Profile profile;
  if (plan_position(local_state(from), distance, end_velocity, profile_limits(dynamics), profile) !=
      PlanResult::ok)
    return false;
  for (const Profile::Phase& phase : profile.phases()) {
    if (phase.state.velocity * end_velocity < 0.0) return false;
    if (phase.jerk == 0.0) continue;
    // Within a phase of constant jerk the velocity has its minimum amount where the acceleration passes 0.
    const double t = phase.begin - phase.state.acceleration / phase.jerk;
    if (t > phase.begin && t < profile.duration() && profile.at(t).velocity * end_velocity < 0.0)
      return false;
  }
  return true;
}

PlanResult SingleAxisMotion::run_at(const Setpoint& from, double velocity,
                                    const Dynamics& dynamics) noexcept {
  const double limited = std::clamp(velocity, -dynamics.velocity, dynamics.velocity);
  const PlanResult result = plan_velocity(local_state(from), limited, profile_limits(dynamics), profile_);
  if (result != PlanResult::ok) return result;
  begin(from, Aim::velocity, dynamics);
  wanted_velocity_ = velocity;
  target_velocity_ = limited;
  exact_target_ = false;
  return result;
}

PlanResult SingleAxisMotion::stop(const Setpoint& from, const Dynamics& dynamics,
                                  bool abort_acceleration) noexcept {
  const PlanResult result =
      plan_stop(local_state(from), profile_limits(dynamics),
                abort_acceleration ? PresentAcceleration::abort : PresentAcceleration::keep, profile_);
  if (result != PlanResult::ok) return result;
  begin(from, Aim::stand, dynamics);
  exact_target_ = false;
  target_velocity_ = 0.0;
  target_ = advanced(from.position, profile_.target().position, modulo_);
  return result;
}

PlanResult SingleAxisMotion::replan(const Setpoint& from, const Dynamics& dynamics) noexcept {
  switch (aim_) {
    case Aim::position:
      if (dynamics.velocity == 0.0) {
        // An override of 0 %: brake, and keep the target for later.
        const PlanResult result = plan_velocity(local_state(from), 0.0, profile_limits(dynamics), profile_);
        if (result != PlanResult::ok) return result;
        begin(from, Aim::position, dynamics);
        exact_target_ = false;
        target_velocity_ = 0.0;
        return result;
      }
      return move_to(from, target_, rounded_difference(target_, from.position, modulo_), dynamics);
    case Aim::velocity:
      return run_at(from, wanted_velocity_, dynamics);
    case Aim::stand:
      break;
  }
  return PlanResult::ok;
}

/// Where it stands, in the first tick of a phase, and behind the end.
void SingleAxisMotion::advance_otherwise(Setpoint& setpoint) noexcept {
  if (stands()) {
    setpoint.velocity = 0.0;
    setpoint.acceleration = 0.0;
    return;
  }
  const double t = static_cast<double>(++ticks_) * period_;
  const bool over = !walk_.within(t * kSameTime) && t * kSameTime >= profile_.duration();
  const MotionState state = over ? profile_.at(std::max(t, profile_.duration())) : walk_.at(profile_, t);
  if (!over) return go_on(state, setpoint);
  const bool passes = aim_ == Aim::position && target_velocity_ != 0.0;
  if (exact_target_ && !passes)
    setpoint = {target_, state.velocity, state.acceleration};
  else
    go_on(state, setpoint);
  finished_ =
      aim_ != Aim::position || exact_target_;  // braked short of its target, a positioning goes on later
  if (aim_ == Aim::velocity && target_velocity_ != 0.0 && ticks_ >= kRebaseTicks) {
    const Dynamics dynamics = dynamics_;
    run_at(setpoint, wanted_velocity_, dynamics);
    finished_ = true;
  }
}

Dynamics SingleAxisMotion::demand(const Setpoint& now) const noexcept {
  const double v = now.velocity, a = now.acceleration;
  const double run_down = dynamics_.jerk > 0.0 ? a * std::abs(a) / (2.0 * dynamics_.jerk) : 0.0;
  const double own = std::max(dynamics_.acceleration, dynamics_.deceleration);
  const double maximum = std::abs(a) > own ? std::max(own, std::abs(profile_.start().acceleration)) : own;
  return {.velocity = std::max({dynamics_.velocity, std::abs(v), std::abs(v + run_down)}),
          .acceleration = maximum,
          .deceleration = maximum,
          .jerk = dynamics_.jerk};
}

double SingleAxisMotion::fastest(const Setpoint& now, int direction) const noexcept {
  if (distance_left(direction) <= kSameDirection * (1.0 + std::abs(profile_.target().position))) return 0.0;
  const double v = direction * now.velocity, a = direction * now.acceleration;
  const double run_down = dynamics_.jerk > 0.0 ? a * std::abs(a) / (2.0 * dynamics_.jerk) : 0.0;
  return std::max({dynamics_.velocity, v, v + run_down});
}

double SingleAxisMotion::distance_left(int direction) const noexcept {
  if (direction * target_velocity_ > 0.0) return std::numeric_limits<double>::infinity();
  const double now = static_cast<double>(ticks_) * period_;
  if (now >= profile_.duration()) return 0.0;  // at rest, or for ever in the other direction
  const double here = direction * profile_.at(now).position;
  double furthest = std::max(direction * profile_.target().position, here);
  const auto phases = profile_.phases();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double end = i + 1 < phases.size() ? phases[i + 1].begin : profile_.duration();
    if (phases[i].begin > now) furthest = std::max(furthest, direction * phases[i].state.position);
    for (const double turn : turning_times(phases[i])) {
      const double t = phases[i].begin + turn;
      if (t > std::max(phases[i].begin, now) && t < end)
        furthest = std::max(furthest, direction * profile_.at(t).position);
    }
  }
  return furthest - here;
}

void SingleAxisMotion::shift(double by) noexcept {
  origin_.shift(by);
  target_ = advanced(target_, by, modulo_);
}

}  // namespace lockstep
