#include "tech_objects/axis/course_hand_over.hpp"

namespace lockstep {

void CourseHandOver::configure(double period) noexcept {
  to_setpoint_.configure(period);
  to_setpoint_.begin();
  from_zero_.configure(period);
  due_ = false;
}

bool CourseHandOver::run_down(Superimposed& part, const Setpoint& ahead, const Dynamics& dynamics) noexcept {
  part.begin();
  part.begin_giving();
  part.give(ahead.position.value, ahead.velocity, ahead.acceleration);
  if (part.move_by(-ahead.position.value, dynamics) == PlanResult::ok) return true;
  part.begin();
  return false;
}

}  // namespace lockstep
