#include "fb/cam_in.hpp"

namespace lockstep {

bool MC_CamIn::has_direction(const Block& block) noexcept {
  const Axis* slave = static_cast<const MC_CamIn&>(block).Slave;
  return slave != nullptr && slave->data.Modulo.Enable && has_slave_offset(block);
}

/// Values that the profile does not look at keep what a job has by itself.
void MC_CamIn::request(Job& job) const noexcept {
  job.kind = JobKind::MC_CamIn;
  CamJob asked{.master = Master,
               .cam = Cam,
               .profile = static_cast<lockstep::SyncProfileReference>(SyncProfileReference),
               .application_mode = static_cast<CamApplicationMode>(ApplicationMode),
               .direction = static_cast<PublishedDirection>(SyncDirection),
               .master_scaling = MasterScaling,
               .slave_scaling = SlaveScaling};
  if (has_master_offset(*this)) asked.master_offset = MasterOffset;
  if (has_slave_offset(*this)) asked.slave_offset = SlaveOffset;
  if (has_sync_position(*this)) asked.master_sync_position = MasterSyncPosition;
  if (over_distance(*this)) asked.master_start_distance = MasterStartDistance;
  job.asks = asked;
  if (!over_time(*this)) return;
  job.velocity = Velocity;
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
}

void MC_CamIn::show(JobPhase phase) noexcept {
  StartSync = phase == JobPhase::active;
  InSync = phase == JobPhase::reached;
  const Job* shown = phase == JobPhase::idle ? nullptr : job();
  const CamJob* cam = shown != nullptr ? &shown->as<CamJob>() : nullptr;
  const UDINT ends = cam != nullptr ? cam->ends : UDINT{0};
  EndOfProfile = ends > ends_ || (cam != nullptr && shown->ended() && cam->end_of_profile);
  ends_ = ends;
}

}  // namespace lockstep
