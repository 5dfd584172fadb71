#include "tech_objects/synchronous/shifts.hpp"

namespace lockstep {

Shift one_tick_on(const Shift& shift, const LeadingStep& step) noexcept {
  Shift moved = shift;
  moved.advance(step);
  return moved;
}

bool in_progress(const Shift& shift) noexcept {
  return shift.phase() != Shift::Phase::resting || shift.settling();
}

bool Shifts::settle(const Shifts& ended, const LeadingStep& step, const Dynamics& dynamics,
                    double period) noexcept {
  const ProfileLimits limits = limits_of(dynamics);
  const bool phasing = in_progress(ended.phase_);
  const bool offsetting = in_progress(ended.offset_);
  if (phasing) {
    const Shift phase = one_tick_on(ended.phase_, step);
    phase_.settle_at(phase.value() - ended.phase_.value(), phase, limits, period);
  }
  if (offsetting) {
    const Shift offset = one_tick_on(ended.offset_, step);
    offset_.settle_at(offset_.value() + (offset.value() - ended.offset_.value()), offset, limits, period);
  }
  return phasing || offsetting;
}

}  // namespace lockstep
