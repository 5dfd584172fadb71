#include "tech_objects/synchronous/synchronous_function.hpp"

namespace lockstep {

void SynchronousFunction::evaluate_cam(const Setpoint& led, const Shift* phase, Setpoint& result) noexcept {
  AxisPosition leading = led.position;
  double velocity = led.velocity;
  double acceleration = led.acceleration;
  if (phase != nullptr) {
    leading = advanced(leading, phase->value(), leading_);
    velocity += phase->velocity();
    acceleration += phase->acceleration();
  }
  const CamPlace place = cam_.value(leading);
  show(place.position, place.slope * velocity,
       place.curvature * velocity * velocity + place.slope * acceleration, result);
}

}  // namespace lockstep
