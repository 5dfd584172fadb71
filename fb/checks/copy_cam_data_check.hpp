/// What can be said of MC_CopyCamData before anything runs.
#pragma once

#include "fb/checks/written_call.hpp"
#include "fb/copy_cam_data.hpp"

namespace lockstep {

/// Warns of points and segments that are to be copied and that the array does not have.
void check_copied_elements(const WrittenCall& call, CallWarnings& warnings);

}  // namespace lockstep
