#include "tech_objects/axis/motion_limits.hpp"

namespace lockstep {
namespace {

/// Highest deceleration that a data block can hold [u/s²]: what is left when no limit is configured.
/// @source S7-1500T synchronous operation V7, 13.1.16
constexpr double kHighestDeceleration = 2.77777777777778e8;

double positive_or(double value, double other) noexcept {
  return value > 0.0 ? value : other;
}

double value_or(double value, double default_value) noexcept {
  return value < 0.0 ? default_value : value;
}

}  // namespace

Dynamics MotionLimits::maximum() const noexcept {
  const double deceleration = positive_or(data_.DynamicLimits.MaxDeceleration, kHighestDeceleration);
  return {.velocity = velocity(),
          .acceleration = positive_or(data_.DynamicLimits.MaxAcceleration, deceleration),
          .deceleration = deceleration,
          .jerk = data_.DynamicLimits.MaxJerk};
}

Dynamics MotionLimits::emergency() const noexcept {
  Dynamics dynamics = maximum();
  dynamics.deceleration = positive_or(data_.DynamicDefaults.EmergencyDeceleration, dynamics.deceleration);
  dynamics.jerk = 0.0;
  return dynamics;
}

/// Velocity that a job asks for, before the limit [u/s]. The override counts for the axis' own motion only.
double MotionLimits::wanted_velocity(const Job& job) const noexcept {
  const double own = data_.Override.Velocity / 100.0;
  switch (job.kind) {
    case JobKind::MC_GearIn:
    case JobKind::MC_GearInVelocity:
    case JobKind::MC_GearOut:
    case JobKind::MC_CamOut:
      return velocity();
    case JobKind::MC_GearInPos:
    case JobKind::MC_CamIn:
    case JobKind::MC_PhasingAbsolute:
    case JobKind::MC_PhasingRelative:
      return velocity_or_default(job);
    case JobKind::MC_MoveVelocity:
    case JobKind::MC_MoveJog:
      return std::abs(job.velocity) * own;
    default:
      return velocity_or_default(job) * own;
  }
}

void MotionLimits::take_defaults(Job& job) const noexcept {
  if (job.kind == JobKind::MC_MoveJog || gives_values(job.kind)) return;
  const auto& defaults = data_.DynamicDefaults;
  if (job.kind != JobKind::MC_MoveVelocity) job.velocity = value_or(job.velocity, defaults.Velocity);
  job.acceleration = value_or(job.acceleration, defaults.Acceleration);
  job.deceleration = value_or(job.deceleration, defaults.Deceleration);
  job.jerk = value_or(job.jerk, defaults.Jerk);
}

Dynamics MotionLimits::effective(const Job& job) const noexcept {
  const auto& defaults = data_.DynamicDefaults;
  const auto& limits = data_.DynamicLimits;
  const double jerk = value_or(job.jerk, defaults.Jerk);
  return {.velocity = std::min(wanted_velocity(job), velocity()),
          .acceleration = std::min(value_or(job.acceleration, defaults.Acceleration), limits.MaxAcceleration),
          .deceleration = std::min(value_or(job.deceleration, defaults.Deceleration), limits.MaxDeceleration),
          .jerk = std::min(jerk, positive_or(limits.MaxJerk, jerk))};
}

Dynamics MotionLimits::asked(const Job& job) const noexcept {
  const auto& defaults = data_.DynamicDefaults;
  return {.velocity = wanted_velocity(job),
          .acceleration = value_or(job.acceleration, defaults.Acceleration),
          .deceleration = value_or(job.deceleration, defaults.Deceleration),
          .jerk = value_or(job.jerk, defaults.Jerk)};
}

ExceededLimits MotionLimits::exceeded(const Job& job) const noexcept {
  const auto& defaults = data_.DynamicDefaults;
  const auto& limits = data_.DynamicLimits;
  const double jerk = value_or(job.jerk, defaults.Jerk);
  return {.velocity = wanted_velocity(job) > velocity(),
          .acceleration = value_or(job.acceleration, defaults.Acceleration) > limits.MaxAcceleration ||
                          value_or(job.deceleration, defaults.Deceleration) > limits.MaxDeceleration,
          .jerk = jerk > positive_or(limits.MaxJerk, jerk)};
}

ZeroLimit MotionLimits::zero_limit(const Dynamics& dynamics) const noexcept {
  const auto& limits = data_.DynamicLimits;
  if (velocity() <= 0.0)
    return {alarm::kVelocityLimitZero, {.value = limits.MaxVelocity, .limit = limits.Velocity}};
  if (dynamics.acceleration <= 0.0)
    return {
        alarm::kAccelerationLimitZero,
        {.cause = AlarmCause::acceleration, .value = dynamics.acceleration, .limit = limits.MaxAcceleration}};
  if (dynamics.deceleration <= 0.0)
    return {
        alarm::kAccelerationLimitZero,
        {.cause = AlarmCause::deceleration, .value = dynamics.deceleration, .limit = limits.MaxDeceleration}};
  if (dynamics.jerk > 0.0 && limits.MaxJerk <= 0.0)
    return {alarm::kJerkLimitZero, {.value = dynamics.jerk, .limit = limits.MaxJerk}};
  return {};
}

void MotionLimits::keep_below(Dynamics& dynamics, double acceleration, double margin) const noexcept {
  const double square = acceleration * acceleration;
  if (dynamics.jerk > 0.0 && square > 2.0 * dynamics.jerk * margin)
    dynamics.jerk = std::max(dynamics.jerk, std::min(square / (2.0 * margin), data_.DynamicLimits.MaxJerk));
}

double MotionLimits::sufficient_jerk(double jerk, double before, double acceleration,
                                     double margin) noexcept {
  const double square = acceleration * acceleration;
  if (jerk <= 0.0 || before <= jerk || square <= 2.0 * jerk * margin) return jerk;
  return std::min(before, square / (2.0 * margin));
}

}  // namespace lockstep
