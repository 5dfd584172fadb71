/// The drive of an axis, a simulated one, and the position control between axis and drive.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "tech_objects/axis_position.hpp"
#include "tech_objects/double_double.hpp"
#include "tech_objects/machine_signals.hpp"

namespace lockstep {

/// What a drive reports.
struct DriveActual {
  DoubleDouble position;  ///< [u] on a line, from where the drive was switched on; never wraps
  double velocity = 0.0;  ///< [u/s]
  bool enabled = false;
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
  /// Switches the drive on or off from the next `write` on.
  virtual void enable(bool on) noexcept = 0;
};

/// A simulated drive and its encoder.
struct SimulatedDriveSettings {
  double time_constant = 0.0;  ///< [s] ≥ 0, of the velocity loop as a first-order lag; 0: follows at once
  double dead_time = 0.0;      ///< [s] 0 … 254 servo cycles, whole or not; more counts as that
  double resolution = 0.0;     ///< [u] ≥ 0, increment of the encoder; 0: reports the position itself
  bool inverted = false;       ///< motor and its encoder turn the other way round than the machine
  MachineSignals signals{};    ///< what stands along its way; the drive itself takes no notice of it
};

/// Velocity loop as dead time and first-order lag, position as its integral, both exact for a setpoint that
/// is held from cycle to cycle. Switched off it takes 0 as its setpoint and so coasts to rest. Deterministic:
/// the only transcendental numbers are made in `configure`, by additions and multiplications.
class SimulatedDrive final : public Drive {
 public:
  static constexpr std::size_t kDelay = 256;  ///< servo cycles kept

  SimulatedDrive() noexcept { configure({}, 0.001); }
  /// Standing at position 0, switched off. `servo_cycle` [s] > 0. While loading.
  void configure(const SimulatedDriveSettings& settings, double servo_cycle) noexcept;

  DriveActual read() noexcept override;
  void write(double velocity) noexcept override;
  void enable(bool on) noexcept override { enabled_ = on; }

  /// [s] By what a setpoint of constant velocity is ahead of the actual position: dead time, time constant,
  /// and half a servo cycle for the setpoint being held.
  double known_delay() const noexcept { return known_delay_; }
  /// [s] The part of it that is no lag: dead time and half a servo cycle.
  double transport_delay() const noexcept { return transport_delay_; }

 private:
  /// A piece of a servo cycle in which the setpoint at the lag does not change.
  struct Piece {
    double duration = 0.0;  // [s]
    double decay = 0.0;     // 1 - exp(-duration / time constant)
    double lag = 0.0;       // [s] time constant · decay
  };
  static Piece piece(double duration, double time_constant) noexcept;
  void run(const Piece& piece, double velocity) noexcept;

  std::array<double, kDelay> written_{};  // velocity setpoints, by cycle
  std::size_t cycle_ = 0;
  std::size_t whole_cycles_ = 0;  // of dead time
  Piece before_;                  // of a cycle: with the setpoint one older
  Piece after_;
  double servo_cycle_ = 0.001;
  double resolution_ = 0.0;
  double known_delay_ = 0.0;
  double transport_delay_ = 0.0;
  DoubleDouble position_;
  double velocity_ = 0.0;
  DoubleDouble reported_;
  bool enabled_ = false;
};

/// @source S7-1500T synchronous operation V7, 13.2 (PositionControl)
struct PositionControlSettings {
  double kv = 10.0;    ///< [1/s] > 0
  double kpc = 100.0;  ///< [%] 0 … 150, velocity precontrol
  double delay = 0.0;  ///< [s] 0 … 254 servo cycles: of what is controlled
  double max_velocity = std::numeric_limits<double>::infinity();  ///< [u/s] > 0, at the drive
};

/// What one cycle of position control gives.
struct PositionControlled {
  double velocity = 0.0;  ///< [u/s] VelocitySetpoint, within ±max_velocity
  double control_difference =
      0.0;                ///< [u] StatusServo.ControlDifference: balanced setpoint - actual position
  AxisPosition balanced;  ///< StatusServo.BalancedPosition
  bool limited = false;   ///< the velocity was cut
};

/// Proportional position control with velocity precontrol. The setpoint is delayed by what is known of the
/// controlled side before it is compared with the actual position (balancing), so that the precontrol leaves
/// no control difference at constant velocity. The cycle's thread.
class PositionController {
 public:
  static constexpr std::size_t kDelay = 256;  ///< servo cycles kept

  /// `servo_cycle` [s] > 0. The history of setpoints stays. Kv and Kpc may change at run time.
  void configure(const PositionControlSettings& settings, double servo_cycle) noexcept;

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
  std::array<AxisPosition, kDelay> setpoints_{};
  std::size_t cycle_ = 0;
  std::size_t whole_cycles_ = 0;
  double part_ = 0.0;  // of a cycle
  PositionControlSettings settings_;
};

}  // namespace lockstep
