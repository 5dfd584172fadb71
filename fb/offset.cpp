#include "fb/offset.hpp"

namespace lockstep {

void OffsetBlock::request(Job& job) const noexcept {
  job.position = Offset;
  job.mode = ProfileReference;
  job.master_start_distance = OffsetDistance;
  job.start_position = StartPosition;
  job.direction = Direction;
}

void MC_OffsetRelative::request(Job& job) const noexcept {
  OffsetBlock::request(job);
  job.kind = JobKind::MC_OffsetRelative;
}

void MC_OffsetRelative::show(JobPhase phase) noexcept {
  OffsetBlock::show(phase);
  if (job() != nullptr) CoveredOffset = job()->covered;
}

void MC_OffsetAbsolute::request(Job& job) const noexcept {
  OffsetBlock::request(job);
  job.kind = JobKind::MC_OffsetAbsolute;
}

void MC_OffsetAbsolute::show(JobPhase phase) noexcept {
  OffsetBlock::show(phase);
  if (job() != nullptr) AbsoluteOffset = job()->covered;
}

}  // namespace lockstep
