#include "fb/cam_in.hpp"

namespace lockstep {

bool MC_CamIn::has_direction(const Block& block) noexcept {
  const Axis* slave = static_cast<const MC_CamIn&>(block).Slave;
  return slave != nullptr && slave->data.Modulo.Enable && has_slave_offset(block);
}

/// Values that the profile does not look at keep what a job has by itself.
void MC_CamIn::request(Job& job) const noexcept {
  job.kind = JobKind::MC_CamIn;
  job.master = Master;
  job.cam = Cam;
  job.mode = SyncProfileReference;
  job.application_mode = ApplicationMode;
  job.master_scaling = MasterScaling;
  job.slave_scaling = SlaveScaling;
  job.direction = SyncDirection;
  if (has_master_offset(*this)) job.master_offset = MasterOffset;
  if (has_slave_offset(*this)) job.slave_offset = SlaveOffset;
  if (has_sync_position(*this)) job.master_sync_position = MasterSyncPosition;
  if (over_distance(*this)) job.master_start_distance = MasterStartDistance;
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
  const UDINT ends = shown != nullptr ? shown->ends : UDINT{0};
  EndOfProfile = ends > ends_ || (shown != nullptr && shown->ended() && shown->end_of_profile);
  ends_ = ends;
}

}  // namespace lockstep
