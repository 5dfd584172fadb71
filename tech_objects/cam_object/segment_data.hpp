/// A segment as it is published, as the curve of a cam takes it.
#pragma once

#include "tech_objects/cam/segment.hpp"
#include "tech_objects/data_blocks/cam_data.hpp"

namespace lockstep {

static_assert(kCamSegments == kCurveSegments);

/// Shifts a published segment to an origin. Finite values. Any thread.
inline CamSegment shifted(const TO_Cam_Struct_SegmentData& data, double origin) noexcept {
  const CamSegment segment{.origin = data.Origin,
                           .coefficient = {data.a0, data.a1, data.a2, data.a3, data.a4, data.a5, data.a6},
                           .amplitude = data.sineAmplitude,
                           .frequency = data.sinePeriod,
                           .phase = data.sinePhase};
  return shifted(segment, origin);
}

}  // namespace lockstep
