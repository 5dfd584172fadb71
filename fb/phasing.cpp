#include "fb/phasing.hpp"

namespace lockstep {

void PhasingBlock::request(Job& job) const noexcept {
  job.master = Master;
  job.position = PhaseShift;
  job.velocity = Velocity;
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.mode = ProfileReference;
  job.master_start_distance = PhasingDistance;
  job.start_position = StartPosition;
  job.direction = Direction;
}

void MC_PhasingRelative::request(Job& job) const noexcept {
  PhasingBlock::request(job);
  job.kind = JobKind::MC_PhasingRelative;
}

void MC_PhasingRelative::show(JobPhase phase) noexcept {
  PhasingBlock::show(phase);
  if (job() != nullptr) CoveredPhaseShift = job()->covered;
}

void MC_PhasingAbsolute::request(Job& job) const noexcept {
  PhasingBlock::request(job);
  job.kind = JobKind::MC_PhasingAbsolute;
}

void MC_PhasingAbsolute::show(JobPhase phase) noexcept {
  PhasingBlock::show(phase);
  if (job() != nullptr) AbsolutePhaseShift = job()->covered;
}

}  // namespace lockstep
