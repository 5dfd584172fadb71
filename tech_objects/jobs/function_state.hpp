/// Values of StatusSynchronizedMotion.FunctionState and WaitingFunctionState.
/// @source S7-1500T synchronous operation V7, 13.1.34
#pragma once

#include "tech_objects/jobs/job.hpp"

namespace lockstep {

/// 0: not a job of synchronous operation.
constexpr DINT function_state(JobKind kind) noexcept {
  switch (kind) {
    case JobKind::MC_GearIn:
      return 1;
    case JobKind::MC_GearInPos:
      return 2;
    case JobKind::MC_CamIn:
      return 3;
    case JobKind::MC_GearOut:
      return 4;
    case JobKind::MC_CamOut:
      return 5;
    case JobKind::MC_GearInVelocity:
      return 6;
    default:
      return 0;
  }
}

/// Of the jobs that wait to couple and to leave a coupling, nullptr: none. Where both wait, the latter has
/// come later.
constexpr DINT waiting_function_state(const Job* coupling, const Job* leaving) noexcept {
  if (leaving != nullptr) return function_state(leaving->kind);
  return coupling != nullptr ? function_state(coupling->kind) : 0;
}

}  // namespace lockstep
