/// The drive of an axis, a simulated one, and the position control between axis and drive.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/drive/machine_plant.hpp"
#include "tech_objects/drive/machine_signals.hpp"
#include "tech_objects/drive/profidrive.hpp"

namespace lockstep {

/// What a drive reports.
struct DriveActual {
  DoubleDouble position{};      ///< [u] on a line, from where the drive was switched on; never wraps
  double velocity = 0.0;        ///< [u/s]
  bool enabled = false;         ///< ZSW1: it follows its setpoint
  double torque = 0.0;          ///< of the motor, in the direction of the machine
  bool trouble = false;         ///< one of the three below
  bool fault = false;           ///< ZSW1: a fault of the drive waits to be acknowledged
  bool encoder_failed = false;  ///< position and velocity are those of before
  bool silent = false;          ///< no communication: everything is as it was before
  bool inhibited = false;       ///< ZSW1: it has to be told OFF1 before it can be switched on
};

/// What a motor may make, and what is added to its torque, in the direction of the machine.
struct TorqueCommand {
  TorqueBand band{};
  double additive = 0.0;
};

/// What a drive gets that closes the position loop itself, on its own encoder: in words of telegram 105.
/// @source PROFIdrive, dynamic servo control
struct PositionCommand {
  double velocity = 0.0;  ///< [u/s] NSOLL_B, the precontrol
  double xerr = 0.0;      ///< [u] XERR, control difference at the position that has been read in this cycle
  double kpc = 0.0;       ///< [1/s] KPC; 0: velocity counts alone
  /// [u/s] At which what XERR refers to goes on until the next command. The telegram has no word for it: a
  /// drive takes it from one XERR to the next.
  double pace = 0.0;
  double most = std::numeric_limits<double>::infinity();  ///< [u/s] > 0, limit of the velocity
};

/// A drive with a velocity setpoint. In every servo cycle: `read` once, then `write` once. The cycle's
/// thread.
class Drive {
 public:
  virtual ~Drive() = default;
  /// Actual values at this cycle.
  virtual DriveActual read() noexcept = 0;
  /// [u/s] Velocity setpoint from this cycle on; what is written while the drive is off does not count.
  virtual void write(double velocity) noexcept = 0;
  /// In place of `write`: DSC.
  virtual void write_position(const PositionCommand& command) noexcept = 0;
  /// Control words 1 and 2: switching on, off and acknowledging, from the next `write` on.
  virtual void control(std::uint16_t stw1, std::uint16_t stw2) noexcept = 0;
  /// Counts from the next `write` on.
  virtual void command_torque(const TorqueCommand& command) noexcept = 0;
  /// Switches the drive on or off (OFF1) from the next `write` on.
  void enable(bool on) noexcept { control(on ? kControlOn : kControlOff, 0); }
};

/// What goes wrong at a simulated drive while the BOOL is TRUE; nullptr: nothing ever does.
struct SimulatedFaults {
  const bool* drive = nullptr;          ///< a fault of the drive: it loses its torque
  const bool* encoder = nullptr;        ///< no position any more
  const bool* communication = nullptr;  ///< neither setpoints nor actual values; the drive stops by itself
  const bool* blocked = nullptr;        ///< nothing moves, whatever the torque
};

/// A further encoder of a simulated machine, beside that of the drive.
struct SimulatedSensor {
  bool exists = false;
  double ratio = 1.0;           ///< [u] that it tells per [u] of the machine, not 0
  double resolution = 0.0;      ///< [u] ≥ 0, its increment; 0: none
  bool inverted = false;        ///< it turns the other way round than the machine
  double start_position = 0.0;  ///< [u] what it tells at the beginning, of an absolute one
  const bool* fault = nullptr;  ///< BOOL tag: while TRUE it tells nothing; nullptr: it never fails
};

/// A simulated drive and its encoder.
struct SimulatedDriveSettings {
  double time_constant = 0.0;    ///< [s] ≥ 0, of the velocity loop as a first-order lag; 0: follows at once
  double dead_time = 0.0;        ///< [s] 0 … 254 servo cycles, whole or not; more counts as that
  double resolution = 0.0;       ///< [u] ≥ 0, increment of the encoder; 0: reports the position itself
  bool inverted = false;         ///< motor and its encoder turn the other way round than the machine
  MachineSignals signals{};      ///< what stands along its way; the drive itself takes no notice of it
  MachinePlantSettings plant{};  ///< what it moves; of no effect without inertia
  double quick_stop = 0.0;       ///< [u/s²] ≥ 0, deceleration of OFF3; 0: as hard as the drive can
  SimulatedFaults faults{};
  double position_cycle = 0.000125;          ///< [s] > 0, of the drive's own position loop (DSC)
  std::array<SimulatedSensor, 3> sensors{};  ///< Sensor[2] to Sensor[4]
};

/// Velocity loop as dead time and first-order lag, position as its integral, both exact for a setpoint that
/// is held from cycle to cycle; with a plant the torque that this takes, and what happens when it is not
/// there. Switched off (without plant) it takes 0 as its setpoint and so coasts to rest. Deterministic: the
/// only transcendental numbers are made in `configure`, by additions and multiplications.
class SimulatedDrive final : public Drive {
 public:
  static constexpr std::size_t kDelay = 256;  ///< servo cycles kept

  SimulatedDrive() noexcept { configure({}, 0.001); }
  /// Standing at position 0, switched off. `servo_cycle` [s] > 0. While loading.
  /// @param motor_angle of the motor per way of the machine [rad/u], for the plant; of a linear motor 1
  void configure(const SimulatedDriveSettings& settings, double servo_cycle,
                 double motor_angle = 1.0) noexcept;

  DriveActual read() noexcept override;
  void write(double velocity) noexcept override;
  void write_position(const PositionCommand& command) noexcept override;
  void control(std::uint16_t stw1, std::uint16_t stw2) noexcept override;
  void command_torque(const TorqueCommand& command) noexcept override { torque_ = command; }

  /// Whether a cause of a fault is there, or one waits to be acknowledged.
  bool in_trouble() const noexcept;
  const DriveStates& states() const noexcept { return states_; }
  /// Whether it knows what torque it makes.
  bool has_plant() const noexcept { return plant_.exists(); }
  std::uint16_t stw1() const noexcept { return stw1_; }
  std::uint16_t stw2() const noexcept { return stw2_; }

  /// [s] By what a setpoint of constant velocity is ahead of the actual position: dead time, time constant,
  /// and half a servo cycle for the setpoint being held.
  double known_delay() const noexcept { return known_delay_; }
  /// [s] The part of it that is no lag: dead time and half a servo cycle.
  double transport_delay() const noexcept { return transport_delay_; }
  /// [s] After which a setpoint arrives.
  double dead_time() const noexcept { return transport_delay_ - 0.5 * servo_cycle_; }
  /// [u] Where the machine truly is, on the line of the drive's encoder.
  const DoubleDouble& machine_position() const noexcept { return position_; }

 private:
  /// A piece of a servo cycle in which the setpoint at the lag does not change.
  struct Piece {
    double duration = 0.0;  // [s]
    double decay = 0.0;     // 1 - exp(-duration / time constant)
    double lag = 0.0;       // [s] time constant · decay
  };
  /// Of the position loop in the drive.
  struct Target {
    DoubleDouble position;  // [u]
    double kpc = 0.0;       // [1/s]; 0: the velocity counts alone
    double pace = 0.0;      // [u/s]
    double most = 0.0;      // [u/s]
  };
  static Piece piece(double duration, double time_constant) noexcept;
  void run(const Piece& piece, double velocity) noexcept;
  /// Place in `written_` and `targets_` of what is written in a cycle. Only as much memory is touched as the
  /// dead time needs.
  std::size_t kept(std::size_t cycle) const noexcept { return cycle & (ring_ - 1); }
  void run_position_loop() noexcept;
  void read_encoder(DriveActual& now) noexcept;
  double quick_stop_setpoint() noexcept;
  void watch_causes() noexcept;
  void move_plant(const DoubleDouble& position_before, double velocity_before) noexcept;
  void watch_stop() noexcept;

  // What every cycle touches, in lines of the cache.
  std::size_t ring_ = 1;  // of written_, as many as are kept; a power of two
  std::size_t cycle_ = 0;
  std::size_t whole_cycles_ = 0;  // of dead time
  DoubleDouble position_;
  double velocity_ = 0.0;
  DriveStates states_;
  bool has_faults_ = false;
  bool blocked_ = false;

  Piece before_;  // of a cycle: with the setpoint one older
  Piece after_;
  double last_setpoint_ = 0.0;   // heard last [u/s]
  std::size_t loop_cycles_ = 0;  // in which a target of the position loop may still be under way

  double servo_cycle_ = 0.001;
  double resolution_ = 0.0;
  DoubleDouble reported_;
  MachinePlant plant_;

  std::array<double, kDelay> written_{};  // velocity setpoints, by cycle

  // Seldom of account.
  double known_delay_ = 0.0;
  double transport_delay_ = 0.0;
  std::uint16_t stw1_ = kControlOff;
  std::uint16_t stw2_ = 0;
  int stopping_cycles_ = 0;     // of a stop of its own
  double stop_velocity_ = 0.0;  // at its begin [u/s]
  double quick_stop_ = 0.0;     // [u/s²]
  double ramp_ = 0.0;           // setpoint of a quick stop [u/s]
  double most_stop_cycles_ = 0.0;
  std::array<Target, kDelay> targets_{};  // by cycle, as the velocity setpoints
  Target next_target_;
  int steps_ = 1;  // of the position loop in a servo cycle
  Piece step_;
  double arrival_ = 0.0;  // [s] of a setpoint, from the beginning of its servo cycle
  TorqueCommand torque_;
  SimulatedFaults faults_;
  DriveActual told_;  // last, for a drive that falls silent
};

/// @source S7-1500T synchronous operation V7, 13.2 (PositionControl)
struct PositionControlSettings {
  double kv = 10.0;    ///< [1/s] > 0
  double kpc = 100.0;  ///< [%] 0 … 150, velocity precontrol
  double delay = 0.0;  ///< [s] 0 … 254 servo cycles: of what is controlled
  double max_velocity = std::numeric_limits<double>::infinity();  ///< [u/s] > 0, at the drive
  double lead = -1.0;  ///< [s] ≥ 0: by what `xerr` is taken earlier than that; negative: it is not wanted

  bool operator==(const PositionControlSettings&) const = default;
};

/// What one cycle of position control gives.
struct PositionControlled {
  double velocity = 0.0;  ///< [u/s] VelocitySetpoint, within ±max_velocity
  double control_difference =
      0.0;                ///< [u] StatusServo.ControlDifference: balanced setpoint - actual position
  AxisPosition balanced;  ///< StatusServo.BalancedPosition
  bool limited = false;   ///< the velocity was cut
  double xerr = 0.0;      ///< [u] control difference for a position loop in the drive
};

/// Proportional position control with velocity precontrol. The setpoint is delayed by what is known of the
/// controlled side before it is compared with the actual position (balancing), so that the precontrol leaves
/// no control difference at constant velocity. The cycle's thread.
class PositionController {
 public:
  static constexpr std::size_t kDelay = 256;  ///< servo cycles kept

  /// `servo_cycle` [s] > 0. The history of setpoints stays. Kv and Kpc may change at run time.
  void configure(const PositionControlSettings& settings, double servo_cycle) noexcept;
  const PositionControlSettings& settings() const noexcept { return settings_; }

  /// Begins anew from a standing setpoint: before the first step, and after switching on.
  void reset(AxisPosition setpoint) noexcept;
  /// Begins anew from a setpoint that has moved by `way` [u] in each servo cycle until now.
  void reset(AxisPosition setpoint, double way, const Modulo& modulo) noexcept;

  /// Shifts the history of setpoints [u], for homing: the controlled side does not notice.
  void shift(double by, const Modulo& modulo) noexcept;

  /// One servo cycle. `velocity` [u/s] is that of the setpoint. Positions of the axis with its turns; works
  /// across the ends of the ring.
  PositionControlled step(AxisPosition setpoint, double velocity, AxisPosition actual,
                          const Modulo& modulo) noexcept;

 private:
  AxisPosition delayed(std::size_t whole, double part, const Modulo& modulo) const noexcept;

  std::size_t cycle_ = 0;
  std::size_t whole_cycles_ = 0;
  double part_ = 0.0;  // of a cycle
  PositionControlSettings settings_;
  std::size_t whole_ahead_ = 0;
  double part_ahead_ = 0.0;
  std::array<AxisPosition, kDelay> setpoints_{};
};

}  // namespace lockstep
