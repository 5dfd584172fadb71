#include "tech_objects/axis/hand_over.hpp"

namespace lockstep {

void HandOverOrders::begin(const Setpoint& seen, const Setpoint& now) noexcept {
  handing_over_ = false;
  const double distance = rounded_difference(seen.position, now.position, modulo_);
  const double velocity = seen.velocity - now.velocity;
  if (distance == 0.0 && velocity == 0.0) return;
  if (course_.begin({{0, distance}, velocity, 0.0}, dynamics())) lead_by(seen);
}

Dynamics HandOverOrders::dynamics() const noexcept {
  Dynamics dynamics = limits_.maximum();
  if (dynamics.velocity <= 0.0) dynamics.velocity = data.DynamicLimits.MaxVelocity;
  return dynamics;
}

/// What has been zero to axes that follow the position
/// comes over to the setpoint; the turns that a ring has made meanwhile nobody has seen, and nobody makes.
void HandOverOrders::switch_position_control(bool on) noexcept {
  if (on == position_controlled_) return;
  position_controlled_ = on;
  if (takes_switch_back()) return;
  if (!on) return lead_with_zero();
  if (uncontrolled_.times == 0) return;  // a speed axis, or one that has been off since its start
  const Setpoint course = handing_over_ ? course_.course(setpoint_, modulo_) : setpoint_;
  uncontrolled_.zero = zero_on_turn(course.position.turns, modulo_);
  const double distance = rounded_difference(uncontrolled_.zero, course.position, modulo_);
  uncontrolled_.returning =
      course_.begin_return({{0, distance}, -course.velocity, -course.acceleration}, dynamics());
  uncontrolled_.now = {uncontrolled_.zero, 0.0, 0.0};
  if (!handing_over_ && uncontrolled_.returning) {
    course_.settle();
    lead_by(course);
  }
}

/// What it was one tick ago nobody has seen. Without position control the velocity alone is followed.
void HandOverOrders::to_actual() noexcept {
  course_.take();
  const Setpoint seen = handing_over_ ? led_setpoint() : last_setpoint_;
  Setpoint now = setpoint_;
  now.position =
      position_controlled_ ? advanced(now.position, -now.velocity * period_, modulo_) : seen.position;
  begin(seen, now);
}

void HandOverOrders::step() noexcept {
  UncontrolledLead& back = uncontrolled_;
  back.returning = back.returning && !course_.returned();
  if (course_.finished() && !back.returning) {
    handing_over_ = false;
    return;
  }
  if (!course_.finished()) course_.advance();
  const Setpoint course = course_.course(setpoint_, modulo_);
  lead_by(course);
  if (!back.returning) return;
  course_.advance_return();
  back.last = back.now;
  back.now = course_.returning(course, modulo_);
}

void HandOverOrders::lead_by(const Setpoint& led) noexcept {
  last_led_ = led_;
  led_ = led;
  handing_over_ = true;
}

/// Position control is left: from now on axes that follow the position see zero. The turn is the one on which
/// they are: nobody turns back over the turns that have been made.
void HandOverOrders::lead_with_zero() noexcept {
  const Setpoint& seen = uncontrolled_.returning ? uncontrolled_.now : led_setpoint();
  uncontrolled_.returning = false;
  ++uncontrolled_.times;
  uncontrolled_.zero = zero_on_turn(seen.position.turns, modulo_);
}

/// @return whether a switch of position control takes back another one of this tick, which nobody has seen:
/// then all is as it was before
bool HandOverOrders::takes_switch_back() noexcept {
  control_switched_ = !control_switched_;
  if (control_switched_)
    before_switch_ = uncontrolled_;
  else
    uncontrolled_ = before_switch_;
  return !control_switched_;
}

void HandOverOrders::shift(double by) noexcept {
  before_switch_.now.position = advanced(before_switch_.now.position, by, modulo_);
  before_switch_.last.position = advanced(before_switch_.last.position, by, modulo_);
}

}  // namespace lockstep
