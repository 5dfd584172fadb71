#include "fb/home.hpp"

namespace lockstep {

void MC_Home::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Home;
  job.asks = HomingJob{.mode = static_cast<HomeMode>(Mode), .position = Position, .sensor = Sensor};
}

void MC_Home::show(JobPhase phase) noexcept {
  if (phase == JobPhase::done && job() != nullptr)
    ReferenceMarkPosition = job()->as<HomingJob>().mark_position;
}

}  // namespace lockstep
