/// The position controller between axis and drive.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "tech_objects/arithmetic/axis_position.hpp"

namespace lockstep {

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
  /// Begins anew from a setpoint that has moved by `distance` [u] in each servo cycle until now.
  void reset(AxisPosition setpoint, double distance, const Modulo& modulo) noexcept;

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
