#include "fb/phasing.hpp"

namespace lockstep {

void PhasingBlock::request(Job& job) const noexcept {
  job.asks = ShiftJob{.master = Master,
                      .shift = PhaseShift,
                      .profile = static_cast<ShiftProfileReference>(ProfileReference),
                      .direction = static_cast<PublishedDirection>(Direction),
                      .distance = PhasingDistance,
                      .start_position = StartPosition};
  job.velocity = Velocity;
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
}

void MC_PhasingRelative::request(Job& job) const noexcept {
  PhasingBlock::request(job);
  job.kind = JobKind::MC_PhasingRelative;
}

void MC_PhasingRelative::show(JobPhase phase) noexcept {
  PhasingBlock::show(phase);
  if (job() != nullptr) CoveredPhaseShift = job()->as<ShiftJob>().covered;
}

void MC_PhasingAbsolute::request(Job& job) const noexcept {
  PhasingBlock::request(job);
  job.kind = JobKind::MC_PhasingAbsolute;
}

void MC_PhasingAbsolute::show(JobPhase phase) noexcept {
  PhasingBlock::show(phase);
  if (job() != nullptr) AbsolutePhaseShift = job()->as<ShiftJob>().covered;
}

}  // namespace lockstep
