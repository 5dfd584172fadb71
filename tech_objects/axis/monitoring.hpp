/// What an axis with limits watches over: software limit switches, and hardware limit switches that it has
/// passed.
/// @source S7-1500T axis functions, traversing range limitation; alarms 531 to 534
#pragma once

#include "tech_objects/axis/limit_switches.hpp"
#include "tech_objects/axis/reactions.hpp"
#include "tech_objects/axis/software_limits.hpp"

namespace lockstep {

/// The setpoint made for this cycle, the one before it, and what can be done instead.
struct LimitParts {
  AxisData& data;
  const JobSlots& jobs_;
  const MotionLimits& limits_;
  const PowerState& power_state_;
  const bool& homed_;
  Setpoint& setpoint_;
  const Setpoint& last_setpoint_;
  const Modulo& modulo_;
  AxisMotion& motion_;
  SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  SoftwareLimits& software_limits_;
  const LimitSwitches& limit_switches_;
  const SwitchOrders& switches_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class LimitOrders : private LimitParts {
 public:
  explicit LimitOrders(const LimitParts& parts) noexcept : LimitParts(parts) {}

  /// Each cycle in which the limits are active, after the setpoint has been made: where the next one could no
  /// longer stop in front of a limit, the axis has to brake from the last one on.
  void watch() noexcept;
  /// Beyond a switch the axis may only come back: another setpoint ends in the alarm before anyone sees it.
  /// Not so where homing turns round, or has given up there and brakes.
  void hold_limit_switches() noexcept;

 private:
  bool keep_within(int side, double limit) noexcept;
  Dynamics limit_dynamics() const noexcept;
  void stop_at_limit(int side, AxisPosition limit, Dynamics dynamics) noexcept;
  AlarmReaction reaction_at_limit() const noexcept;
  void approach_limit(double distance, AxisPosition limit, const Dynamics& dynamics) noexcept;
};

}  // namespace lockstep
