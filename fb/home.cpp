#include "fb/home.hpp"

namespace lockstep {

void MC_Home::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Home;
  job.position = Position;
  job.mode = Mode;
  job.sensor = Sensor;
}

void MC_Home::show(JobPhase phase) noexcept {
  if (phase == JobPhase::done && job() != nullptr) ReferenceMarkPosition = job()->mark_position;
}

}  // namespace lockstep
