/// The technology data block of TO_PositioningAxis and TO_SynchronousAxis: every published variable, in
/// published order and spelling, with its start value. `data_block.cpp` declares path, effect class, unit,
/// range and meaning. Arrays count from 0 here and from 1 in paths.
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

/// Leading-value output interfaces.
struct TO_Struct_CrossPlcLeadingValueInterface {
  BOOL EnableLeadingValueOutput{};
  const bool* AddressOut{};
};

/// Cross-PLC synchronous operation.
struct TO_Struct_CrossPlcSynchronousOperation {
  TO_Struct_CrossPlcLeadingValueInterface Interface[8]{};
  LREAL LocalLeadingValueDelayTime{};
};

/// Extrapolation settings.
struct TO_Struct_ExtrapolationSettings {
  DINT SystemDefinedExtrapolation = 1;
  DINT ExtrapolatedVelocityMode{};
};

/// Position filter (PT2).
struct TO_Struct_ExtrapolationPositionFilter {
  LREAL T1{};
  LREAL T2{};
};

/// Velocity filter (PT2).
struct TO_Struct_ExtrapolationVelocityFilter {
  LREAL T1{};
  LREAL T2{};
};

/// Velocity tolerance band.
struct TO_Struct_ExtrapolationVelocityTolerance {
  LREAL Range{};
};

/// Hysteresis.
struct TO_Struct_ExtrapolationHysteresis {
  LREAL Value{};
};

/// Actual-value extrapolation.
struct TO_Struct_Extrapolation {
  LREAL LeadingAxisDependentTime{};
  LREAL FollowingAxisDependentTime{};
  TO_Struct_ExtrapolationSettings Settings{};
  TO_Struct_ExtrapolationPositionFilter PositionFilter{};
  TO_Struct_ExtrapolationVelocityFilter VelocityFilter{};
  TO_Struct_ExtrapolationVelocityTolerance VelocityTolerance{};
  TO_Struct_ExtrapolationHysteresis Hysteresis{};
};

/// Load gear.
struct TO_Struct_LoadGear {
  UDINT Numerator = 1;
  UDINT Denominator = 1;
};

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

/// Positioning status.
struct TO_Struct_StatusPositioning {
  LREAL Distance{};
  LREAL TargetPosition{};
  DINT TargetPositionModuloCycle{};
  LREAL FollowingError{};
  LREAL SetpointExecutionTime{};
  LREAL SuperimposedDistance{};
};

/// Drive status.
struct TO_Struct_StatusDrive {
  BOOL Disabled{};
  BOOL InOperation{};
  BOOL CommunicationOK{};
  BOOL Error{};
  DINT AdaptionState{};
};

/// Servo status.
struct TO_Struct_StatusServo {
  LREAL BalancedPosition{};
  LREAL ControlDifference{};
  LREAL PositionAfterDynamicFilter{};
};

/// Leading value with leading-value delay.
struct TO_Struct_ProvidedLeadingValue {
  LREAL Position{};
  LREAL Velocity{};
  LREAL Acceleration{};
};

/// Provided leading value.
struct TO_Struct_StatusProvidedLeadingValue {
  TO_Struct_ProvidedLeadingValue DelayedLeadingValue{};
};

/// Encoder status, one element per encoder.
struct TO_Struct_StatusSensor {
  DINT State{};
  BOOL CommunicationOK{};
  BOOL Error{};
  LREAL AbsEncoderOffset{};
  BOOL Control{};
  LREAL Position{};
  LREAL Velocity{};
  DINT AdaptionState{};
  DINT ModuloCycle{};
  DINT Adjusted{};
};

/// Extrapolation status.
struct TO_Struct_StatusExtrapolation {
  LREAL FilteredPosition{};
  LREAL FilteredVelocity{};
  LREAL ExtrapolatedPosition{};
  LREAL ExtrapolatedVelocity{};
};

/// Effective leading value of the synchronous operation function (including an additive leading value, lines
/// 4390-4392).
struct TO_Struct_EffectiveLeadingValue {
  LREAL Position{};
  LREAL Velocity{};
  LREAL Acceleration{};
};

/// Leading value of the synchronous operation function after a leading-value offset (MC_PhasingAbsolute /
/// MC_PhasingRelative).
struct TO_Struct_FunctionLeadingValue {
  LREAL Position{};
};

/// Following value of the synchronous operation function before a following-value offset (MC_OffsetAbsolute /
/// MC_OffsetRelative).
struct TO_Struct_FunctionFollowingValue {
  LREAL Position{};
  LREAL Velocity{};
  LREAL Acceleration{};
};

/// Synchronous operation status.
struct TO_Struct_StatusSynchronizedMotion {
  DINT FunctionState{};
  DINT WaitingFunctionState{};
  LREAL PhaseShift{};
  DB_ANY ActualMaster{};
  DB_ANY ActualCam{};
  LREAL MasterOffset{};
  LREAL MasterScaling = 1.0;
  LREAL SlaveOffset{};
  LREAL SlaveScaling = 1.0;
  LREAL Offset{};
  TO_Struct_EffectiveLeadingValue EffectiveLeadingValue{};
  TO_Struct_FunctionLeadingValue FunctionLeadingValue{};
  TO_Struct_FunctionFollowingValue FunctionFollowingValue{};
  DWORD StatusWord{};
};

/// Torque data status.
struct TO_Struct_StatusTorqueData {
  DINT CommandAdditiveTorqueActive{};
  DINT CommandTorqueRangeActive{};
  LREAL ActualTorque{};
};

/// MotionIn status.
struct TO_Struct_StatusMotionIn {
  DINT FunctionState{};
  DWORD StatusWord{};
};

/// Detail of the pending technology alarm.
struct TO_Struct_ErrorDetail {
  UDINT Number{};
  DINT Reaction{};
};

/// Reaction to a reversing leading value.
struct Lockstep_Struct_Synchronization {
  LREAL MasterReversionTolerance{};
};

/// What only a TO_SpeedAxis has.
struct Lockstep_Struct_SpeedAxis {
  UDINT MassUnit = 1088;
  UDINT IneritaUnit = 1118;
  WORD RemoveEnableReaction = WORD{7};
  DB_ANY Interpreter{};
  DWORD InterpreterStatusWord{};
};

/// The whole technology data block of an axis.
struct AxisData {
  LREAL Position{};
  LREAL Velocity{};
  LREAL ActualPosition{};
  LREAL ActualVelocity{};
  LREAL ActualSpeed{};
  LREAL Acceleration{};
  LREAL ActualAcceleration{};
  UDINT OperativeSensor = 1;
  DINT ModuloCycle{};
  DINT ActualModuloCycle{};
  LREAL VelocitySetpoint{};
  TO_Struct_AxisSimulation Simulation{};
  TO_Struct_VirtualAxis VirtualAxis{};
  TO_Struct_Actor Actor{};
  TO_Struct_TorqueLimiting TorqueLimiting{};
  TO_Struct_Clamping Clamping{};
  TO_Struct_Sensor Sensor[4] = {{.Existent = true}, {}, {}, {}};
  TO_Struct_CrossPlcSynchronousOperation CrossPlcSynchronousOperation{};
  TO_Struct_Extrapolation Extrapolation{};
  TO_Struct_LoadGear LoadGear{};
  TO_Struct_Properties Properties{};
  TO_Struct_Units Units{};
  TO_Struct_Mechanics Mechanics{};
  TO_Struct_Modulo Modulo{};
  TO_Struct_DynamicLimits DynamicLimits{};
  TO_Struct_DynamicDefaults DynamicDefaults{};
  TO_Struct_PositionLimitsSW PositionLimits_SW{};
  TO_Struct_PositionLimitsHW PositionLimits_HW{};
  TO_Struct_Homing Homing{};
  TO_Struct_Override Override{};
  TO_Struct_PositionControl PositionControl{};
  TO_Struct_SetpointFilter SetpointFilter{};
  TO_Struct_DynamicAxisModel DynamicAxisModel{};
  TO_Struct_FollowingError FollowingError{};
  TO_Struct_PositionMonitoring PositioningMonitoring{};
  TO_Struct_StandstillSignal StandstillSignal{};
  TO_Struct_StatusPositioning StatusPositioning{};
  TO_Struct_StatusDrive StatusDrive{};
  TO_Struct_StatusServo StatusServo{};
  TO_Struct_StatusProvidedLeadingValue StatusProvidedLeadingValue{};
  TO_Struct_StatusSensor StatusSensor[4]{};
  TO_Struct_StatusExtrapolation StatusExtrapolation{};
  TO_Struct_StatusSynchronizedMotion StatusSynchronizedMotion{};
  DWORD StatusKinematicsMotion{};
  TO_Struct_StatusTorqueData StatusTorqueData{};
  TO_Struct_StatusMotionIn StatusMotionIn{};
  DWORD StatusWord{};
  DWORD StatusWord2{};
  DWORD ErrorWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
  DWORD WarningWord{};
  Lockstep_Struct_Synchronization Synchronization{};
  Lockstep_Struct_SpeedAxis SpeedAxis{};
};

}  // namespace lockstep
