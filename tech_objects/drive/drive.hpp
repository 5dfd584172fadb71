/// The drive of an axis: what every kind of drive takes and tells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/drive/drive_settings.hpp"
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
  double maximum = std::numeric_limits<double>::infinity();  ///< [u/s] > 0, limit of the velocity
};

/// What an encoder of the machine tells, beside that of the drive.
struct SensorActual {
  DoubleDouble position{};  ///< [u] on a line, as it lies, from where the machine was at the beginning
  bool failed = true;       ///< it tells nothing
};

/// What an axis has to know of its drive beforehand.
struct DriveProperties {
  /// [s] ≥ 0, by what a setpoint of constant velocity is ahead of the actual position: dead time, time
  /// constant, and half a servo cycle for the setpoint being held.
  double known_delay = 0.0;
  double transport_delay = 0.0;  ///< [s] ≥ 0, the part of it that is no lag: dead time and half a servo cycle
  double dead_time = 0.0;        ///< [s] ≥ 0, after which a setpoint arrives
  bool tells_torque = false;     ///< whether DriveActual::torque has a meaning
};

/// Control and status words as they are at present.
struct DriveWords {
  std::uint16_t stw1 = kControlOff;
  std::uint16_t stw2 = 0;
  std::uint16_t zsw1 = 0;
};

/// A drive with a velocity setpoint that is switched on and off by the state machine of PROFIdrive: one of
/// any kind, whatever there is behind it. An axis that is not virtual makes one by its `DriveModel` and
/// configures it while loading; everything else happens in the cycle's thread and neither allocates nor
/// blocks. In every servo cycle: `read` once, `read_sensor` for each encoder of the machine, `write` or
/// `write_position` once; the rest in between, as it comes.
///
/// Positions are on a line, in units of the axis, in the direction in which motor and machine turn; the axis
/// knows its own direction. What a drive cannot do it need not override.
class Drive {
 public:
  virtual ~Drive() = default;

  // ---- While loading

  /// Standing at position 0, switched off. May allocate. @param servo_cycle [s] > 0
  /// @param motor_angle of the motor per distance of the machine [rad/u]; of a linear motor 1
  virtual DriveProperties configure(const DriveSettings& settings, double servo_cycle,
                                    double motor_angle) noexcept = 0;

  // ---- Each servo cycle

  /// Actual values at this cycle.
  virtual DriveActual read() noexcept = 0;
  /// [u/s] Velocity setpoint from this cycle on; what is written while the drive is off does not count.
  virtual void write(double velocity) noexcept = 0;
  /// In place of `write`: DSC. A drive without a position loop gets the velocity that such a loop would ask
  /// for at this moment.
  virtual void write_position(const PositionCommand& command) noexcept;
  /// An encoder of the machine. @param sensor 1 to 3: Sensor[2] to Sensor[4]
  virtual SensorActual read_sensor(std::size_t sensor) noexcept;

  // ---- Commands, from the next `write` on

  /// Control words 1 and 2: switching on, off and acknowledging.
  virtual void control(std::uint16_t stw1, std::uint16_t stw2) noexcept = 0;
  /// What the motor may make; for drives that have a torque.
  virtual void command_torque(const TorqueCommand& command) noexcept;
  /// Switches the drive on or off (OFF1).
  void enable(bool on) noexcept { control(on ? kControlOn : kControlOff, 0); }

  // ---- What it is

  /// The control words of the last `control`, and the states that have come of it.
  virtual DriveWords words() const noexcept = 0;
  /// Whether something is wrong that MC_Reset has to acknowledge, or a cause of that is there yet.
  virtual bool in_trouble() const noexcept = 0;
  /// What stands along the path of a simulated machine, on its own scale; it does not change. A drive of a
  /// real machine has none: its switches are tags, which the data block names.
  virtual const MachineSignals& signals() const noexcept;
};

/// A kind of drive, as "model" of a drive in a project names it.
struct DriveModel {
  std::string_view name;
  std::unique_ptr<Drive> (*make)() = nullptr;
};

}  // namespace lockstep
