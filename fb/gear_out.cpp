#include "fb/gear_out.hpp"

namespace lockstep {

void MC_GearOut::request(Job& job) const noexcept {
  job.kind = JobKind::MC_GearOut;
  job.position = SlavePosition;
  job.mode = SyncProfileReference;
  job.master_start_distance = MasterStopDistance;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.direction = SyncOutDirection;
}

}  // namespace lockstep
