#include "tech_objects/linmot/limiter.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::linmot {
namespace {

ProfileLimits profile_limits(const Limits& limits) noexcept {
  return {limits.velocity, -limits.velocity, limits.acceleration, limits.acceleration, 0.0};
}

}  // namespace

MotionState Limiter::state() const noexcept {
  if (resting_) return {target_, 0.0, 0.0};
  MotionState now = profile_.at(static_cast<double>(cycles_) * cycle_);
  now.acceleration = 0.0;
  return now;
}

void Limiter::begin(double position, double velocity) noexcept {
  target_ = position;
  resting_ = velocity == 0.0;
  endless_ = false;
  restart();
  if (resting_) return;
  const Limits as_it_goes{std::abs(velocity), limits_.acceleration};
  const MotionState start{position, velocity, 0.0};
  endless_ = plan_velocity(start, velocity, profile_limits(as_it_goes), profile_) == PlanResult::ok;
  resting_ = !endless_;
}

/// What cannot be planned is not begun: it stays where it is.
void Limiter::go_to(double target, const Limits& limits) noexcept {
  if (!endless_ && target == target_ && limits == limits_) return;
  const MotionState start = state();
  limits_ = limits;
  if (start.velocity == 0.0 && start.position == target) return begin(target);
  if (plan_position(start, target, 0.0, profile_limits(limits), profile_) != PlanResult::ok)
    return begin(start.position);
  target_ = target;
  resting_ = endless_ = false;
  restart();
}

void Limiter::limit(const Limits& limits) noexcept {
  if (resting_ || endless_)
    limits_ = limits;
  else
    go_to(target_, limits);
}

void Limiter::stop(double acceleration) noexcept {
  if (resting_) return;
  const MotionState start = state();
  const double bound = std::max(std::abs(start.velocity), 1e-6);
  if (plan_velocity(start, 0.0, profile_limits({bound, acceleration}), profile_) != PlanResult::ok)
    return begin(start.position);
  restart();
  endless_ = false;
  target_ = profile_.target().position;
  limits_ = {bound, acceleration};
}

void Limiter::run(double velocity, const Limits& limits) noexcept {
  const MotionState start = state();
  const double bounded = std::clamp(velocity, -limits.velocity, limits.velocity);
  if (plan_velocity(start, bounded, profile_limits(limits), profile_) != PlanResult::ok) return;
  limits_ = limits;
  restart();
  resting_ = false;
  endless_ = true;
}

}  // namespace lockstep::linmot
