/// A simulated drive, and the machine that it moves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/drive/encoder_source.hpp"
#include "tech_objects/drive/machine_plant.hpp"
#include "tech_objects/drive/simulated_control_unit.hpp"

namespace lockstep {

/// Velocity loop as dead time and first-order lag, position as its integral, both exact for a setpoint that
/// is held from cycle to cycle; with a plant the torque that this takes, and what happens when it is not
/// there. Switched off (without plant) it takes 0 as its setpoint and so coasts to rest. Deterministic: the
/// only transcendental numbers are made in `configure`, by additions and multiplications.
class alignas(kCacheLine) SimulatedDrive final : public Drive {
 public:
  static constexpr std::size_t kDelay = 256;  ///< servo cycles kept

  SimulatedDrive() noexcept { configure({}, 0.001, 1.0); }
  DriveProperties configure(const DriveSettings& settings, double servo_cycle,
                            double motor_angle) noexcept override;

  // Here, so that who knows that its drive is simulated has what it reads where it needs it.
  DriveActual read() noexcept override {
    return unit_.tell(plant_.torque(), [this](DriveActual& now) noexcept { read_encoder(now); });
  }
  /// Whether nothing goes wrong with it and it tells no increments: then `read` has nothing to tell but what
  /// the members behind this one do.
  bool exact() const noexcept { return !unit_.has_faults() && !(resolution_ > 0.0); }
  /// [u] From the last reading to this one.
  double read_distance() noexcept {
    const double distance = rounded_difference(position_, reported_);
    reported_ = position_;
    return distance;
  }
  double velocity() const noexcept { return velocity_; }                         ///< [u/s]
  double torque() const noexcept { return has_plant_ ? plant_.torque() : 0.0; }  ///< `DriveActual::torque`
  bool operates() const noexcept { return operates_; }                           ///< `DriveActual::enabled`
  /// Whether the last `write` has changed nothing: all of that is as it was.
  bool rests() const noexcept { return rests_; }
  void write(double velocity) noexcept override;
  void write_position(const PositionCommand& command) noexcept override;
  void control(std::uint16_t stw1, std::uint16_t stw2) noexcept override;
  void command_torque(const TorqueCommand& command) noexcept override {
    additive_torque_ = command.additive;
    permitted_ = plant_.permitted(command.band);
    rests_ = false;
  }

  SensorActual read_sensor(std::size_t sensor) noexcept override {
    return unit_.read_sensor(sensor, position_);
  }

  DriveWords words() const noexcept override { return unit_.words(); }
  bool in_trouble() const noexcept override { return unit_.in_trouble(); }
  const MachineSignals& signals() const noexcept override { return unit_.signals(); }
  const DriveStates& states() const noexcept { return unit_.states(); }
  /// [u] Where the machine truly is, on the line of the drive's encoder.
  const DoubleDouble& machine_position() const noexcept { return position_; }

 private:
  /// A piece of a servo cycle in which the setpoint at the lag does not change: the velocity loop as a linear
  /// system, discretized exactly. What (position, velocity) changes by is a multiple of the setpoint, and one
  /// of what the setpoint is above the velocity.
  struct Piece {
    double duration = 0.0;                                    // [s]
    Eigen::Vector2d by_setpoint = Eigen::Vector2d::Zero();    // duration, 0
    Eigen::Vector2d by_difference = Eigen::Vector2d::Zero();  // -time constant · decay, decay
  };
  /// Of the position loop in the drive.
  struct Target {
    DoubleDouble position;  // [u]
    double kpc = 0.0;       // [1/s]; 0: the velocity counts alone
    double pace = 0.0;      // [u/s]
    double maximum = 0.0;   // [u/s]
  };
  static Piece piece(double duration, double time_constant) noexcept;
  void run(const Piece& piece, double velocity) noexcept;
  /// Index in `written_` and `targets_` of what is written in a cycle. Only as much memory is touched as the
  /// dead time needs.
  std::size_t kept(std::size_t cycle) const noexcept { return cycle & (ring_ - 1); }
  /// What a cycle may change beside setpoints that are kept.
  struct Motion {
    DoubleDouble position;
    double velocity;
    MachinePlant::Memory plant;
  };
  void note_states() noexcept { operates_ = states().operation(); }
  void choose_path() noexcept;
  void write_with_all(double velocity) noexcept;
  void write_at_standstill(double velocity) noexcept;
  DoubleDouble arriving() const noexcept;
  void look_for_rest(const Motion& before, const DoubleDouble& setpoints) noexcept;
  void run_position_loop() noexcept;
  void read_encoder(DriveActual& now) noexcept {
    now.position = position_;
    now.velocity = velocity_;
    if (resolution_ > 0.0) {
      now.position = quantised(position_, resolution_);
      now.velocity = (now.position - reported_).rounded() / servo_cycle_;
    }
    reported_ = now.position;
  }
  double quick_stop_setpoint() noexcept;
  void move_plant(const DoubleDouble& position_before, double velocity_before) noexcept;

  // In lines of the cache: of many drives it is the lines which a cycle touches that take its time. First
  // what one at rest needs.
  bool at_once_ = false;   // a setpoint counts in the cycle in which it is written, and nothing else does
  bool operates_ = false;  // `states().operation()`
  bool has_plant_ = false;
  // What setpoints (older and newer one) have not moved by a bit they do not move in the next cycle either.
  // At rest velocities are below 2^-1022, and to compute with those takes a processor tens of times as long.
  bool rests_ = false;
  double velocity_ = 0.0;
  double last_setpoint_ = 0.0;  // heard last [u/s]
  DoubleDouble rested_;
  DoubleDouble position_;

  // What one that moves needs besides.
  Piece after_;  // of a cycle: with the setpoint that arrives in it
  DoubleDouble reported_;

  // What one with a plant needs.
  double additive_torque_ = 0.0;
  TorqueBand permitted_;  // of what has been commanded, that the plant permits
  MachinePlant plant_;

  // What its states are read from.
  SimulatedControlUnit unit_;

  // What one with a dead time needs, or increments.
  double servo_cycle_ = 0.001;
  double resolution_ = 0.0;
  std::size_t ring_ = 1;  // of written_, as many as are kept; a power of two
  std::size_t cycle_ = 0;
  std::size_t whole_cycles_ = 0;          // of dead time
  std::size_t loop_cycles_ = 0;           // in which a target of the position loop may still be under way
  Piece before_;                          // of a cycle: with the setpoint one older
  std::array<double, kDelay> written_{};  // velocity setpoints, by cycle

  // Seldom of account.
  double quick_stop_ = 0.0;               // [u/s²]
  double ramp_ = 0.0;                     // setpoint of a quick stop [u/s]
  std::array<Target, kDelay> targets_{};  // by cycle, as the velocity setpoints
  Target next_target_;
  int steps_ = 1;  // of the position loop in a servo cycle
  Piece step_;
  double arrival_ = 0.0;  // [s] of a setpoint, from the beginning of its servo cycle
};

}  // namespace lockstep
