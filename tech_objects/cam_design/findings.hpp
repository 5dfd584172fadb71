/// What is to be told of the points and segments of a cam.
#pragma once

#include "tech_objects/cam_design/designed_cam.hpp"
#include "tech_objects/cam_object/interpolation.hpp"

namespace lockstep {

/// The findings of an interpolation, just after it: with a fault, that is told; else points and segments that
/// do not count, or not everywhere, because of others, and following values that MC_CamIn refuses unscaled.
/// Not for the cycle.
/// @param elements,function those of the interpolation
/// @source S7-1500T synchronous operation V7, 8.1.3.11
CamFindings findings_of(const CamElements& elements, const CamInterpolator& interpolator,
                        const CamFunction& function);

}  // namespace lockstep
