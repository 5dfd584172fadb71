// What an axis sees of a leading axis whose setpoint it cannot simply follow: because that goes over to
// another course, or because it is, or has been, without position control.
// @source S7-1500T synchronous operation V7, 5.3
#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {

/// Without position control the leading setpoint is zero, and afterwards it comes back from there to whom it
/// was zero; to others, which couple anew, it is where it is. MC_GearInVelocity follows the velocity, which
/// is there all the time.
void SynchronousMotion::look_at_led() noexcept {
  const LeadingObject& source = *leading_->source;
  const UncontrolledLead& lead = source.uncontrolled_lead();
  const bool controlled = source.position_controlled();
  leading_now_ = source.led_setpoint();
  leading_last_ = source.last_led_setpoint();
  if (velocity_only_) {
    if (!controlled) leading_now_.position = leading_last_.position = lead.zero;
    return;
  }
  if (controlled && !sees_return()) return;
  if (uncontrolled_seen_ != lead.times) {
    uncontrolled_seen_ = lead.times;
  } else if (zero_turns_ != lead.zero.turns) {
    turn_leading(lead.zero.turns - zero_turns_);
  }
  zero_turns_ = lead.zero.turns;
  leading_now_ = controlled ? lead.now : Setpoint{lead.zero, 0.0, 0.0};
  leading_last_ = controlled ? lead.last : leading_now_;
}

/// Whether the leading value comes back to this axis, to which it was zero.
bool SynchronousMotion::sees_return() const noexcept {
  if (leading_->coupling == Coupling::actual) return false;
  const UncontrolledLead& lead = leading_->source->uncontrolled_lead();
  return lead.returning && uncontrolled_seen_ == lead.times;
}

/// The turns of the leading axis are other ones by so many, at the same place of the function.
void SynchronousMotion::turn_leading(std::int64_t turns) noexcept {
  leading_start_.turns += turns;
  if (cam_ != nullptr)
    follow_.add_leading_turns(turns);
  else
    gear_.add_leading_turns(turns);
}

}  // namespace lockstep
