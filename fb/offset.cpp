#include "fb/offset.hpp"

namespace lockstep {

void OffsetBlock::request(Job& job) const noexcept {
  job.asks = ShiftJob{.shift = Offset,
                      .profile = static_cast<ShiftProfileReference>(ProfileReference),
                      .direction = static_cast<PublishedDirection>(Direction),
                      .distance = OffsetDistance,
                      .start_position = StartPosition};
}

void MC_OffsetRelative::request(Job& job) const noexcept {
  OffsetBlock::request(job);
  job.kind = JobKind::MC_OffsetRelative;
}

void MC_OffsetRelative::show(JobPhase phase) noexcept {
  OffsetBlock::show(phase);
  if (job() != nullptr) CoveredOffset = job()->as<ShiftJob>().covered;
}

void MC_OffsetAbsolute::request(Job& job) const noexcept {
  OffsetBlock::request(job);
  job.kind = JobKind::MC_OffsetAbsolute;
}

void MC_OffsetAbsolute::show(JobPhase phase) noexcept {
  OffsetBlock::show(phase);
  if (job() != nullptr) AbsoluteOffset = job()->as<ShiftJob>().covered;
}

}  // namespace lockstep
