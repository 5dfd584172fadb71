/// The emergency ramp of an axis with a drive: MC_Stop Mode 0, MC_Power StopMode 0, alarm reactions.
/// @source S7-1500T axis functions, stop reactions; synchronous operation V7, 13.1.22, 13.1.24
#pragma once

#include "tech_objects/axis/clamping.hpp"
#include "tech_objects/axis/position_control.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"

namespace lockstep {

/// The setpoint, where the axis is, and what the drive has been told.
struct EmergencyParts {
  const AxisData& data;
  const MotionLimits& limits_;
  EmergencyRamp& emergency_ramp_;
  Setpoint& setpoint_;
  Setpoint& last_setpoint_;
  const Modulo& modulo_;
  const AxisMotion& motion_;
  SingleAxisMotion& single_;
  const bool& homed_;
  const bool& position_controlled_;
  const AxisPosition& actual_;
  const double& actual_velocity_;
  const Encoders& encoders_;
  const Clamping& clamping_;
  PositionLoop& loop_;
  HandOverOrders& hand_over_;
  PositionControlOrders& position_control_;
};

/// Thread: the cycle.
class EmergencyOrders : private EmergencyParts {
 public:
  explicit EmergencyOrders(const EmergencyParts& parts) noexcept : EmergencyParts(parts) {}

  /// Each step while such a ramp is asked for or under way, before the setpoint goes on.
  void step() noexcept;

 private:
  void brake_from_actual() noexcept;
  void take_actual_state(double commanded) noexcept;
  void stay_within_limits(const Setpoint& before) noexcept;
  double commanded_velocity() const noexcept;
};

}  // namespace lockstep
