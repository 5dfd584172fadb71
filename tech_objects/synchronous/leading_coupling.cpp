// What an axis sees of a leading axis whose setpoint it cannot simply follow: because that goes over to
// another course, or because it is, or has been, without position control.
// @source S7-1500T synchronous operation V7, 5.3
#include "tech_objects/synchronous/leading_coupling.hpp"

namespace lockstep {
namespace {

void add(Setpoint& leading, const AdditiveLeadingValue& additive, const Modulo& modulo) noexcept {
  leading.position = advanced(leading.position, additive.position, modulo);
  leading.velocity += additive.velocity;
  leading.acceleration += additive.acceleration;
}

}  // namespace

/// leading value → + additive → effective leading value
void LeadingCoupling::add_additive() noexcept {
  add(step_.now, additive_->now, step_.modulo);
  add(step_.last, additive_->last, step_.modulo);
}

/// Without position control the leading setpoint is zero, and afterwards it comes back from there to whom it
/// was zero; to others, which couple anew, it is where it is. Who follows the velocity alone has that all the
/// time.
std::int64_t LeadingCoupling::look_at_led() noexcept {
  if (source_->keeps_names(coupling_)) {
    look_by_old_names();
    return 0;
  }
  const UncontrolledLead& lead = source_->uncontrolled_lead();
  const bool controlled = source_->position_controlled();
  step_.now = source_->led_setpoint();
  step_.last = source_->last_led_setpoint();
  if (velocity_only_) {
    if (!controlled) step_.now.position = step_.last.position = lead.zero;
    return 0;
  }
  if (controlled && !sees_return()) return 0;
  const std::int64_t turned = uncontrolled_seen_ == lead.times ? lead.zero.turns - zero_turns_ : 0;
  uncontrolled_seen_ = lead.times;
  zero_turns_ = lead.zero.turns;
  step_.now = controlled ? lead.now : Setpoint{lead.zero, 0.0, 0.0};
  step_.last = controlled ? lead.last : step_.now;
  return turned;
}

/// Positions are called as they were when the coupling began.
void LeadingCoupling::look_by_old_names() noexcept {
  step_.now = source_->leading_state(coupling_);
  step_.last = source_->last_leading_state(coupling_);
  const DoubleDouble by = names_ - source_->renamed();
  if (by.hi == 0.0 && by.lo == 0.0) return;
  step_.now.position = advanced(step_.now.position, by, step_.modulo);
  step_.last.position = advanced(step_.last.position, by, step_.modulo);
}

bool LeadingCoupling::sees_return() const noexcept {
  if (coupling_ != Coupling::setpoint) return false;
  const UncontrolledLead& lead = source_->uncontrolled_lead();
  return lead.returning && uncontrolled_seen_ == lead.times;
}

}  // namespace lockstep
