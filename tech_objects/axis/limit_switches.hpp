/// The hardware limit switches of an axis with a drive.
/// @source S7-1500T axis functions, traversing range limitation; alarm 531
#pragma once

#include <array>

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// Which of the two switches are pressed, and beyond which of them the axis is: where a switch is pressed,
/// and, if it can be overrun, until the axis has come back over it. Sides are 1, the positive one, and -1.
/// The cycle's thread.
class LimitSwitches {
 public:
  /// An axis that may come to a switch.
  struct Approach {
    double place = 0.0;       ///< [u] on the scale of the machine
    double velocity = 0.0;    ///< [u/s] of the setpoint
    bool controlled = false;  ///< whether the setpoint leads it
    bool moving = false;      ///< by its actual velocity
    bool reverses = false;    ///< whether a homing turns it round at the switch
  };

  /// Whether a switch is pressed, by its tag; where it has none, by the signal of the machine.
  static bool pressed_at(int side, const TO_Struct_PositionLimitsHW& settings, bool signal) noexcept;

  /// One servo cycle of the switch at a side.
  /// @return whether the axis has met it so that it must not go on
  bool watch(int side, bool pressed, const Approach& approach,
             const TO_Struct_PositionLimitsHW& settings) noexcept;

  bool pressed(int side) const noexcept { return of(side).pressed; }
  bool beyond(int side) const noexcept { return of(side).beyond; }
  bool beyond_any() const noexcept { return sides_[0].beyond || sides_[1].beyond; }

  /// Whether a setpoint may not have this velocity [u/s]: beyond a switch the axis may only come back.
  bool forbid(double velocity) const noexcept;
  /// What the alarm has the axis do.
  AlarmReaction reaction(const TO_Struct_PositionLimitsHW& settings) const noexcept;

 private:
  struct Side {
    bool pressed = false;
    bool beyond = false;   // pressed, or overrun and not yet come back over
    bool locked = false;   // approached in the wrong direction: until a restart
    double entered = 0.0;  // where it was met [u] on the scale of the machine
  };
  const Side& of(int side) const noexcept { return sides_[side > 0 ? 1 : 0]; }

  std::array<Side, 2> sides_{};  // negative, positive
};

}  // namespace lockstep
