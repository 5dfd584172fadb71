/// Of the technology data block of an axis: its drive, its encoders and the gear behind them, as they
/// are configured.
/// @source S7-1500T synchronous operation V7, 13.1
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Simulation configuration.
struct TO_Struct_AxisSimulation {
  UDINT Mode{};
};

/// Virtual-axis configuration.
struct TO_Struct_VirtualAxis {
  UDINT Mode{};
};

/// Addresses and analog-drive signals.
struct TO_Struct_ActorInterface {
  const bool* AddressIn{};
  const bool* AddressOut{};
  BOOL EnableDriveOutput{};
  const bool* EnableDriveOutputAddress{};
  BOOL DriveReadyInput{};
  const bool* DriveReadyInputAddress{};
  BOOL EnableTorqueData{};
  const bool* TorqueDataAddressIn{};
  const bool* TorqueDataAddressOut{};
};

/// Drive parameters; valid when <TO>.Actor.MotorType = 0.
struct TO_Struct_ActorDriveParameter {
  LREAL ReferenceSpeed = 60000.0;
  LREAL MaxSpeed = 60000.0;
  LREAL ReferenceTorque = 1.0;
};

/// Drive parameters of a linear motor; valid when <TO>.Actor.MotorType = 1.
struct TO_Struct_LinearMotorActorDriveParameter {
  LREAL ReferenceVelocity = 10000.0;
  LREAL MaxVelocity = 10000.0;
  LREAL ReferenceForce = 1.0;
};

/// Drive configuration.
struct TO_Struct_Actor {
  DINT Type = 1;
  BOOL InverseDirection{};
  DINT DataAdaption{};
  LREAL Efficiency = 1.0;
  DINT MotorType{};
  TO_Struct_ActorInterface Interface{};
  TO_Struct_ActorDriveParameter DriveParameter{};
  TO_Struct_LinearMotorActorDriveParameter LinearMotorDriveParameter{};
};

/// Default limits.
struct TO_Struct_TorqueLimitingLimitDefaults {
  LREAL Torque = 0.0;
  LREAL Force{};
};

/// Torque-limiting configuration.
struct TO_Struct_TorqueLimiting {
  DINT LimitBase{};
  DINT PositionBasedMonitors{};
  TO_Struct_TorqueLimitingLimitDefaults LimitDefaults{};
};

/// Fixed-stop configuration.
struct TO_Struct_Clamping {
  LREAL FollowingErrorDeviation = 0.001;
  LREAL PositionTolerance = 0.001;
};

/// Telegram interface of the encoder.
struct TO_Struct_SensorInterface {
  const bool* AddressIn{};
  const bool* AddressOut{};
  UDINT Number = 1;
};

/// Encoder parameters.
struct TO_Struct_SensorParameter {
  LREAL Resolution = 0.001;
  UDINT StepsPerRevolution = 2048;
  UDINT FineResolutionXist1 = 11;
  UDINT FineResolutionXist2 = 9;
  UDINT DeterminableRevolutions = 1;
  LREAL DistancePerRevolution = 100.0;
  DINT BehaviorGx_XIST1{};
  LREAL ReferenceSpeed = 60000.0;
  LREAL ReferenceVelocity = 10000.0;
};

/// Backlash compensation.
struct TO_Struct_Backlash {
  BOOL Enable{};
  LREAL Size{};
  LREAL Velocity{};
  DINT DirectionAbsoluteHoming{};
};

/// Active homing.
struct TO_Struct_SensorActiveHoming {
  DINT Mode{};
  BOOL SideInput{};
  DINT Direction{};
  const bool* DigitalInputAddress{};
  LREAL HomePositionOffset{};
  BOOL SwitchLevel{};
};

/// Passive homing.
struct TO_Struct_SensorPassiveHoming {
  DINT Mode{};
  BOOL SideInput{};
  DINT Direction = 2;
  const bool* DigitalInputAddress{};
  BOOL SwitchLevel{};
};

/// Encoder configuration, one element per encoder.
struct TO_Struct_Sensor {
  BOOL Existent{};
  DINT Type = 0;
  BOOL InverseDirection{};
  DINT System = 1;
  DINT MountingMode{};
  DINT DataAdaption{};
  DINT ActualVelocityMode{};
  TO_Struct_SensorInterface Interface{};
  TO_Struct_SensorParameter Parameter{};
  TO_Struct_Backlash Backlash{};
  TO_Struct_SensorActiveHoming ActiveHoming{};
  TO_Struct_SensorPassiveHoming PassiveHoming{};
};

/// Load gear.
struct TO_Struct_LoadGear {
  UDINT Numerator = 1;
  UDINT Denominator = 1;
};

}  // namespace lockstep
