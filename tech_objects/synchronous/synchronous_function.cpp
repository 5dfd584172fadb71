#include "tech_objects/synchronous/synchronous_function.hpp"

namespace lockstep {

void SynchronousFunction::evaluate_cam(const Setpoint& leading, Setpoint& result) noexcept {
  const double velocity = leading.velocity;
  const double acceleration = leading.acceleration;
  const CamFollowingValue place = cam_.value(leading.position);
  show(place.position, place.slope * velocity,
       place.curvature * velocity * velocity + place.slope * acceleration, result);
}

}  // namespace lockstep
