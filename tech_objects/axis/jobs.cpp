// Jobs of an axis: taking them over, the override rules, and their ends.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/function_state.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// Longest chain of leading axes that is followed; a project cannot have more axes.
constexpr int kLongestChain = 65536;

}  // namespace

void Axis::submit(Job& job) noexcept {
  if (!acts_at_once(job.kind)) return jobs_.submit(job);
  if (job.kind == JobKind::MC_SetAxisSTW && stopping() && !power.enable) {
    job.phase = JobPhase::aborted;  // by disabling, like all jobs
    return;
  }
  if (const ErrorId error = carry_out(job); error != ErrorId::none) return job.fail(error);
  job.phase = JobPhase::done;
}

ErrorId Axis::carry_out(const Job& job) noexcept {
  switch (job.kind) {
    case JobKind::MC_SetSensor:
      return set_sensor(job.as<SensorJob>());
    case JobKind::MC_SetAxisSTW:
      return set_control_bits(job.as<ControlBitsJob>());
    default:  // MC_WriteParameter
      return activate_limit_switches(job.as<LimitSwitchesJob>().active);
  }
}

void Axis::start_jobs() noexcept {
  jobs_.take_new([this](Job& job) { start(job); });
}

void AxisOrders::start(Job& job) noexcept {
  if (job.kind == JobKind::MC_Reset) {
    const ErrorId error = reset(job.as<ResetJob>().restart);
    if (error != ErrorId::none) return job.fail(error);
    job.phase = JobPhase::done;
    return;
  }
  limits_.take_defaults(job);
  if (const ErrorId error = check(job); error != ErrorId::none) {
    if (error == ErrorId::technology_alarm) return JobSlots::end(job, JobPhase::failed, error);
    return job.fail(error);
  }
  if (clamping_.found())
    if (const ErrorId error = check_at_fixed_stop(job); error != ErrorId::none) return job.fail(error);
  if (const int alarm_number = missing_precondition(job); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  if (is_shift(job.kind) && job.as<ShiftJob>().profile == ShiftProfileReference::cancel_waiting)
    return cancel_waiting_shift(job);
  if (job.buffer_mode != BufferMode::mcAborting && buffer(job)) return;
  if (couples_at_position(job.kind)) return begin_waiting(job);
  if (!override_running(class_of(job, false), job)) return;
  install(job);
}

/// Whether the state of the axis permits the job at all.
ErrorId AxisOrders::check(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_Home) return check_homing(job);
  const bool stronger = job.kind == JobKind::MC_Stop && JobSlots::stop_rank(job.as<StopJob>().mode) >=
                                                            static_cast<int>(data.ErrorDetail.Reaction);
  if (pending_alarm() != 0 && !stronger) return ErrorId::technology_alarm;
  if (!enabled()) return ErrorId::locked;
  if (jobs_.locked() && job.kind != JobKind::MC_Stop) return ErrorId::locked;
  if (const ErrorId error = check_synchronous(job); error != ErrorId::none) return error;
  const bool at_once = job.buffer_mode == BufferMode::mcAborting || jobs_[kBase] == nullptr;
  return at_once ? target_refusal(job) : ErrorId::none;
}

/// Conditions of synchronous jobs, and of values given on top of a motion.
ErrorId AxisOrders::check_synchronous(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MotionInSuperimposed && !position_controlled_)
    return led() ? ErrorId::velocity_gear_active : ErrorId::not_position_controlled;
  if (!couples(job.kind) && !is_shift(job.kind) && !leaves(job.kind)) return ErrorId::none;
  if (simulating()) return ErrorId::simulated;
  if (couples(job.kind)) {
    const LeadingObject* const master = master_of(job);
    if (master == this) return ErrorId::recursive_coupling;
    // A waiting job couples nothing yet; it is looked at again when it would become active.
    const bool recursive = !couples_at_position(job.kind) && led_by_this(master);
    if (recursive) return ErrorId::recursive_coupling;
    return job.kind == JobKind::MC_CamIn ? check_cam(job) : ErrorId::none;
  }
  const Job* base = jobs_[kBase];
  if (base != nullptr && base->kind == JobKind::MC_GearInVelocity) return ErrorId::velocity_gear_active;
  const bool cam_out = job.kind == JobKind::MC_CamOut;
  if (leaves(job.kind) && !jobs_.runs_or_waits(cam_out)) return cam_out ? ErrorId::no_cam : ErrorId::no_gear;
  if (leaves(job.kind)) return ErrorId::none;
  const auto& shift = job.as<ShiftJob>();
  if (shift.profile == ShiftProfileReference::cancel_waiting) return ErrorId::none;
  const bool in_time = is_phasing(job.kind) && shift.profile == ShiftProfileReference::dynamics;
  if (in_time && base != nullptr && base->kind == JobKind::MC_CamIn) return ErrorId::phasing_in_time;
  if (motion_ != Motion::synchronous) return ErrorId::not_synchronous;
  // A leading axis that is not interconnected at all is an alarm.
  const bool of_another =
      is_phasing(job.kind) && shift.master != coupled_.leading && find_leading_value(shift.master) != nullptr;
  return of_another ? ErrorId::not_synchronous : ErrorId::none;
}

ErrorId AxisOrders::check_cam(const Job& job) const noexcept {
  const auto& asked = job.as<CamJob>();
  if (asked.cam->restarting()) return ErrorId::restarting;
  if (asked.cam->in_interpolation()) return ErrorId::cam_in_interpolation;
  const Job* base = jobs_[kBase];
  const bool camming = base != nullptr && base->kind == JobKind::MC_CamIn && motion_ == Motion::synchronous;
  return asked.profile == SyncProfileReference::at_cam_end && !camming ? ErrorId::no_camming : ErrorId::none;
}

/// Profile 5: ends a shift that waits; one that runs and the shift in effect stay.
void AxisOrders::cancel_waiting_shift(Job& job) noexcept {
  const Slot slot = is_phasing(job.kind) ? kPhasing : kOffset;
  if (jobs_[slot] != nullptr && jobs_[slot]->phase == JobPhase::waiting) {
    end_job(slot, JobPhase::aborted, ErrorId::none);
    (slot == kPhasing ? synchronous_.phase_shift() : synchronous_.following_offset()).cancel();
  }
  job.phase = JobPhase::done;
}

/// Preconditions whose absence is a technology alarm; 0: none is missing.
int AxisOrders::missing_precondition(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MoveAbsolute && !homed_) return alarm::kNotHomed;
  if (job.kind == JobKind::MC_Home) return missing_for_homing(job);
  if (!couples(job.kind) && !is_phasing(job.kind)) return 0;
  const LeadingObject* const master = master_of(job);
  const LeadingValue* leading = find_leading_value(master);
  if (leading == nullptr) return alarm::kLeadingAxis;
  if (is_phasing(job.kind)) return 0;
  if (!master->actual_values_valid()) return alarm::kLeadingAxis;
  if (job.kind == JobKind::MC_CamIn && !job.as<CamJob>().cam->interpolated())
    return alarm::kCamNotInterpolated;
  const bool controlled = job.kind == JobKind::MC_GearInVelocity || master->position_controlled() ||
                          leading->coupling == Coupling::actual;
  if (!controlled) return alarm::kLeadingAxisNotPositionControlled;
  return couples_at_position(job.kind) && !homed_ ? alarm::kNotHomed : 0;
}

bool AxisOrders::led_by_this(const LeadingObject* leading) const noexcept {
  for (int i = 0; leading != nullptr && i < kLongestChain; ++i) {
    if (leading == this) return true;
    if (!among(leading->kind, kAnyAxis)) return false;
    leading = static_cast<const Axis*>(leading)->coupled_leading_axis();
  }
  return false;
}

const LeadingValue* AxisOrders::find_leading_value(const LeadingObject* master) const noexcept {
  for (const LeadingValue& leading : leading_values)
    if (leading.source == master) return &leading;
  return nullptr;
}

/// Ends the running jobs that the new one overrides; false if one of them forbids it.
bool AxisOrders::override_running(JobClass new_job, Job& job) noexcept {
  const Overriding effects = jobs_.overriding(new_job, job, position_controlled_);
  if (effects.refusal != ErrorId::none) {
    job.fail(effects.refusal);
    return false;
  }
  for (std::size_t slot = 0; slot < kSlots; ++slot)
    if (effects.ends[slot]) end_job(static_cast<Slot>(slot), JobPhase::aborted, ErrorId::none);
  return true;
}

void AxisOrders::install(Job& job) noexcept {
  switch (job.kind) {
    case JobKind::MC_Home:
      home(job);
      break;
    case JobKind::MC_GearIn:
    case JobKind::MC_GearInVelocity:
      begin_gear_in(job);
      break;
    case JobKind::MC_GearOut:
    case JobKind::MC_CamOut:
      begin_sync_out(job);
      break;
    case JobKind::MC_PhasingAbsolute:
    case JobKind::MC_PhasingRelative:
    case JobKind::MC_OffsetAbsolute:
    case JobKind::MC_OffsetRelative:
      begin_shift(job);
      break;
    case JobKind::MC_MoveSuperimposed:
    case JobKind::MC_MotionInSuperimposed:
    case JobKind::MC_HaltSuperimposed:
      begin_superimposed(job);
      break;
    case JobKind::MC_MotionInVelocity:
    case JobKind::MC_MotionInPosition:
      begin_motion_in(job);
      break;
    default:
      begin_base_motion(job);
      break;
  }
}

void AxisOrders::end_job(Slot slot, JobPhase phase, ErrorId error) noexcept {
  Job* const job = jobs_.take(slot);
  if (job == nullptr) return;
  JobSlots::end(*job, phase, error);
  const bool alone = phase == JobPhase::failed && error != ErrorId::technology_alarm;
  if (slot == kBase && alone) end_job(kBuffered, JobPhase::aborted, ErrorId::none);
  if (slot == kSuperimposed) show_superimposed_command();
  // What moves the axis beside a simulated coupling ends the job, and the shift stays where it is.
  if (slot == kPhasing && simulating()) synchronous_.phase_shift().halt();
  if (slot == kOffset && simulating()) synchronous_.following_offset().halt();
  if (slot == kBase && class_of(*job, true) == JobClass::motion_in) show_motion_in_command();
  if (job->kind == JobKind::MC_Home) leave_homing();
  if (slot == kBase && leaves(job->kind)) data.StatusSynchronizedMotion.FunctionState = 0;
  if (slot == kWaiting || slot == kWaitingOut) {
    data.StatusSynchronizedMotion.WaitingFunctionState =
        waiting_function_state(jobs_[kWaiting], jobs_[kWaitingOut]);
    coupling_changed = true;
  }
}

void AxisOrders::end_all_jobs(JobPhase phase, ErrorId error) noexcept {
  for (std::size_t slot = 0; slot < kSlots; ++slot) end_job(static_cast<Slot>(slot), phase, error);
  jobs_.end_new(phase, error);
  jobs_.unlock_unless_done();
}

}  // namespace lockstep
