/// The signals of the machine behind a drive: digital inputs, homing switches, hardware limit switches.
#pragma once

#include <memory>

#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/axis/encoders.hpp"
#include "tech_objects/axis/homing_course.hpp"
#include "tech_objects/axis/limit_switches.hpp"
#include "tech_objects/sensing/homing_marks.hpp"

namespace lockstep {

/// What the signals are looked at for, and what they change.
struct SwitchParts {
  AxisData& data;
  const bool& has_drive_;
  const std::unique_ptr<Drive>& drive_;
  const Encoders& encoders_;
  const Modulo& modulo_;
  const Setpoint& setpoint_;
  const PowerState& power_state_;
  const double& actual_velocity_;
  HomingCourse& homing_;
  LimitSwitches& limit_switches_;
  bool& signals_watched_;
};

/// Raises nothing: who asks is told. Thread: the cycle.
class SwitchOrders : private SwitchParts {
 public:
  explicit SwitchOrders(const SwitchParts& parts) noexcept : SwitchParts(parts) {}

  /// Whether the signals are looked at in every servo cycle from now on.
  void renew_watch() noexcept;

  // ---- Each servo cycle, while there are signals that matter

  /// Writes the digital inputs to their tags. @return where the machine is [u]
  double read_inputs() noexcept;
  /// @param side 1, -1 @param place of the machine [u] @return whether the axis has met the switch there so
  /// that it must not go on
  bool meets_limit_switch(int side, double place) noexcept;
  /// What the alarm at a switch has the axis do.
  AlarmReaction reaction() const noexcept { return limit_switches_.reaction(data.PositionLimits_HW); }
  void look_for_mark(double place) noexcept;

  // ---- Homing

  /// What a homing, active or in passing, has for a switch.
  HomeSwitch home_switch(bool active) const noexcept;
  /// From now on a mark is looked for.
  void search_mark(bool active, int direction) noexcept;
  /// Whether an active homing turns round at a hardware limit switch.
  bool homing_reverses() const noexcept { return homing_.seeks() && data.Homing.AutoReversal; }

  /// PositionLimits_HW.Active at run time, until a restart.
  ErrorId activate_limit_switches(bool active) noexcept;

 private:
  bool always_watched() const noexcept;
  bool on_home_switch(double place) const noexcept;
  /// After which distance the machine is where it was [u]; 0: never.
  double turn() const noexcept { return modulo_.enabled ? modulo_.length : 0.0; }
};

}  // namespace lockstep
