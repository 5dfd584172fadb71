/// Position control of an axis with a drive, in every servo cycle.
/// @source S7-1500T synchronous operation V7, 13.1 (PositionControl, SetpointFilter, FollowingError)
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/drive/position_controller.hpp"
#include "tech_objects/drive/setpoint_filter.hpp"
#include "tech_objects/filters/first_order_lag.hpp"

namespace lockstep {

/// From a setpoint to the velocity for the drive: dynamic filter, position controller with precontrol, what
/// is smoothed of switchovers, and the following error that comes of it. The cycle's thread.
class PositionLoop {
 public:
  /// What one servo cycle starts from.
  struct Input {
    ServoSetpoint setpoint;
    AxisPosition actual;
    double passing = 0.0;   ///< [u/s] velocity that passes the backlash
    bool passes = false;    ///< whether backlash is compensated at all
    bool in_drive = false;  ///< the drive closes the loop (DSC)
  };
  /// What comes of it.
  struct Output {
    double velocity = 0.0;         ///< [u/s] VelocitySetpoint, within ± the limit of the drive
    double xerr = 0.0;             ///< [u] control difference for the loop of the drive
    double pace = 0.0;             ///< [u/s] at which what that loop follows goes on
    double filtered = 0.0;         ///< [u] StatusServo.PositionAfterDynamicFilter
    double filter_delay = 0.0;     ///< [s]
    double balanced = 0.0;         ///< [u] StatusServo.BalancedPosition
    double difference = 0.0;       ///< [u] StatusServo.ControlDifference
    double following_error = 0.0;  ///< [u] StatusPositioning.FollowingError
    ServoSetpoint controlled;      ///< behind the filter
    bool limited = false;          ///< the velocity has been cut to what the drive can do
  };
  /// How large the following error is, against what is permitted at a velocity.
  enum class FollowingErrorLevel : std::uint8_t { permitted, warning, exceeded };

  /// Settings that count from the start, or a restart, on. @param cycle of the servo [s]
  void configure(const Modulo& modulo, double cycle) noexcept;
  /// The controller. The history of its setpoints stays.
  void configure_controller(const PositionControlSettings& settings) noexcept {
    controller_.configure(settings, cycle_);
  }

  /// Begins anew from a setpoint that has moved at its velocity until now.
  void reset(const ServoSetpoint& setpoint, const TO_Struct_DynamicFilter& filter) noexcept;
  /// Homing [u].
  void shift(double by) noexcept;

  /// One servo cycle. All of the settings counts at once.
  Output step(const Input& input, const PositionControlSettings& control, const AxisData& data) noexcept;

  /// [s] By what the filter is late; 0 if it is not in effect.
  double filter_delay(const TO_Struct_DynamicFilter& filter) const noexcept { return filter_.delay(filter); }
  /// [u] Position behind filter and balancing, as it has been shown last.
  AxisPosition balanced() const noexcept { return balanced_; }

  /// The actual position is another one from now on, by this [u]: with a smoothing time [s] the controller
  /// notices bit by bit.
  void deviate(double by, double time) noexcept;
  /// The velocity for the drive changes by this [u/s] at a switchover: with a smoothing time [s] it comes
  /// bit by bit.
  void switch_over(double change, double time) noexcept;
  /// What of a velocity is to reach the drive now, within ±`limit` [u/s].
  double switched_over(double velocity, double limit) noexcept;

  /// Permissible following error at a velocity setpoint [u]. @param maximum of the axis [u/s]
  static double permissible_error(double velocity, double maximum,
                                  const TO_Struct_FollowingError& monitoring) noexcept;
  /// @param velocity of the setpoint before the controller [u/s]  @param maximum MaxVelocity [u/s]
  static FollowingErrorLevel level_of(double error, double velocity, double maximum,
                                      const TO_Struct_FollowingError& monitoring) noexcept;

 private:
  void tune(const PositionControlSettings& control, double difference, double time) noexcept;
  double delayed_error(AxisPosition balanced, double time) noexcept;

  Modulo modulo_;
  double cycle_ = 0.001;         // of the servo [s]
  AxisPosition balanced_;        // in the last cycle
  FirstOrderLag following_lag_;  // FollowingError.AdditionalSetpointDelayTime
  FirstOrderLag smoothing_;      // of what MC_SetSensor has changed
  FirstOrderLag switchover_;     // of the velocity for the drive
  PositionController controller_;
  DynamicFilter filter_;
};

}  // namespace lockstep
