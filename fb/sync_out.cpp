#include "fb/sync_out.hpp"

namespace lockstep {

void SyncOutBlock::request(Job& job) const noexcept {
  job.kind = kind();
  job.asks = LeavingJob{.position = SlavePosition,
                        .profile = static_cast<SyncOutProfileReference>(SyncProfileReference),
                        .direction = static_cast<PublishedDirection>(SyncOutDirection),
                        .master_stop_distance = MasterStopDistance};
  job.deceleration = Deceleration;
  job.jerk = Jerk;
}

}  // namespace lockstep
