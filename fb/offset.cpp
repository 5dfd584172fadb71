#include "fb/offset.hpp"

namespace lockstep {

void MC_OffsetRelative::request(Job& job) const noexcept {
  job.kind = JobKind::MC_OffsetRelative;
  job.position = Offset;
  job.mode = ProfileReference;
  job.master_start_distance = OffsetDistance;
  job.start_position = StartPosition;
  job.direction = Direction;
}

void MC_OffsetRelative::show(JobPhase phase) noexcept {
  StartOffset = phase == JobPhase::active;
  if (job() != nullptr) CoveredOffset = job()->covered;
}

void MC_OffsetAbsolute::request(Job& job) const noexcept {
  job.kind = JobKind::MC_OffsetAbsolute;
  job.position = Offset;
  job.mode = ProfileReference;
  job.master_start_distance = OffsetDistance;
  job.start_position = StartPosition;
  job.direction = Direction;
}

void MC_OffsetAbsolute::show(JobPhase phase) noexcept {
  StartOffset = phase == JobPhase::active;
  if (job() != nullptr) AbsoluteOffset = job()->covered;
}

}  // namespace lockstep
