#include "fb/stop.hpp"

namespace lockstep {

void MC_Halt::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Halt;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.asks = StopJob{.abort_acceleration = AbortAcceleration};
  job.buffer_mode = static_cast<lockstep::BufferMode>(BufferMode);
}

void MC_Stop::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Stop;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.asks =
      StopJob{.mode = static_cast<StopMode>(Mode), .abort_acceleration = AbortAcceleration, .hold = true};
}

void MC_Stop::show(JobPhase /*phase*/) noexcept {
  if (job() != nullptr) job()->as<StopJob>().hold = Execute;
}

}  // namespace lockstep
