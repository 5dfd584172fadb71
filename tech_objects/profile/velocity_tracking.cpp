#include "tech_objects/profile/velocity_tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

/// A plan that ends this share of the tick late counts as ended in it: what rounding may amount to.
constexpr double kLate = 4e-13;

struct Bounds {
  double lowest;   // of the acceleration
  double highest;  // of the acceleration
};

struct Phase {
  double jerk = 0.0;
  double duration = 0.0;
};
using Plan = std::array<Phase, 4>;

/// Motion in the course of a tick.
struct Course {
  double distance = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;

  void run(double jerk, double time) noexcept {
    distance += time * (velocity + time * (0.5 * acceleration + time * jerk / 6.0));
    velocity += time * (acceleration + 0.5 * time * jerk);
    acceleration += time * jerk;
  }
};

/// Time-optimal course of a relative velocity and acceleration to zero: back inside the bounds, then up to a
/// peak, hold it, and down.
Plan plan_to_zero(double velocity, double acceleration, Bounds bounds, double jerk) noexcept {
  Plan plan{};
  const double inside = std::clamp(acceleration, bounds.lowest, bounds.highest);
  if (inside != acceleration) {
    const double duration = std::abs(acceleration - inside) / jerk;
    plan[0] = {acceleration > inside ? -jerk : jerk, duration};
    velocity += 0.5 * (acceleration + inside) * duration;
    acceleration = inside;
  }
  // What would be left if the acceleration went straight to zero tells which way to push.
  const double left = velocity + acceleration * std::abs(acceleration) / (2.0 * jerk);
  const double push = left > 0.0 ? -1.0 : 1.0;
  velocity *= push;
  acceleration *= push;
  const double limit = push > 0.0 ? bounds.highest : -bounds.lowest;
  double peak = std::sqrt(std::max(0.0, 0.5 * acceleration * acceleration - jerk * velocity));
  double hold = 0.0;
  if (peak > limit) {
    peak = limit;
    const double rest = -velocity - (2.0 * limit * limit - acceleration * acceleration) / (2.0 * jerk);
    hold = limit > 0.0 ? std::max(0.0, rest / limit) : std::numeric_limits<double>::infinity();
  }
  plan[1] = {push * jerk, std::max(0.0, (peak - acceleration) / jerk)};
  plan[2] = {0.0, hold};
  plan[3] = {-push * jerk, peak / jerk};
  return plan;
}

/// One tick with limited jerk within the bounds.
TrackingStep step_with_jerk(TrackingMotion own, TrackingMotion target, Bounds bounds, double jerk,
                            double period) noexcept {
  const double pace = std::clamp(target.acceleration, bounds.lowest, bounds.highest);  // of the moving frame
  const Plan plan = plan_to_zero(own.velocity - (target.velocity - pace * period), own.acceleration - pace,
                                 {bounds.lowest - pace, bounds.highest - pace}, jerk);
  Course course{0.0, own.velocity, own.acceleration};
  double left = period;
  for (const Phase& phase : plan) {
    if (phase.duration > left + kLate * period) {
      course.run(phase.jerk, std::max(left, 0.0));
      return {course.distance, course.velocity, course.acceleration, false};
    }
    course.run(phase.jerk, phase.duration);
    left -= phase.duration;
  }
  course.acceleration = pace;
  course.run(0.0, left);
  return {course.distance, target.velocity, pace, pace == target.acceleration};
}

/// One tick with a trapezoidal velocity profile, exact across the own reversal; own velocity ≥ 0.
TrackingStep step_without_jerk(TrackingMotion own, TrackingMotion target, const TrackingLimits& limits,
                               double period) noexcept {
  const double slowing = own.velocity > 0.0 ? limits.deceleration : limits.acceleration;
  const double pace = std::clamp(target.acceleration, -slowing, limits.acceleration);
  Course course{0.0, own.velocity, 0.0};
  double left = period;
  for (int piece = 0; piece < 3; ++piece) {
    const double gap = target.velocity - pace * left - course.velocity;
    const double push = gap > 0.0 ? 1.0 : -1.0;
    const bool slows = course.velocity * push < 0.0;
    course.acceleration = push * (slows ? limits.deceleration : limits.acceleration);
    const double closing = course.acceleration - pace;
    double meets = std::numeric_limits<double>::infinity();
    if (gap == 0.0)
      meets = 0.0;
    else if (gap * closing > 0.0)
      meets = gap / closing;
    const double rests = slows ? -course.velocity / course.acceleration : meets;
    if (meets <= left * (1.0 + kLate) && meets <= rests) {
      course.run(0.0, meets);
      course.acceleration = pace;
      course.run(0.0, left - meets);
      return {course.distance, target.velocity, pace, pace == target.acceleration};
    }
    if (!slows || rests >= left) break;
    course.run(0.0, rests);
    course.velocity = 0.0;
    left -= rests;
  }
  course.run(0.0, left);
  return {course.distance, course.velocity, course.acceleration, false};
}

/// Whether the axis cannot but pass the velocity limit from where the step ends.
bool passes_limit(const TrackingStep& step, const TrackingLimits& limits) noexcept {
  const double to_come = step.acceleration * std::abs(step.acceleration) / (2.0 * limits.jerk);
  return std::abs(step.velocity + to_come) > limits.velocity && step.velocity * step.acceleration > 0.0;
}

/// A step that ends so fast that the acceleration could not go back in time makes for the velocity limit
/// instead.
TrackingStep step_below_limit(TrackingMotion own, TrackingMotion target, Bounds bounds,
                              const TrackingLimits& limits, double period) noexcept {
  const TrackingStep step = step_with_jerk(own, target, bounds, limits.jerk, period);
  if (step.synchronous || !passes_limit(step, limits)) return step;
  TrackingStep limited =
      step_with_jerk(own, {std::copysign(limits.velocity, step.velocity), 0.0}, bounds, limits.jerk, period);
  limited.synchronous = false;
  return limited;
}

/// Whether an axis that brakes harder than it may speed up would still do so beyond its reversal.
bool brakes_past_rest(const TrackingStep& step, const TrackingLimits& limits) noexcept {
  if (step.velocity < 0.0) return true;
  if (step.acceleration >= -limits.acceleration) return false;
  const double distance_back =
      (step.acceleration * step.acceleration - limits.acceleration * limits.acceleration) /
      (2.0 * limits.jerk);
  return step.velocity < distance_back;
}

/// One tick of an axis with own velocity ≥ 0.
TrackingStep step_forward(TrackingMotion own, TrackingMotion target, const TrackingLimits& limits,
                          double period) noexcept {
  if (!(limits.jerk > 0.0)) return step_without_jerk(own, target, limits, period);
  const Bounds reversing{-limits.acceleration, limits.acceleration};
  if (!(own.velocity > 0.0)) return step_below_limit(own, target, reversing, limits, period);
  const Bounds bounds{-limits.deceleration, limits.acceleration};
  const TrackingStep step = step_below_limit(own, target, bounds, limits, period);
  if (limits.deceleration <= limits.acceleration || !brakes_past_rest(step, limits)) return step;
  return step_below_limit(own, target, reversing, limits, period);
}

}  // namespace

TrackingStep track_velocity(TrackingMotion own, TrackingMotion target, const TrackingLimits& limits,
                            double period) noexcept {
  const bool limited = std::abs(target.velocity) > limits.velocity;
  if (limited) target = {std::copysign(limits.velocity, target.velocity), 0.0};
  const double sign = own.velocity < 0.0 ? -1.0 : 1.0;
  TrackingStep step = step_forward({sign * own.velocity, sign * own.acceleration},
                                   {sign * target.velocity, sign * target.acceleration}, limits, period);
  step.distance *= sign;
  step.velocity *= sign;
  step.acceleration *= sign;
  if (limited) step.synchronous = false;
  return step;
}

}  // namespace lockstep
