// What axes that follow the setpoint see of it where it goes over from one course to another: to the actual
// value of an axis that is switched off, and back; to the emergency ramp; and where position control is taken
// up again, without which they see zero. For them there is no step: what they see goes on from where it has
// been and comes over with maximum dynamics.
#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// @param seen what following axes have seen last  @param now where the setpoint goes on from, at that tick
void AxisOrders::hand_over(const Setpoint& seen, const Setpoint& now) noexcept {
  handing_over_ = false;
  const double way = rounded_difference(seen.position, now.position, modulo_);
  const double velocity = seen.velocity - now.velocity;
  if (way == 0.0 && velocity == 0.0) return;
  if (hand_over_.begin({{0, way}, velocity, 0.0}, hand_over_dynamics())) lead_by(seen);
}

Dynamics AxisOrders::hand_over_dynamics() const noexcept {
  Dynamics dynamics = limits_.maximum();
  if (dynamics.velocity <= 0.0) dynamics.velocity = data.DynamicLimits.MaxVelocity;
  return dynamics;
}

/// Position control on or off, from the last setpoint on. What has been zero to axes that follow the position
/// comes over to the setpoint; the turns that a ring has made meanwhile nobody has seen, and nobody makes.
void AxisOrders::lead_with_position_control(bool on) noexcept {
  if (on == position_controlled_) return;
  position_controlled_ = on;
  if (takes_switch_back()) return;
  if (!on) return lead_with_zero();
  if (uncontrolled_.times == 0) return;  // a speed axis, or one that has been off since its start
  const Setpoint course = handing_over_ ? hand_over_.course(setpoint_, modulo_) : setpoint_;
  uncontrolled_.zero = zero_on_turn(course.position.turns, modulo_);
  const double way = rounded_difference(uncontrolled_.zero, course.position, modulo_);
  uncontrolled_.returning =
      hand_over_.begin_return({{0, way}, -course.velocity, -course.acceleration}, hand_over_dynamics());
  uncontrolled_.now = {uncontrolled_.zero, 0.0, 0.0};
  if (!handing_over_ && uncontrolled_.returning) {
    hand_over_.settle();
    lead_by(course);
  }
}

/// Switched off, the setpoint has just gone over to the actual value, or that has been given another name:
/// what it was one tick ago nobody has seen. Without position control the velocity alone is followed.
void AxisOrders::hand_over_to_actual() noexcept {
  hand_over_.take();
  const Setpoint seen = handing_over_ ? led_setpoint() : last_setpoint_;
  Setpoint now = setpoint_;
  now.position =
      position_controlled_ ? advanced(now.position, -now.velocity * period_, modulo_) : seen.position;
  hand_over(seen, now);
}

/// Each tick while it lasts, after the setpoint of the tick.
void AxisOrders::step_hand_over() noexcept {
  UncontrolledLead& back = uncontrolled_;
  back.returning = back.returning && !hand_over_.returned();
  if (hand_over_.finished() && !back.returning) {
    handing_over_ = false;
    return;
  }
  if (!hand_over_.finished()) hand_over_.advance();
  const Setpoint course = hand_over_.course(setpoint_, modulo_);
  lead_by(course);
  if (!back.returning) return;
  hand_over_.advance_return();
  back.last = back.now;
  back.now = hand_over_.returning(course, modulo_);
}

}  // namespace lockstep
