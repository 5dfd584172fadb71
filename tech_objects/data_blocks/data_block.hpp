/// The technology data block of TO_PositioningAxis and TO_SynchronousAxis: every published variable, in
/// published order and spelling, with its start value. Its structures stand in the headers of each subject;
/// path, effect class, unit, range and meaning of a variable are declared in `configuration.cpp`,
/// `positioning_axis.cpp`, `speed_axis.cpp` and `status.cpp`. Arrays count from 0 here and from 1 in paths.
/// @source S7-1500T synchronous operation V7, 13.1
#pragma once

#include "tech_objects/data_blocks/drive_structs.hpp"
#include "tech_objects/data_blocks/leading_structs.hpp"
#include "tech_objects/data_blocks/motion_structs.hpp"
#include "tech_objects/data_blocks/status_structs.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

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
