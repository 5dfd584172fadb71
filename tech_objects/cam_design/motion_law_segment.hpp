/// Stretches of curves as segments of a cam.
#pragma once

#include "tech_objects/cam_design/motion_law.hpp"

namespace lockstep {

/// A stretch as a segment of the data block, whose coefficients count from its beginning, so that they
/// are exact wherever it lies. Of the sines the first counts; a coefficient of degree 7 has no place. Any
/// thread.
TO_Cam_Struct_SegmentData segment_of(const MotionPiece& piece) noexcept;

/// The polynomial with given values at both ends, up to an order of derivative each, as a segment. Orders 0 …
/// 3 with seven conditions at most. Any thread.
TO_Cam_Struct_SegmentData segment_between(const MotionValue& left, int left_order, const MotionValue& right,
                                          int right_order, double start, double length) noexcept;

}  // namespace lockstep
