// What axes that follow the setpoint see of it where it goes over from one course to another: to the actual
// value of an axis that is switched off, and back; to the emergency ramp. For them there is no step: what
// they see goes on from where it has been and comes over with maximum dynamics.
#include "tech_objects/axis.hpp"

namespace lockstep {

/// @param seen what following axes have seen last  @param now where the setpoint goes on from, at that tick
void Axis::hand_over(const Setpoint& seen, const Setpoint& now) noexcept {
  handing_over_ = false;
  const double way = rounded_difference(seen.position, now.position, modulo_);
  const double velocity = seen.velocity - now.velocity;
  if (way == 0.0 && velocity == 0.0) return;
  hand_over_.begin();
  hand_over_.begin_giving();
  hand_over_.give(way, velocity, 0.0);
  Dynamics dynamics = maximum_dynamics();
  if (dynamics.velocity <= 0.0) dynamics.velocity = data.DynamicLimits.MaxVelocity;
  if (hand_over_.move_by(-way, dynamics) == PlanResult::ok) lead_by(seen);
}

/// Switched off, the setpoint has just gone over to the actual value, or that has been given another name:
/// what it was one tick ago nobody has seen. Without position control the velocity alone is followed.
void Axis::hand_over_to_actual() noexcept {
  hand_over_due_ = false;
  const Setpoint seen = handing_over_ ? led_setpoint() : last_setpoint_;
  Setpoint now = setpoint_;
  now.position =
      position_controlled_ ? advanced(now.position, -now.velocity * period_, modulo_) : seen.position;
  hand_over(seen, now);
}

/// Each tick while it lasts, after the setpoint of the tick.
void Axis::step_hand_over() noexcept {
  if (hand_over_.finished()) {
    handing_over_ = false;
    return;
  }
  hand_over_.advance();
  lead_by({advanced(setpoint_.position, hand_over_.value(), modulo_),
           setpoint_.velocity + hand_over_.velocity(), setpoint_.acceleration + hand_over_.acceleration()});
}

}  // namespace lockstep
