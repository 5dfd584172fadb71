/// The technology data block of a cam: every published variable, in published order and spelling.
/// Arrays count from 0 here and from 1 in paths. Plain data: allocated once when the project is loaded,
/// written in place by the program; a cam follows its definition only after the next interpolation.
/// @source S7-1500T synchronous operation V7, 13.2
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A point of the curve, -1.0E12 … 1.0E12 each.
struct TO_Cam_Struct_PointData {
  LREAL x{};  ///< leading value
  LREAL y{};  ///< following value
};

/// A segment of the curve, -1.0E12 … 1.0E12 each:
/// a0 + a1·d + … + a6·d^6 + sineAmplitude · sin(sinePeriod · d + sinePhase) for xmin ≤ x ≤ xmax, d being the
/// leading value x less Origin and sinePeriod an angular frequency [rad per leading unit]. As published
/// Origin is 0; it is our own, since the numbers of a short segment far from 0 cancel in their sum, or do not
/// fit.
struct TO_Cam_Struct_SegmentData {
  LREAL xmin{};
  LREAL xmax{};
  LREAL a0{};
  LREAL a1{};
  LREAL a2{};
  LREAL a3{};
  LREAL a4{};
  LREAL a5{};
  LREAL a6{};
  LREAL sineAmplitude{};
  LREAL sinePeriod{};
  LREAL sinePhase{};
  LREAL Origin{};  ///< leading value from which coefficients and phase count
};

/// How the gaps between the elements are closed.
struct TO_Cam_Struct_InterpolationSettings {
  DINT InterpolationMode{};   ///< 0 linear, 1 C-splines (cubic), 2 B-splines (Bézier)
  DINT BoundaryConditions{};  ///< 0 none, 1 first derivative equal at start and end
};

/// What the last interpolation found.
struct TO_Cam_Struct_StatusCam {
  LREAL StartLeadingValue{};
  LREAL EndLeadingValue{};
  DINT NumberOfValidPoints{};
  DINT NumberOfValidSegments{};
};

/// Bits of StatusWord of a cam.
enum class CamStatusBit : UDINT {
  Control = 0,  ///< the cam is in use
  Error = 1,
  RestartActive = 2,
  OnlineStartValuesChanged = 3,
  CamDataChanged = 4,  ///< the definition differs from the interpolated curve
  Interpolated = 5,
  InInterpolation = 6,
  CopyCamDataActive = 7
};

inline constexpr std::size_t kCamPoints = 1000;      ///< points of TO_Cam
inline constexpr std::size_t kCam10kPoints = 10000;  ///< points of TO_Cam_10k
inline constexpr std::size_t kCamSegments = 50;      ///< segments of either

/// The data block of a cam with so many points.
template <std::size_t point_count>
struct CamData {
  std::array<TO_Cam_Struct_PointData, point_count> Point{};
  std::array<BOOL, point_count> ValidPoint{};
  std::array<TO_Cam_Struct_SegmentData, kCamSegments> Segment{};
  std::array<BOOL, kCamSegments> ValidSegment{};
  TO_Cam_Struct_InterpolationSettings InterpolationSettings{};
  TO_Cam_Struct_StatusCam StatusCam{};
  DWORD StatusWord{};
  DWORD ErrorWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
  DWORD WarningWord{};
};

using CamData1k = CamData<kCamPoints>;
using CamData10k = CamData<kCam10kPoints>;

/// The definition of a cam of either type, as the interpolation reads it: the data block's own arrays, or a
/// copy of them where the program goes on writing meanwhile. A point or segment counts if it is valid.
struct CamElements {
  std::span<const TO_Cam_Struct_PointData> Point;
  std::span<const BOOL> ValidPoint;  ///< as many as Point
  std::span<const TO_Cam_Struct_SegmentData> Segment;
  std::span<const BOOL> ValidSegment;  ///< as many as Segment
  TO_Cam_Struct_InterpolationSettings InterpolationSettings;
};

template <std::size_t point_count>
CamElements elements_of(const CamData<point_count>& data) noexcept {
  return {data.Point, data.ValidPoint, data.Segment, data.ValidSegment, data.InterpolationSettings};
}

}  // namespace lockstep
