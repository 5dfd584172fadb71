/// The technology data block of TO_MeasuringInput: every published variable, in published order and spelling,
/// with its start value. `data_block_measuring_input.cpp` declares path, effect class, unit, range and
/// meaning.
/// @source S7-1500/S7-1500T measuring input and output cam functions, tags of the measuring input
#pragma once

#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// How it measures. Times are in ms.
struct TO_Struct_MeasuringInput_Parameter {
  DINT MeasuringInputType{};
  UDINT PROFIdriveProbeNumber = 1;
  LREAL MeasuringRangeActivationTime{};
  LREAL MeasuringRangeAdditionalActivationTime{};
  LREAL CorrectionTime{};
};

/// Address of the input.
struct TO_Struct_MeasuringInput_Interface {
  const bool* Address{};
};

/// Units of measure of objects whose times are in ms.
struct TO_Struct_InputOutput_Units {
  UDINT LengthUnit = 1013;
  UDINT TimeUnit = 1056;
};

/// What has been measured.
struct TO_Struct_MeasuredValues {
  LREAL MeasuredValue1{};
  LREAL MeasuredValue2{};
  UDINT MeasuredValue1Counter{};
  UDINT MeasuredValue2Counter{};
  UDINT LostEdgeCounter1{};
  UDINT LostEdgeCounter2{};
};

/// The whole technology data block of a measuring input.
struct MeasuringInputData {
  DINT Status{};
  BOOL InputState{};
  TO_Struct_MeasuringInput_Parameter Parameter{};
  TO_Struct_MeasuringInput_Interface Interface{};
  TO_Struct_InputOutput_Units Units{};
  TO_Struct_MeasuredValues MeasuredValues{};
  DWORD StatusWord{};
  DWORD ErrorWord{};
  DWORD WarningWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
};

}  // namespace lockstep
