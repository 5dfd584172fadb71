/// Of the technology data block of an axis: mechanics, limits, position control and monitoring, as
/// configured.
/// @source S7-1500T synchronous operation V7, 13.1
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Axis properties.
struct TO_Struct_Properties {
  DINT MotionType{};
};

/// Units of measure.
struct TO_Struct_Units {
  UDINT LengthUnit = 1013;
  UDINT VelocityUnit = 1521;
  UDINT TimeUnit = 1054;
  UDINT TorqueUnit = 1126;
  UDINT ForceUnit = 1120;
  UDINT UnitFactor = 1;
};

/// Mechanics.
struct TO_Struct_Mechanics {
  LREAL LeadScrew = 10.0;
};

/// Modulo function.
struct TO_Struct_Modulo {
  BOOL Enable{};
  LREAL Length = 360.0;
  LREAL StartValue{};
};

/// Dynamic limits.
struct TO_Struct_DynamicLimits {
  LREAL MaxVelocity = 10000.0;
  LREAL Velocity = 10000.0;
  LREAL MaxAcceleration = 100000.0;
  LREAL MaxDeceleration = 100000.0;
  LREAL MaxJerk = 4629629.629;
};

/// Dynamic defaults.
struct TO_Struct_DynamicDefaults {
  LREAL Velocity = 100.0;
  LREAL Acceleration = 1000.0;
  LREAL Deceleration = 1000.0;
  LREAL Jerk = 10000.0;
  LREAL EmergencyDeceleration = 100000.0;
};

/// Software limit switches.
struct TO_Struct_PositionLimitsSW {
  BOOL Active{};
  LREAL MinPosition = -1.0E12;
  LREAL MaxPosition = 1.0E12;
  DINT LimitReachedBehavior{};
  DINT LimitExceededBehavior{};
};

/// Hardware limit switches.
struct TO_Struct_PositionLimitsHW {
  BOOL Active{};
  BOOL MinSwitchLevel{};
  const bool* MinSwitchAddress{};
  BOOL MaxSwitchLevel{};
  const bool* MaxSwitchAddress{};
  DINT Mode{};
  DINT ApproachBehavior{};
};

/// Homing.
struct TO_Struct_Homing {
  BOOL AutoReversal{};
  BOOL ApproachDirection{};
  LREAL ApproachVelocity = 200.0;
  LREAL ReferencingVelocity = 50.0;
  LREAL HomePosition{};
};

/// Override.
struct TO_Struct_Override {
  LREAL Velocity = 100.0;
};

/// Quantization of the control difference (drive with stepper-motor interface).
struct TO_Struct_PositionDifferenceQuantification {
  DINT Mode{};
  LREAL Value = 0.001;
};

/// Position control.
struct TO_Struct_PositionControl {
  LREAL Kv = 10.0;
  LREAL Kpc = 100.0;
  BOOL EnableDSC{};
  LREAL SmoothingTimeByChangeDifference{};
  UDINT InitialOperativeSensor = 1;
  TO_Struct_PositionDifferenceQuantification ControlDifferenceQuantization{};
  DINT VelocityModePowerOn{};
};

/// Dynamic filter.
struct TO_Struct_DynamicFilter {
  DINT Mode{};
  LREAL T1{};
  LREAL T2{};
  LREAL Tt{};
};

/// Setpoint filter.
struct TO_Struct_SetpointFilter {
  TO_Struct_DynamicFilter DynamicFilter{};
};

/// Time constants for generating the braking ramp with the alarm reaction "brake with emergency-stop ramp".
struct TO_Struct_DynamicAxisModel {
  LREAL VelocityTimeConstant{};
  LREAL AdditionalPositionTimeConstant{};
};

/// Following-error monitoring.
struct TO_Struct_FollowingError {
  BOOL EnableMonitoring = true;
  LREAL MinValue = 10.0;
  LREAL MaxValue = 100.0;
  LREAL MinVelocity = 10.0;
  LREAL WarningLevel = 90.0;
  LREAL AdditionalSetpointDelayTime{};
};

/// Positioning monitoring.
struct TO_Struct_PositionMonitoring {
  LREAL ToleranceTime = 1.0;
  LREAL MinDwellTime = 0.1;
  LREAL Window = 1.0;
};

/// Configuration of the standstill signal.
struct TO_Struct_StandstillSignal {
  LREAL VelocityThreshold = 5.0;
  LREAL MinDwellTime = 0.01;
};

}  // namespace lockstep
