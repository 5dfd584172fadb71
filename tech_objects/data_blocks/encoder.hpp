/// The technology data block of TO_ExternalEncoder: every published variable, in published order and
/// spelling, with its start value. `data_block_encoder.cpp` declares path, effect class, unit, range and
/// meaning.
/// @source S7-1500/S7-1500T axis functions, tags of the technology object external encoder
#pragma once

#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// The one encoder, with what it is and how it is homed.
struct TO_Struct_ExternalEncoder_Sensor {
  DINT Type{};
  BOOL InverseDirection{};
  DINT System = 1;
  DINT MountingMode = 2;
  DINT DataAdaption{};
  DINT ActualVelocityMode{};
  TO_Struct_SensorInterface Interface{};
  TO_Struct_SensorParameter Parameter{};
  TO_Struct_SensorPassiveHoming PassiveHoming{};
};

/// Units of measure.
struct TO_Struct_ExternalEncoder_Units {
  UDINT LengthUnit = 1013;
  UDINT TimeUnit = 1054;
  UDINT VelocityUnit = 1521;
};

/// Homing.
struct TO_Struct_ExternalEncoder_Homing {
  LREAL HomePosition{};
};

/// The whole technology data block of an external encoder.
struct ExternalEncoderData {
  LREAL ActualPosition{};
  LREAL ActualVelocity{};
  LREAL ActualAcceleration{};
  DINT ActualModuloCycle{};
  TO_Struct_ExternalEncoder_Sensor Sensor{};
  TO_Struct_CrossPlcSynchronousOperation CrossPlcSynchronousOperation{};
  TO_Struct_Extrapolation Extrapolation{};
  TO_Struct_LoadGear LoadGear{};
  TO_Struct_Properties Properties{};
  TO_Struct_Mechanics Mechanics{};
  TO_Struct_Modulo Modulo{};
  TO_Struct_StatusProvidedLeadingValue StatusProvidedLeadingValue{};
  TO_Struct_StatusExtrapolation StatusExtrapolation{};
  TO_Struct_ExternalEncoder_Homing Homing{};
  TO_Struct_ExternalEncoder_Units Units{};
  TO_Struct_StandstillSignal StandstillSignal{};
  TO_Struct_StatusSensor StatusSensor{};
  DWORD StatusWord{};
  DWORD ErrorWord{};
  DWORD WarningWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
};

}  // namespace lockstep
