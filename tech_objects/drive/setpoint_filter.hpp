/// The dynamic filter between the setpoint of an axis and its position control: it makes an axis as slow as
/// another one, so that both keep their places to each other.
/// @source S7-1500T synchronous operation V7, 13.1.23 (SetpointFilter)
#pragma once

#include <array>
#include <cstddef>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/filters/first_order_lag.hpp"

namespace lockstep {

/// Position and velocity of a setpoint in a servo cycle.
struct ServoSetpoint {
  AxisPosition position;
  double velocity = 0.0;  ///< [u/s]
};

/// PT2 filter and dead time. Behind a ramp it is late by T1 + T2 + Tt exactly. The cycle's thread.
class DynamicFilter {
 public:
  static constexpr std::size_t kMaximumDeadCycles = 16;  ///< of MC_Servo; a longer Tt counts as that

  void configure(const Modulo& modulo, double servo_cycle) noexcept;

  /// [s] By what the filter is late with these settings; 0 if it is not in effect.
  double delay(const TO_Struct_DynamicFilter& settings) const noexcept;

  /// Begins anew with a setpoint that has moved at its velocity until now.
  void reset(const ServoSetpoint& setpoint, const TO_Struct_DynamicFilter& settings) noexcept;
  /// Shifts everything, for homing [u].
  void shift(double by) noexcept;

  /// One servo cycle.
  ServoSetpoint step(const ServoSetpoint& setpoint, const TO_Struct_DynamicFilter& settings) noexcept;

 private:
  static constexpr std::size_t kKept = kMaximumDeadCycles + 2;

  void tune(const TO_Struct_DynamicFilter& settings) noexcept;
  double dead_cycles(const TO_Struct_DynamicFilter& settings) const noexcept;

  Modulo modulo_;
  double servo_cycle_ = 0.001;
  ServoSetpoint last_;
  Pt2Filter position_;
  Pt2Filter velocity_;
  std::array<ServoSetpoint, kKept> filtered_{};  // by cycle
  std::size_t cycle_ = 0;
};

}  // namespace lockstep
