#include "tech_objects/axis/stopping_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/axis/rounding.hpp"
#include "tech_objects/profile/profile.hpp"

namespace lockstep {
double stopping_distance(const Heading& from, const Dynamics& dynamics) noexcept {
  const double v = from.velocity;
  const double a = from.acceleration;
  if (v <= 0.0 && (a <= 0.0 || dynamics.jerk <= 0.0)) return 0.0;
  if (from.turning_back(dynamics.jerk)) {
    const double t = (-a - std::sqrt(a * a - 2.0 * dynamics.jerk * v)) / dynamics.jerk;
    return t * (v + t * (0.5 * a + t * dynamics.jerk * (1.0 / 6.0)));
  }
  double distance = 0.0;
  if (!find_stop(v, a, dynamics, distance)) return std::numeric_limits<double>::infinity();
  return std::max(distance, 0.0);
}

bool find_stop(double velocity, double acceleration, const Dynamics& dynamics, double& distance) noexcept {
  // No limit to a stop; the planner wants one.
  const double maximum = std::max(dynamics.velocity, velocity) + 1.0;
  const ProfileLimits limits =
      limits_of({maximum, dynamics.acceleration, dynamics.deceleration, dynamics.jerk});
  Profile stop;
  if (plan_stop({0.0, velocity, acceleration}, limits, PresentAcceleration::keep, stop) != PlanResult::ok)
    return false;
  distance = stop.target().position;
  return true;
}

bool find_braking(const Heading& from, double distance, const Dynamics& highest,
                  Dynamics& dynamics) noexcept {
  const double maximum = distance + kRelativeRounding * (1.0 + distance);
  if (stopping_distance(from, dynamics) <= maximum) return true;
  dynamics = highest;
  if (stopping_distance(from, dynamics) <= maximum) return true;
  dynamics.jerk = 0.0;
  return stopping_distance(from, dynamics) <= maximum;
}

}  // namespace lockstep
