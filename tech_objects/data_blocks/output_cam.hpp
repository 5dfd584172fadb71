/// The technology data blocks of TO_OutputCam and TO_CamTrack: every published variable, in published order
/// and spelling, with its start value. `data_block_output_cam.cpp` declares path, effect class, unit, range
/// and meaning.
/// @source S7-1500/S7-1500T measuring input and output cam functions, tags of output cam and cam track
#pragma once

#include "tech_objects/data_blocks/measuring_input.hpp"

namespace lockstep {

/// How an output cam switches. Times are in ms.
struct TO_Struct_OutputCam_Parameter {
  DINT OutputCamType{};
  DINT PositionType{};
  LREAL OnCompensation{};
  LREAL OffCompensation{};
  LREAL Hysteresis{};
};

/// Output of an output cam.
struct TO_Struct_OutputCam_Interface {
  BOOL EnableOutput = true;
  const bool* Address{};
  DINT LogicOperation{};
};

/// The whole technology data block of an output cam.
struct OutputCamData {
  BOOL CamOutput{};
  TO_Struct_OutputCam_Parameter Parameter{};
  TO_Struct_OutputCam_Interface Interface{};
  TO_Struct_InputOutput_Units Units{};
  DWORD StatusWord{};
  DWORD ErrorWord{};
  DWORD WarningWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
};

/// One cam of a track. Duration is in ms.
struct TO_Struct_CamTrack_Cam {
  LREAL OnPosition{};
  LREAL OffPosition{};
  LREAL Duration = 1.0;
  BOOL Existent{};
  bool operator==(const TO_Struct_CamTrack_Cam&) const = default;
};

/// How a cam track switches. Times are in ms.
struct TO_Struct_CamTrack_Parameter {
  DINT CamTrackType{};
  DINT PositionType{};
  LREAL ReferencePosition{};
  LREAL CamTrackLength = 100.0;
  DWORD CamMasking = DWORD{0xFFFFFFFFu};
  LREAL OnCompensation{};
  LREAL OffCompensation{};
  LREAL Hysteresis{};
  TO_Struct_CamTrack_Cam Cam[32]{};
  bool operator==(const TO_Struct_CamTrack_Parameter&) const = default;
};

/// Output of a cam track.
struct TO_Struct_CamTrack_Interface {
  BOOL EnableOutput = true;
  const bool* Address{};
};

/// The whole technology data block of a cam track.
struct CamTrackData {
  DINT Status{};
  BOOL TrackOutput{};
  DWORD SingleCamState{};
  LREAL TrackPosition{};
  LREAL MatchPosition{};
  TO_Struct_CamTrack_Parameter Parameter{};
  TO_Struct_CamTrack_Interface Interface{};
  TO_Struct_InputOutput_Units Units{};
  DWORD StatusWord{};
  DWORD ErrorWord{};
  DWORD WarningWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
};

}  // namespace lockstep
