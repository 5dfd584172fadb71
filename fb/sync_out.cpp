#include "fb/sync_out.hpp"

namespace lockstep {

void SyncOutBlock::request(Job& job) const noexcept {
  job.kind = kind();
  job.position = SlavePosition;
  job.mode = SyncProfileReference;
  job.master_start_distance = MasterStopDistance;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.direction = SyncOutDirection;
}

}  // namespace lockstep
