#include "fb/cam_out.hpp"

namespace lockstep {

void MC_CamOut::request(Job& job) const noexcept {
  job.kind = JobKind::MC_CamOut;
  job.position = SlavePosition;
  job.mode = SyncProfileReference;
  job.master_start_distance = MasterStopDistance;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.direction = SyncOutDirection;
}

}  // namespace lockstep
