/// A drive with a linear motor: position loop, current, and what the force of the motor moves.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tech_objects/drive/current_loop.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/drive/linear_motor_plant.hpp"
#include "tech_objects/drive/simulated_control_unit.hpp"

namespace lockstep {

/// Closes its position loop once per control cycle. Its target is the integral of the velocity setpoint,
/// which it takes as a ramp from the last one; with DSC what XERR refers to, going on with its pace. What the
/// current does not reach the target of a velocity does not run ahead of. Without pulses there is no current.
/// Units are mm, N and A. Deterministic.
class LinearMotorDrive final : public Drive {
 public:
  static constexpr int kMaximumControlCycles = 256;  ///< in a servo cycle

  DriveProperties configure(const DriveSettings& settings, double servo_cycle,
                            double motor_angle) noexcept override;

  DriveActual read() noexcept override;
  void write(double velocity) noexcept override;
  void write_position(const PositionCommand& command) noexcept override;
  void control(std::uint16_t stw1, std::uint16_t stw2) noexcept override;
  void command_torque(const TorqueCommand& command) noexcept override { force_ = command; }
  SensorActual read_sensor(std::size_t sensor) noexcept override {
    return unit_.read_sensor(sensor, moved());
  }

  DriveWords words() const noexcept override { return unit_.words(); }
  bool in_trouble() const noexcept override { return unit_.in_trouble(); }
  const MachineSignals& signals() const noexcept override { return unit_.signals(); }

  /// [A] In the last control cycle.
  double current() const noexcept { return current_; }
  const LinearMotorPlant& plant() const noexcept { return plant_; }

 private:
  void begin_cycle() noexcept;
  void run(double acceleration, bool waits) noexcept;
  void wait() noexcept;
  void coast() noexcept;
  void move(double force) noexcept;
  void aim_where_it_is() noexcept;
  double stop_setpoint() noexcept;
  void read_encoder(DriveActual& now) noexcept;
  DoubleDouble moved() const noexcept { return {plant_.position() - start_, 0.0}; }

  CurrentLoop loop_;
  LinearMotorPlant plant_;
  LoopSetpoint target_;
  double current_ = 0.0;         // [A]
  double mean_force_ = 0.0;      // of the motor, over the last servo cycle [N]
  double proportional_ = 0.0;    // [A/mm] > 0
  double force_constant_ = 1.0;  // [N/A]
  int control_cycles_ = 1;       // in a servo cycle
  double control_cycle_ = 0.001;
  double servo_cycle_ = 0.001;
  double start_ = 0.0;       // of the machine on its own scale [mm]
  double resolution_ = 0.0;  // [mm]
  double reported_ = 0.0;    // position [mm]
  double velocity_ = 0.0;    // reported [mm/s]
  bool brake_ = false;
  TorqueCommand force_;
  SimulatedControlUnit unit_;

  // Seldom of account.
  double quick_stop_ = 0.0;    // [mm/s²]
  double hardest_stop_ = 0.0;  // [mm/s²] that the motor can make
};

}  // namespace lockstep
