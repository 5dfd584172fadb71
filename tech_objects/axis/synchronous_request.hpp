/// From the jobs of S7-1500T to the requests of the kernel, and from its reasons back to error identifiers.
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/objects/leading_object.hpp"
#include "tech_objects/synchronous/request.hpp"
#include "tech_objects/synchronous/shift.hpp"

namespace lockstep {

/// MC_GearIn, MC_GearInVelocity, MC_GearInPos, MC_CamIn. @param leading that of `master_of(job)`
CouplingRequest coupling_request(const Job& job, const LeadingValue& leading,
                                 const Dynamics& dynamics) noexcept;

/// MC_GearOut, MC_CamOut.
LeavingRequest leaving_request(const LeavingJob& job) noexcept;

/// MC_Phasing…, MC_Offset…. @param target total shift at the end  @param dynamics of the shift
ShiftRequest shift_request(const ShiftJob& job, DoubleDouble target, const Dynamics& dynamics) noexcept;

/// What a block shows.
ErrorId error_of(SyncRefusal refusal) noexcept;

}  // namespace lockstep
