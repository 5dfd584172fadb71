#include "tech_objects/axis/synchronous_request.hpp"

#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

SyncStartRule start_rule_of(SyncProfileReference profile) noexcept {
  switch (profile) {
    case SyncProfileReference::dynamics:
      return SyncStartRule::dynamics;
    case SyncProfileReference::ahead:
      return SyncStartRule::ahead;
    case SyncProfileReference::direct:
      return SyncStartRule::direct;
    case SyncProfileReference::subsequent:
      return SyncStartRule::subsequent;
    case SyncProfileReference::subsequent_from_here:
      return SyncStartRule::subsequent_from_here;
    case SyncProfileReference::at_cam_end:
      return SyncStartRule::at_cam_end;
    case SyncProfileReference::ahead_from_here:
      return SyncStartRule::ahead_from_here;
  }
  return SyncStartRule::dynamics;
}

ShiftRule shift_rule_of(ShiftProfileReference profile) noexcept {
  if (profile == ShiftProfileReference::dynamics) return ShiftRule::dynamics;
  return profile == ShiftProfileReference::from_position ? ShiftRule::from_position : ShiftRule::from_here;
}

SyncDirection direction_of(PublishedDirection direction) noexcept {
  if (direction == PublishedDirection::positive) return SyncDirection::kPositive;
  return direction == PublishedDirection::negative ? SyncDirection::kNegative : SyncDirection::kShortestPath;
}

void ask_for_gear(const GearJob& gear, CouplingRequest& request) noexcept {
  request.ratio = {gear.numerator, gear.denominator};
  request.start = start_rule_of(gear.profile);
  request.direction = direction_of(gear.direction);
  request.leading_position = gear.master_sync_position;
  request.following_position = gear.slave_sync_position;
  request.leading_distance = gear.master_start_distance;
}

/// The kernel numbers the modes of a cam as they are published.
void ask_for_cam(const CamJob& cam, CouplingRequest& request) noexcept {
  request.curve = &cam.cam->function();
  request.start = start_rule_of(cam.profile);
  request.direction = direction_of(cam.direction);
  request.leading_position = cam.master_sync_position;
  request.leading_distance = cam.master_start_distance;
  request.use = {cam.master_scaling, cam.slave_scaling, static_cast<CamMode>(cam.application_mode)};
  request.leading_offset = cam.master_offset;
  request.following_offset = cam.slave_offset;
}

}  // namespace

CouplingRequest coupling_request(const Job& job, const LeadingValue& leading,
                                 const Dynamics& dynamics) noexcept {
  CouplingRequest request;
  request.source = leading.source;
  request.coupling = leading.coupling;
  request.velocity_only = job.kind == JobKind::MC_GearInVelocity;
  request.dynamics = dynamics;
  if (job.kind == JobKind::MC_CamIn)
    ask_for_cam(job.as<CamJob>(), request);
  else
    ask_for_gear(job.as<GearJob>(), request);
  return request;
}

LeavingRequest leaving_request(const LeavingJob& job) noexcept {
  return {.over_distance = job.profile == SyncOutProfileReference::over_distance,
          .direction = direction_of(job.direction),
          .position = job.position,
          .distance = job.master_stop_distance};
}

ShiftRequest shift_request(const ShiftJob& job, DoubleDouble target, const Dynamics& dynamics) noexcept {
  const SyncDirection direction = direction_of(job.direction);
  return {.target = target,
          .rule = shift_rule_of(job.profile),
          .distance = job.distance,
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
