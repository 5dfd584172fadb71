/// Cam design: from the elements of a curve and the transitions between them to the points and segments of a
/// cam. For the desk, not for the cycle: everything here allocates.
/// @source S7-1500T synchronous operation V7, 8.1.3, 8.3; VDI 2143 part 1
#pragma once

#include <cstddef>
#include <vector>

#include "tech_objects/cam_design/designed_cam.hpp"
#include "tech_objects/data_blocks/cam_data.hpp"

namespace lockstep {

/// Makes the cam of a design. All problems are told, not the first; with one there is no function.
/// @param capacity points that the cam may have: kCamPoints or kCam10kPoints
DesignedCam design_cam(const CamDesign& design, std::size_t capacity);

/// Points and segments as given, with problems of single values and of their numbers; without a function.
/// Problems name their index as element, segments by the member `transition`.
DesignedCam checked_cam(std::vector<TO_Cam_Struct_PointData> points,
                        std::vector<TO_Cam_Struct_SegmentData> segments,
                        const TO_Cam_Struct_InterpolationSettings& interpolation, std::size_t capacity);

/// Points and segments as `checked_cam` has them, and, if nothing is wrong so far, interpolated, with what
/// findings_of finds.
DesignedCam interpolated_cam(std::vector<TO_Cam_Struct_PointData> points,
                             std::vector<TO_Cam_Struct_SegmentData> segments,
                             const TO_Cam_Struct_InterpolationSettings& interpolation, std::size_t capacity);

}  // namespace lockstep
