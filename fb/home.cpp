#include "fb/home.hpp"

namespace lockstep {

void MC_Home::request(Job& job) const noexcept {
  job.kind = JobKind::MC_Home;
  job.position = Position;
  job.mode = Mode;
}

}  // namespace lockstep
