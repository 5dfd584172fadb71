#include "fb/motion_in.hpp"

namespace lockstep {

void MC_MotionInVelocity::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MotionInVelocity;
  job.asks = MotionInJob{.velocity = Velocity, .acceleration = Acceleration};
  job.position_controlled = PositionControlled;
}

void MC_MotionInPosition::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MotionInPosition;
  job.asks = MotionInJob{.position = Position, .velocity = Velocity, .acceleration = Acceleration};
}

}  // namespace lockstep
