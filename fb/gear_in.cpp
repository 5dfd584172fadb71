#include "fb/gear_in.hpp"

namespace lockstep {

void MC_GearIn::request(Job& job) const noexcept {
  job.kind = JobKind::MC_GearIn;
  job.asks = GearJob{.master = Master, .numerator = RatioNumerator, .denominator = RatioDenominator};
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
}

bool MC_GearInPos::following_modulo(const Block& block) noexcept {
  const Axis* slave = static_cast<const MC_GearInPos&>(block).Slave;
  return slave != nullptr && slave->data.Modulo.Enable;
}

void MC_GearInPos::request(Job& job) const noexcept {
  job.kind = JobKind::MC_GearInPos;
  job.asks = GearJob{.master = Master,
                     .numerator = RatioNumerator,
                     .denominator = RatioDenominator,
                     .profile = static_cast<lockstep::SyncProfileReference>(SyncProfileReference),
                     .direction = static_cast<PublishedDirection>(SyncDirection),
                     .master_sync_position = MasterSyncPosition,
                     .slave_sync_position = SlaveSyncPosition,
                     .master_start_distance = MasterStartDistance};
  job.velocity = Velocity;
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
}

}  // namespace lockstep
