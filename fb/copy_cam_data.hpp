/// Cams whose data a program computes: MC_CopyCamData.
#pragma once

#include "fb/interpolate_cam.hpp"

namespace lockstep {

/// Copies points and segments from arrays into the data block of a cam, 1,000 points per interpolator cycle.
/// What is copied is valid with Done, and in effect after the next interpolation. The arrays have to stay as
/// they are until Done.
/// @source S7-1500T synchronous operation V7, 12.2.4; 8.2.2
/// @errors 16#800A Mode; 16#80E1 to 16#80E6 starts and numbers; 16#80E7 copying active; 16#80E8 being
///         interpolated; 16#80E9, 16#80EA array not wired where something is to be copied; 16#800D restarting
struct MC_CopyCamData final : CamBlock {
  DINT Mode{};
  DINT StartPointCam = 1;
  DINT StartSegmentCam = 1;
  DINT StartPointArray = 1;
  DINT StartSegmentArray = 1;
  DINT NumberOfPoints{};
  DINT NumberOfSegments{};
  const Array* ArrayOfPoints{};
  const Array* ArrayOfSegments{};

  static constexpr std::string_view kName = "MC_CopyCamData";
  static constexpr std::string_view kText = "Copies points and segments from arrays into a cam.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.2.4";
  static constexpr Choice kModes[] = {{0, "elements of the cam are made invalid before"},
                                      {1, "elements of the cam that are valid stay valid"}};
  static constexpr Range kPoints{1.0, static_cast<double>(kCam10kPoints)};
  static constexpr Range kSegments{1.0, static_cast<double>(kCamSegments)};
  static constexpr auto kPins = pins(
      kCam, pin::kExecute,
      in<&MC_CopyCamData::Mode>("Mode", Unit::kNone, kAny, "what becomes of the elements of the cam",
                                {.error = ErrorId::mode, .choices = kModes}),
      in<&MC_CopyCamData::StartPointCam>("StartPointCam", Unit::kNone, kPoints,
                                         "index in the cam of the first point to write; of TO_Cam to 1000",
                                         {.error = ErrorId::start_point_cam}),
      in<&MC_CopyCamData::StartSegmentCam>("StartSegmentCam", Unit::kNone, kSegments,
                                           "index in the cam of the first segment to write",
                                           {.error = ErrorId::start_segment_cam}),
      in<&MC_CopyCamData::StartPointArray>("StartPointArray", Unit::kNone, kAny,
                                           "index in ArrayOfPoints of the first point to copy",
                                           {.error = ErrorId::start_point_array}),
      in<&MC_CopyCamData::StartSegmentArray>("StartSegmentArray", Unit::kNone, kAny,
                                             "index in ArrayOfSegments of the first segment to copy",
                                             {.error = ErrorId::start_segment_array}),
      in<&MC_CopyCamData::NumberOfPoints>(
          "NumberOfPoints", Unit::kNone, {0.0, kPoints.highest},
          "points to copy, as many as both have from their first one on at the most",
          {.error = ErrorId::number_of_points}),
      in<&MC_CopyCamData::NumberOfSegments>(
          "NumberOfSegments", Unit::kNone, {0.0, kSegments.highest},
          "segments to copy, as many as both have from their first one on at the most",
          {.error = ErrorId::number_of_segments}),
      array<&MC_CopyCamData::ArrayOfPoints>("ArrayOfPoints", kCamPointElement,
                                            "array of points; may be missing where NumberOfPoints is 0"),
      array<&MC_CopyCamData::ArrayOfSegments>(
          "ArrayOfSegments", kCamSegmentElement,
          "array of segments; may be missing where NumberOfSegments is 0"),
      pin::kDone, pin::kBusy, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  void hand_over(Job& job) noexcept override;
};

}  // namespace lockstep
