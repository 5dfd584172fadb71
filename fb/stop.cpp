#include "fb/stop.hpp"

namespace lockstep {

void MC_Halt::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Halt;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.abort_acceleration = AbortAcceleration;
  job.buffer_mode = static_cast<lockstep::BufferMode>(BufferMode);
}

void MC_Stop::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Stop;
  job.mode = Mode;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.abort_acceleration = AbortAcceleration;
  job.hold = true;
}

void MC_Stop::show(JobPhase /*phase*/) noexcept {
  if (job() != nullptr) job()->hold = Execute;
}

}  // namespace lockstep
