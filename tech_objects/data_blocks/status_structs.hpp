/// Of the technology data block of an axis: what it shows.
/// @source S7-1500T synchronous operation V7, 13.1
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

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

/// Effective leading value of the synchronous operation function (including an additive leading value).
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

}  // namespace lockstep
