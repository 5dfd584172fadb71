#include "fb/interpolate_cam.hpp"

namespace lockstep {

void MC_InterpolateCam::request(Job& job) const noexcept {
  job.kind = JobKind::MC_InterpolateCam;
}

}  // namespace lockstep
