#include "tech_objects/axis/axis_coupling.hpp"

#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/function_state.hpp"
#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

void AxisCoupling::show(const Job& job, AxisMotion motion) noexcept {
  motion_ = motion;
  attention.coupling_has_changed();
  LeadingObject* const master = master_of(job);
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionState = function_state(job.kind);
  status.ActualMaster = master->number;
  status.PhaseShift = status.Offset = 0.0;
  coupled_ = {master, nullptr};
  if (job.kind != JobKind::MC_CamIn) return clear_cam_status();
  const auto& cam = job.as<CamJob>();
  coupled_.cam = cam.cam;
  status.ActualCam = cam.cam->number;
  status.MasterOffset = synchronous_.leading_offset();
  status.MasterScaling = cam.master_scaling;
  status.SlaveOffset = synchronous_.following_offset_at_start();
  status.SlaveScaling = cam.slave_scaling;
}

void AxisCoupling::clear_cam_status() noexcept {
  const TO_Struct_StatusSynchronizedMotion none;
  auto& status = data.StatusSynchronizedMotion;
  status.ActualCam = none.ActualCam;
  status.MasterOffset = none.MasterOffset;
  status.MasterScaling = none.MasterScaling;
  status.SlaveOffset = none.SlaveOffset;
  status.SlaveScaling = none.SlaveScaling;
}

void AxisCoupling::leave() noexcept {
  if (!led(motion_)) return;
  motion_ = AxisMotion::single_axis;
  forget();
}

void AxisCoupling::end_simulated(JobPhase phase, ErrorId error) noexcept {
  if (simulated_ == nullptr) return;
  simulated_->phase = phase;
  simulated_->error = error;
  simulated_ = nullptr;
  forget();
}

void AxisCoupling::forget() noexcept {
  synchronous_.end();
  coupled_ = {};
  attention.coupling_has_changed();
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionState = 0;
  status.ActualMaster = DB_ANY{};
  status.PhaseShift = status.Offset = 0.0;
  clear_cam_status();
  status.StatusWord = DWORD{};
}

}  // namespace lockstep
