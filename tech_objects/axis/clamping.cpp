#include "tech_objects/axis/clamping.hpp"

#include <cmath>

namespace lockstep {

Clamping::Outcome Clamping::watch(AxisPosition actual, const Modulo& modulo, double tolerance,
                                  double velocity, bool has_job) noexcept {
  const double moved = difference(actual, place_, modulo).rounded();
  holds_ = std::abs(moved) <= tolerance;
  if (holds_) return has_job && side_ * velocity > 0.0 ? Outcome::turned_to : Outcome::held;
  const bool retreats = side_ * moved < 0.0 && has_job;
  leave();
  return retreats ? Outcome::held : Outcome::torn_away;
}

}  // namespace lockstep
