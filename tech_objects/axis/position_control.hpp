/// Position control of an axis, on and off.
#pragma once

#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/axis/encoders.hpp"
#include "tech_objects/axis/hand_over.hpp"
#include "tech_objects/axis/position_loop.hpp"
#include "tech_objects/drive/drive.hpp"

namespace lockstep {

/// Where the axis is and is to be, and the loop between both.
struct PositionControlParts {
  const AxisData& data;
  Setpoint& setpoint_;
  Setpoint& last_setpoint_;
  const Modulo& modulo_;
  const bool& position_controlled_;
  const bool& has_position_;
  const bool& has_drive_;
  const AxisPosition& actual_;
  const double& actual_velocity_;
  const Encoders& encoders_;
  PositionLoop& loop_;
  const DriveProperties& drive_properties_;
  HandOverOrders& hand_over_;
};

/// Thread: the cycle.
class PositionControlOrders : private PositionControlParts {
 public:
  explicit PositionControlOrders(const PositionControlParts& parts) noexcept : PositionControlParts(parts) {}

  /// Taken up anew, position control begins where the axis is: with the setpoint ahead by what the drive is
  /// late.
  void set(bool on) noexcept;
  /// Position control begins anew from a setpoint that has moved at its velocity until now.
  void begin_anew(const ServoSetpoint& setpoint) noexcept;

  /// Dynamic servo control: the drive closes the position loop, on its own encoder.
  bool loop_in_drive() const noexcept { return data.PositionControl.EnableDSC && encoders_.operative() == 0; }

  /// By what the actual position is behind the setpoint of the servo at constant velocity [s].
  double setpoint_delay() const noexcept;
  /// What the balancing filter takes the controlled side to be late by [s]: with an axis model what that says
  /// of the velocity loop, else what the drive knows of itself.
  double control_delay() const noexcept;
};

}  // namespace lockstep
