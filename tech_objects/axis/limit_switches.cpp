#include "tech_objects/axis/limit_switches.hpp"

#include "tech_objects/types/published.hpp"

namespace lockstep {

bool LimitSwitches::pressed_at(int side, const TO_Struct_PositionLimitsHW& settings, bool signal) noexcept {
  const bool* const tag = side < 0 ? settings.MinSwitchAddress : settings.MaxSwitchAddress;
  if (tag == nullptr) return signal;
  return *tag == (side < 0 ? settings.MinSwitchLevel : settings.MaxSwitchLevel);
}

bool LimitSwitches::watch(int side, bool pressed, const Approach& approach,
                          const TO_Struct_PositionLimitsHW& settings) noexcept {
  Side& limit = sides_[side > 0 ? 1 : 0];
  const bool was_pressed = limit.pressed;
  limit.pressed = pressed;
  if (limit.beyond) {
    const bool inside =
        settings.Mode == LimitSwitchMode::cannot_be_overrun || side * (approach.place - limit.entered) < 0.0;
    if (!limit.pressed && inside && !limit.locked) limit.beyond = false;
    return false;
  }
  if (!limit.pressed || was_pressed) return false;
  limit.beyond = true;
  limit.entered = approach.place;
  if (!approach.controlled) return false;
  const bool retreats = side * approach.velocity < 0.0;
  // A moving axis that meets a switch from the wrong side has its switches swapped: neither way is safe.
  limit.locked = retreats && approach.moving;
  return limit.locked || !(retreats || approach.reverses);
}

bool LimitSwitches::forbid(double velocity) const noexcept {
  const auto forbids = [velocity](const Side& limit, int side) {
    return limit.beyond && (side * velocity > 0.0 || (limit.locked && velocity != 0.0));
  };
  return forbids(sides_[0], -1) || forbids(sides_[1], 1);
}

AlarmReaction LimitSwitches::reaction(const TO_Struct_PositionLimitsHW& settings) const noexcept {
  const bool keeps_enable = settings.Mode == LimitSwitchMode::cannot_be_overrun &&
                            settings.ApproachBehavior == ApproachBehavior::keep_enable;
  const bool both = sides_[0].beyond && sides_[1].beyond;
  const bool locked = sides_[0].locked || sides_[1].locked;
  return keeps_enable && !both && !locked ? AlarmReaction::stop_emergency : AlarmReaction::remove_enable;
}

}  // namespace lockstep
