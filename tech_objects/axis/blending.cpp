#include "tech_objects/axis/blending.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/axis/stopping_distance.hpp"
#include "tech_objects/profile/profile.hpp"

namespace lockstep {
namespace {

/// Steps by which the highest blending velocity is looked for: to some 1e-5 of the one wanted.
constexpr int kSearchSteps = 16;

double wanted_velocity(BufferMode mode, double previous, double next) noexcept {
  switch (mode) {
    case BufferMode::mcBlendingLow:
      return std::min(previous, next);
    case BufferMode::mcBlendingPrevious:
      return previous;
    case BufferMode::mcBlendingNext:
      return next;
    default:
      return std::max(previous, next);
  }
}

}  // namespace

bool Blending::plan(SingleAxisMotion& motion, const Setpoint& now, const NextMotion& next, BufferMode mode,
                    double velocity_limit, const Modulo& modulo) noexcept {
  const Dynamics dynamics = motion.dynamics();
  const double distance = rounded_difference(motion.target(), now.position, modulo);
  const double wanted = wanted_velocity(mode, dynamics.velocity, next.dynamics.velocity);
  junction_velocity_ = 0.0;
  if (distance == 0.0 || wanted <= 0.0 || !(next.distance * distance > 0.0)) return false;
  const double own = std::min({wanted, dynamics.velocity, velocity_limit});
  const double velocity = highest_velocity(motion, now, distance, own, next, dynamics);
  if (velocity <= 0.0) return false;
  motion.move_to(now, motion.target(), distance, dynamics, std::copysign(velocity, distance));
  if (velocity == own && wanted > own) junction_velocity_ = std::min(wanted, velocity_limit);
  return true;
}

bool Blending::due_to_speed_up(const SingleAxisMotion& motion, const Setpoint& now,
                               const Modulo& modulo) const noexcept {
  if (junction_velocity_ <= 0.0 || motion.aim() != SingleAxisMotion::Aim::position || motion.finished() ||
      motion.target_velocity() == 0.0)
    return false;
  Dynamics dynamics = motion.dynamics();
  if (junction_velocity_ <= dynamics.velocity) return false;
  dynamics.velocity = junction_velocity_;
  return !reachable_later(now, rounded_difference(motion.target(), now.position, modulo), dynamics);
}

void Blending::speed_up(SingleAxisMotion& motion, const Setpoint& now, const NextMotion& next,
                        const Modulo& modulo) noexcept {
  Dynamics dynamics = motion.dynamics();
  dynamics.velocity = junction_velocity_;
  const double distance = rounded_difference(motion.target(), now.position, modulo);
  const double own = std::abs(motion.target_velocity());
  const double velocity = highest_velocity(motion, now, distance, junction_velocity_, next, dynamics);
  junction_velocity_ = 0.0;
  if (velocity <= own) return;
  dynamics.velocity = velocity;
  motion.move_to(now, motion.target(), distance, dynamics, std::copysign(velocity, distance));
}

/// Up to the wanted one, the highest velocity with which the target can be passed.
double Blending::highest_velocity(const SingleAxisMotion& motion, const Setpoint& now, double distance,
                                  double wanted, const NextMotion& next,
                                  const Dynamics& dynamics) const noexcept {
  const auto possible = [&](double velocity) {
    return can_take_over(next, velocity) &&
           motion.passes_ahead(now, distance, std::copysign(velocity, distance), dynamics);
  };
  if (possible(wanted)) return wanted;
  double velocity = 0.0;
  double too_high = wanted;
  for (int i = 0; i < kSearchSteps; ++i) {
    const double middle = 0.5 * (velocity + too_high);
    (possible(middle) ? velocity : too_high) = middle;
  }
  return velocity;
}

/// Whether the next motion, begun up to a cycle behind the target, comes to rest in front of its own.
bool Blending::can_take_over(const NextMotion& next, double velocity) const noexcept {
  if (next.endless) return true;
  double stop = 0.0;
  if (!find_stop(velocity, 0.0, next.dynamics, stop)) return false;
  return stop + velocity * period_ <= std::abs(next.distance);
}

/// Whether in the next cycle the velocity of these dynamics could still be reached within the distance; also
/// where nothing can be planned.
bool Blending::reachable_later(const Setpoint& now, double distance,
                               const Dynamics& dynamics) const noexcept {
  const double heading = distance < 0.0 ? -1.0 : 1.0;
  const double velocity = heading * now.velocity;
  const double maximum = std::max(dynamics.velocity, std::abs(velocity)) + 1.0;
  const ProfileLimits limits =
      limits_of({maximum, dynamics.acceleration, dynamics.deceleration, dynamics.jerk});
  Profile rise;
  const MotionState from{0.0, velocity, heading * now.acceleration};
  if (plan_velocity(from, dynamics.velocity, limits, rise) != PlanResult::ok) return true;
  return !(std::abs(distance) - std::abs(velocity) * period_ <= rise.target().position);
}

}  // namespace lockstep
