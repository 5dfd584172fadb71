#include "tech_objects/axis/target_distance.hpp"

#include <cmath>
#include <limits>

#include "tech_objects/axis/stopping_distance.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// By what positions on a ring may be apart by rounding [u]: 0.1 + 0.2 is 0.3, not a turn before it.
double same_position(const Modulo& modulo) noexcept {
  constexpr double kShare = 4.0 * std::numeric_limits<double>::epsilon();
  return kShare * (std::abs(modulo.start) + modulo.length);
}

double beyond_stopping_distance(double distance, const Setpoint& from, const Dynamics& dynamics,
                                const Modulo& modulo) noexcept {
  const double heading = distance < 0.0 ? -1.0 : 1.0;
  const double velocity = heading * from.velocity;
  if (velocity <= 0.0 || dynamics.velocity <= 0.0) return distance;
  double stop = 0.0;
  if (!find_stop(velocity, heading * from.acceleration, dynamics, stop)) return distance;
  const double missing = stop - std::abs(distance);
  // A rounding is no reason for a turn: a motion that is begun anew at its own target stays there.
  if (missing <= same_position(modulo) * 16.0) return distance;
  return distance + heading * std::ceil(missing / modulo.length) * modulo.length;
}

}  // namespace

double absolute_distance(const MoveAbsoluteJob& job, double here, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return job.position - here;
  const double target = normalised({0, job.position}, modulo).value;
  const double shortest = shortest_distance(here, target, modulo);
  if (job.direction == Direction::shortest || std::abs(shortest) <= same_position(modulo)) return shortest;
  return job.direction == Direction::positive ? positive_distance(here, target, modulo)
                                              : negative_distance(here, target, modulo);
}

DoubleDouble absolute_distance(const MoveAbsoluteJob& job, const Setpoint& from, DoubleDouble beyond_target,
                               const Dynamics& dynamics, const Modulo& modulo) noexcept {
  const bool directed = modulo.enabled && job.direction != Direction::shortest;
  const auto reachable = [&](double distance) noexcept {
    return directed && distance != 0.0 ? beyond_stopping_distance(distance, from, dynamics, modulo)
                                       : distance;
  };
  if (!modulo.enabled || beyond_target == DoubleDouble{})
    return {reachable(absolute_distance(job, from.position.value, modulo)), 0.0};
  const AxisPosition before = advanced(from.position, -beyond_target, modulo);
  return DoubleDouble{reachable(absolute_distance(job, before.value, modulo)), 0.0} - beyond_target;
}

AxisPosition next_to(AxisPosition here, double position, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return {0, position};
  const double target = normalised({0, position}, modulo).value;
  AxisPosition given = advanced(here, shortest_distance(here.value, target, modulo), modulo);
  // The distance is rounded: at the end of the ring the turn may be the neighbour's.
  if (given.value - target > 0.5 * modulo.length) ++given.turns;
  if (given.value - target < -0.5 * modulo.length) --given.turns;
  given.value = target;
  return given;
}

}  // namespace lockstep
