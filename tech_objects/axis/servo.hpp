/// MC_Servo of an axis with a drive: actual values, fine interpolation, position control.
#pragma once

#include "tech_objects/axis/faults.hpp"
#include "tech_objects/axis/forces.hpp"

namespace lockstep {

/// What every servo cycle touches.
struct ServoParts {
  AxisData& data;
  const DriveSettings& drive_settings;
  const bool& has_position_;
  const bool& has_drive_;
  const std::unique_ptr<Drive>& drive_;
  const DriveProperties& drive_properties_;
  const PowerState& power_state_;
  const EmergencyRamp& emergency_ramp_;
  const bool& position_controlled_;
  const Setpoint& setpoint_;
  const Setpoint& last_setpoint_;
  const Modulo& modulo_;
  const double& period_;
  const double& servo_period_;
  const int& ratio_;
  int& servo_tick_;
  double& setpoint_sign_;
  double& distance_per_motor_turn_;
  double& motor_limit_;
  double& actual_torque_;
  bool& drive_running_;
  const bool& drive_in_trouble_;
  bool& drive_inhibited_;
  const bool& signals_watched_;
  AxisPosition& actual_;
  double& actual_velocity_;
  Encoders& encoders_;
  Backlash& backlash_;
  PositionLoop& loop_;
  const AxisForces& forces_;
  PositionControlOrders& position_control_;
  SwitchOrders& switches_;
  SensorOrders& sensors_;
  DriveFaults& faults_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class ServoOrders : private ServoParts {
 public:
  explicit ServoOrders(const ServoParts& parts) noexcept : ServoParts(parts) {}

  /// Settings that count from the start, or a restart, on.
  void take_settings() noexcept;
  PositionControlSettings control_settings() const noexcept;
  /// Of the motor in a plant [rad/u]; a linear motor moves as the axis does.
  double motor_angle_per_unit() const noexcept;
  /// A setpoint is handed to the drive, at the end of the fine interpolation, one interpolator cycle later.
  void show_execution_time() noexcept;

  /// One servo tick.
  void step() noexcept;
  /// Simulated, the axis leaves its drive alone.
  void idle() noexcept;

 private:
  double distance_per_motor_turn() const noexcept;
  void read_drive() noexcept;
  void watch_signals() noexcept;
  ServoSetpoint fine_setpoint_now() const noexcept;
  PositionLoop::Output control_position() noexcept;
  void watch_following_error(double velocity) noexcept;
  void limit_speed() noexcept;
};

}  // namespace lockstep
