#include "fb/superimposed.hpp"

namespace lockstep {

void MC_MoveSuperimposed::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MoveSuperimposed;
  job.asks = DistanceJob{.distance = Distance};
  job.velocity = VelocityDiff;
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
}

void MC_HaltSuperimposed::request(Job& job) const noexcept {
  job.kind = JobKind::MC_HaltSuperimposed;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.asks = StopJob{.abort_acceleration = AbortAcceleration};
}

void MC_MotionInSuperimposed::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MotionInSuperimposed;
  job.asks = MotionInJob{.position = Distance, .velocity = VelocityDiff, .acceleration = AccelerationDiff};
}

}  // namespace lockstep
