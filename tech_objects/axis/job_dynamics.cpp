#include "tech_objects/axis/job_dynamics.hpp"

namespace lockstep {

Dynamics JobDynamics::effective(const Job& job) noexcept {
  const ExceededLimits exceeded = limits_.exceeded(job);
  if (exceeded.any()) tell(exceeded, job);
  return limits_.effective(job);
}

void JobDynamics::tell(const ExceededLimits& exceeded, const Job& job) noexcept {
  const auto& limits = limits_.configured();
  const Dynamics asked = limits_.asked(job);
  if (exceeded.velocity)
    reactions_.raise(alarm::kVelocityLimited, {.value = asked.velocity, .limit = limits_.velocity()});
  const bool accelerates = asked.acceleration > limits.MaxAcceleration;
  if (exceeded.acceleration)
    reactions_.raise(alarm::kAccelerationLimited,
                     {.cause = accelerates ? AlarmCause::acceleration : AlarmCause::deceleration,
                      .value = accelerates ? asked.acceleration : asked.deceleration,
                      .limit = accelerates ? limits.MaxAcceleration : limits.MaxDeceleration});
  if (exceeded.jerk) reactions_.raise(alarm::kJerkLimited, {.value = asked.jerk, .limit = limits.MaxJerk});
}

Dynamics JobDynamics::own(const Job& job) noexcept {
  Dynamics dynamics = effective(job);
  limits_.keep_below(dynamics, setpoint_.acceleration, stops_.margin_to_limit());
  return dynamics;
}

void JobDynamics::leave_to_superimposed(const Job* job, Dynamics& dynamics) noexcept {
  superimposed_.curb(dynamics, setpoint_, base_motion(), job, limits_);
}

BaseMotion JobDynamics::base_motion() const noexcept {
  return {single_, jobs_[kBase], motion_ == AxisMotion::single_axis, led(motion_)};
}

}  // namespace lockstep
