/// Power of an axis and its braking: MC_Power, and what an alarm does in its stead.
/// @source S7-1500T axis functions, MC_Power; synchronous operation V7, 13.1.24
#pragma once

#include "tech_objects/axis/drive_control.hpp"
#include "tech_objects/axis/position_control.hpp"
#include "tech_objects/axis/stops.hpp"
#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

/// What switches on and off, and what the setpoint begins and ends with.
struct PowerParts {
  const AxisData& data;
  const PowerRequest& power;
  PowerState& power_state_;
  const bool& enable_removed_;
  EmergencyRamp& emergency_ramp_;
  Setpoint& setpoint_;
  AxisMotion& motion_;
  SingleAxisMotion& single_;
  const MotionLimits& limits_;
  const bool& position_controlled_;
  const bool& has_position_;
  const AxisPosition& actual_;
  const double& actual_velocity_;
  const bool& has_drive_;
  const bool& drive_running_;
  const bool& drive_inhibited_;
  const bool& drive_in_trouble_;
  DriveControl& drive_control_;
  HandOverOrders& hand_over_;
  PositionControlOrders& position_control_;
  JobEnds& ends_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
};

/// Thread: the cycle.
class PowerOrders : private PowerParts {
 public:
  explicit PowerOrders(const PowerParts& parts) noexcept : PowerParts(parts) {}

  /// Each tick in which the axis is not simply on.
  void step() noexcept;
  /// Ends all jobs, and brakes as MC_Power says.
  void begin_braking(PowerStopMode stop_mode) noexcept;
  /// Each tick while nothing moves the axis: the setpoint tracks the actual value. Its velocity fades to none
  /// far below the threshold of the standstill signal, without a step.
  void follow_actual() noexcept;
  /// The stop that has just been planned, from the setpoint, is to begin where the axis is. That is done in
  /// the next step, with the actual values of that tick. A virtual axis is where its setpoint is.
  void ask_for_emergency_ramp() noexcept {
    emergency_ramp_ = has_drive_ ? EmergencyRamp::due : EmergencyRamp::none;
  }

 private:
  void switch_on() noexcept;
  void take_up_motion() noexcept;
  void switch_off() noexcept;
};

}  // namespace lockstep
