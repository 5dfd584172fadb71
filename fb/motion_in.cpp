#include "fb/motion_in.hpp"

namespace lockstep {

void MC_MotionInVelocity::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MotionInVelocity;
  job.velocity = Velocity;
  job.acceleration = Acceleration;
  job.position_controlled = PositionControlled;
}

void MC_MotionInPosition::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MotionInPosition;
  job.position = Position;
  job.velocity = Velocity;
  job.acceleration = Acceleration;
}

}  // namespace lockstep
