/// What can be said of MC_CamIn before anything runs.
#pragma once

#include <span>

#include "fb/cam_in.hpp"
#include "fb/checks/written_call.hpp"

namespace lockstep {

/// Warns of a cam that is to be passed again and again and does not close, or steps where it does.
void check_cyclic_cam(const WrittenCall& call, CallWarnings& warnings);

/// Warns where a cam takes over from another at its end (SyncProfileReference 5) with another velocity.
void check_cam_exchanges(std::span<const WrittenCall> calls, CallWarnings& warnings);

}  // namespace lockstep
