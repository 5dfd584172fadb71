#include "tech_objects/axis/synchronous_request.hpp"

#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

SyncStartRule start_rule_of(DINT profile) noexcept {
  switch (static_cast<SyncProfileReference>(profile)) {
    case SyncProfileReference::kDynamics:
      return SyncStartRule::dynamics;
    case SyncProfileReference::kAhead:
      return SyncStartRule::ahead;
    case SyncProfileReference::kDirect:
      return SyncStartRule::direct;
    case SyncProfileReference::kSubsequent:
      return SyncStartRule::subsequent;
    case SyncProfileReference::kSubsequentFromHere:
      return SyncStartRule::subsequent_from_here;
    case SyncProfileReference::kAtCamEnd:
      return SyncStartRule::at_cam_end;
    case SyncProfileReference::kAheadFromHere:
      return SyncStartRule::ahead_from_here;
  }
  return SyncStartRule::dynamics;
}

ShiftRule shift_rule_of(DINT profile) noexcept {
  if (is(profile, ShiftProfileReference::kDynamics)) return ShiftRule::dynamics;
  return is(profile, ShiftProfileReference::kFromPosition) ? ShiftRule::from_position : ShiftRule::from_here;
}

SyncDirection direction_of(DINT direction) noexcept {
  if (is(direction, PublishedDirection::kPositive)) return SyncDirection::kPositive;
  return is(direction, PublishedDirection::kNegative) ? SyncDirection::kNegative
                                                      : SyncDirection::kShortestPath;
}

}  // namespace

CouplingRequest coupling_request(const Job& job, const LeadingValue& leading,
                                 const Dynamics& dynamics) noexcept {
  const CamUse use{job.master_scaling, job.slave_scaling, static_cast<CamMode>(job.application_mode)};
  return {.source = leading.source,
          .coupling = leading.coupling,
          .velocity_only = job.kind == JobKind::MC_GearInVelocity,
          .dynamics = dynamics,
          .ratio = {job.numerator, job.denominator},
          .curve = job.cam != nullptr ? &job.cam->function() : nullptr,
          .start = start_rule_of(job.mode),
          .direction = direction_of(job.direction),
          .leading_position = job.master_sync_position,
          .following_position = job.slave_sync_position,
          .leading_distance = job.master_start_distance,
          .use = use,
          .leading_offset = job.master_offset,
          .following_offset = job.slave_offset};
}

LeavingRequest leaving_request(const Job& job) noexcept {
  return {.over_distance = is(job.mode, SyncOutProfileReference::kOverDistance),
          .direction = direction_of(job.direction),
          .position = job.position,
          .distance = job.master_start_distance};
}

ShiftRequest shift_request(const Job& job, DoubleDouble target, const Dynamics& dynamics) noexcept {
  const SyncDirection direction = direction_of(job.direction);
  return {.target = target,
          .rule = shift_rule_of(job.mode),
          .distance = job.master_start_distance,
          .start_position = job.start_position,
          .direction = direction == SyncDirection::kPositive   ? 1
                       : direction == SyncDirection::kNegative ? -1
                                                               : 0,
          .limits = limits_of(dynamics)};
}

ErrorId error_of(SyncRefusal refusal) noexcept {
  switch (refusal) {
    case SyncRefusal::none:
      return ErrorId::none;
    case SyncRefusal::leading_distance:
      return ErrorId::leading_distance;
    case SyncRefusal::direction:
      return ErrorId::direction;
    case SyncRefusal::velocity:
      return ErrorId::velocity;
    case SyncRefusal::leading_scaling:
      return ErrorId::master_scaling;
    case SyncRefusal::following_scaling:
      return ErrorId::slave_scaling;
    case SyncRefusal::leading_offset:
      return ErrorId::master_offset;
    case SyncRefusal::following_offset:
      return ErrorId::slave_offset;
    case SyncRefusal::cam_not_closed:
      return ErrorId::cam_elements_wrong;
    case SyncRefusal::outside_cam:
      return ErrorId::outside_cam;
    case SyncRefusal::no_cam_followed:
      return ErrorId::no_camming;
  }
  return ErrorId::unspecified;
}

}  // namespace lockstep
