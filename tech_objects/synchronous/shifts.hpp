/// Both offsets of a synchronous motion: of the leading value, in front of the function, and of the following
/// value, behind it.
/// @source S7-1500T synchronous operation V7, 6.2.4, 6.2.5
#pragma once

#include "tech_objects/synchronous/shift.hpp"

namespace lockstep {

/// Thread: the cycle.
class Shifts {
 public:
  /// None, as at the begin of a coupling.
  void reset() noexcept {
    phase_.reset();
    offset_.reset();
  }
  /// The following value offset with which a function begins [u], at rest.
  void begin_with_offset(DoubleDouble value) noexcept { offset_.start_at(value); }

  Shift& phase() noexcept { return phase_; }  ///< leading value offset (phasing) [leading u]
  const Shift& phase() const noexcept { return phase_; }
  Shift& offset() noexcept { return offset_; }  ///< following value offset [u]
  const Shift& offset() const noexcept { return offset_; }

  /// function → + offset → setpoint; part by part, as they are computed.
  void add_offset(const Setpoint& function, const Modulo& following, Setpoint& setpoint) noexcept {
    const AxisPosition position = advanced(function.position, offset_.value(), following);
    setpoint.position.turns = followed_.turns = position.turns;
    setpoint.position.value = followed_.value = position.value;
    setpoint.velocity = function.velocity + offset_.velocity();
    setpoint.acceleration = function.acceleration + offset_.acceleration();
  }
  /// Position behind the offset, of the last `add_offset`.
  AxisPosition followed() const noexcept { return followed_; }

  /// The function absorbs the shifts of one that has ended, which still move: their velocities must not step.
  /// In this tick both go on as they would have, then they come to rest. False if neither moved.
  bool settle(const Shifts& ended, const LeadingStep& step, const Dynamics& dynamics, double period) noexcept;

 private:
  Shift phase_;
  Shift offset_;
  AxisPosition followed_;
};

/// A shift as it will be in this tick.
Shift one_tick_on(const Shift& shift, const LeadingStep& step) noexcept;

/// Whether it is no longer, or not yet, at rest.
bool in_progress(const Shift& shift) noexcept;

}  // namespace lockstep
