// Jobs of an axis: taking them over, the override rules, and their ends.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/function_state.hpp"

namespace lockstep {
namespace {

/// Longest chain of leading axes that is followed; a project cannot have more axes.
constexpr int kLongestChain = 65536;

/// Strength of the stop reaction of MC_Stop: emergency stop over maximum dynamics over given dynamics.
int stop_rank(DINT mode) noexcept {
  return mode == 0 ? 3 : mode == 2 ? 2 : 1;
}

/// An alarm shows at MC_Stop as CommandAborted.
void end(Job& job, JobPhase phase, ErrorId error) noexcept {
  const bool stopping = job.kind == JobKind::MC_Stop && phase == JobPhase::failed;
  job.phase = stopping ? JobPhase::aborted : phase;
  job.error = stopping ? ErrorId::none : error;
}

/// What a job shows that another one forbids.
ErrorId rejection(JobClass new_job, JobClass running) noexcept {
  if (running == JobClass::gear_in_velocity) return ErrorId::velocity_gear_active;
  const bool shifts = (new_job == JobClass::phasing && running == JobClass::offset) ||
                      (new_job == JobClass::offset && running == JobClass::phasing);
  return shifts ? ErrorId::shifts_exclude : ErrorId::locked;
}

}  // namespace

void Axis::submit(Job& job) noexcept {
  if (new_count_ == kNewJobs) {
    job.fail(ErrorId::no_job_memory);
    return;
  }
  job.phase = JobPhase::handed_over;
  new_jobs_[new_count_++] = &job;
}

void Axis::start_jobs() noexcept {
  for (std::size_t i = 0; i < new_count_; ++i) start(*new_jobs_[i]);
  new_count_ = 0;
}

void Axis::start(Job& job) noexcept {
  if (job.kind == JobKind::MC_Reset) {
    const ErrorId error = reset(job.mode == 1);
    if (error != ErrorId::none) return job.fail(error);
    job.phase = JobPhase::done;
    return;
  }
  take_defaults(job);
  if (const ErrorId error = check(job); error != ErrorId::none) {
    if (error == ErrorId::technology_alarm) return end(job, JobPhase::failed, error);
    return job.fail(error);
  }
  if (forces_.stop_side != 0)
    if (const ErrorId error = check_at_fixed_stop(job); error != ErrorId::none) return job.fail(error);
  if (const int alarm_number = missing_precondition(job); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  if (is_shift(job.kind) && job.mode == kCancelWaiting) return cancel_waiting_shift(job);
  if (job.buffer_mode != BufferMode::mcAborting && buffer(job)) return;
  if (couples_at_position(job.kind)) return begin_waiting(job);
  if (!override_running(class_of(job, false), job)) return;
  install(job);
}

/// Whether the state of the axis permits the job at all.
ErrorId Axis::check(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_Home) return check_homing(job);
  const bool stronger =
      job.kind == JobKind::MC_Stop && stop_rank(job.mode) >= static_cast<int>(data.ErrorDetail.Reaction);
  if (pending_alarm() != 0 && !stronger) return ErrorId::technology_alarm;
  if (!enabled()) return ErrorId::locked;
  if (locked_by_stop() && job.kind != JobKind::MC_Stop) return ErrorId::locked;
  if (const ErrorId error = check_synchronous(job); error != ErrorId::none) return error;
  const bool at_once = job.buffer_mode == BufferMode::mcAborting || running_[kBase] == nullptr;
  return at_once ? target_refusal(job) : ErrorId::none;
}

/// Conditions of synchronous jobs, and of values given on top of a motion.
ErrorId Axis::check_synchronous(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MotionInSuperimposed && !position_controlled_)
    return led() ? ErrorId::velocity_gear_active : ErrorId::not_position_controlled;
  if (!couples(job.kind) && !is_shift(job.kind) && !leaves(job.kind)) return ErrorId::none;
  if (simulating()) return ErrorId::simulated;
  if (couples(job.kind)) {
    if (job.master == this) return ErrorId::recursive_coupling;
    // A waiting job couples nothing yet; it is looked at again when it would become active.
    const bool recursive = !couples_at_position(job.kind) && led_by_this(job.master);
    if (recursive) return ErrorId::recursive_coupling;
    return job.kind == JobKind::MC_CamIn ? check_cam(job) : ErrorId::none;
  }
  const Job* base = running_[kBase];
  if (base != nullptr && base->kind == JobKind::MC_GearInVelocity) return ErrorId::velocity_gear_active;
  const bool cam_out = job.kind == JobKind::MC_CamOut;
  if (leaves(job.kind) && !runs_or_waits(cam_out)) return cam_out ? ErrorId::no_cam : ErrorId::no_gear;
  if (leaves(job.kind)) return ErrorId::none;
  if (job.mode == kCancelWaiting) return ErrorId::none;
  const bool in_time = is_phasing(job.kind) && job.mode == 0;
  if (in_time && base != nullptr && base->kind == JobKind::MC_CamIn) return ErrorId::phasing_in_time;
  if (motion_ != Motion::synchronous) return ErrorId::not_synchronous;
  // A leading axis that is not interconnected at all is an alarm.
  const bool of_another =
      is_phasing(job.kind) && job.master != coupled_.leading && find_leading_value(job.master) != nullptr;
  return of_another ? ErrorId::not_synchronous : ErrorId::none;
}

ErrorId Axis::check_cam(const Job& job) const noexcept {
  if (job.cam->restarting()) return ErrorId::restarting;
  if (job.cam->in_interpolation()) return ErrorId::cam_in_interpolation;
  const Job* base = running_[kBase];
  const bool camming = base != nullptr && base->kind == JobKind::MC_CamIn && motion_ == Motion::synchronous;
  return job.mode == kAtCamEnd && !camming ? ErrorId::no_camming : ErrorId::none;
}

/// Whether a gear (a cam) runs, waits or is about to be left.
bool Axis::runs_or_waits(bool cam) const noexcept {
  const auto of_kind = [cam](const Job* job) { return job != nullptr && of_cam(job->kind) == cam; };
  const Job* base = running_[kBase];
  const bool runs = of_kind(base) && couples(base->kind);
  return runs || of_kind(running_[kWaiting]) || of_kind(running_[kWaitingOut]);
}

/// Profile 5: ends a shift that waits; one that runs and the shift in effect stay.
void Axis::cancel_waiting_shift(Job& job) noexcept {
  const Slot slot = is_phasing(job.kind) ? kPhasing : kOffset;
  if (running_[slot] != nullptr && running_[slot]->phase == JobPhase::waiting) {
    end_job(slot, JobPhase::aborted, ErrorId::none);
    (slot == kPhasing ? synchronous_.phase_shift() : synchronous_.following_offset()).cancel();
  }
  job.phase = JobPhase::done;
}

/// Preconditions whose absence is a technology alarm; 0: none is missing.
int Axis::missing_precondition(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MoveAbsolute && !homed_) return alarm::kNotHomed;
  if (job.kind == JobKind::MC_Home) return missing_for_homing(job);
  if (!couples(job.kind) && !is_phasing(job.kind)) return 0;
  const LeadingValue* leading = find_leading_value(job.master);
  if (leading == nullptr) return alarm::kLeadingAxis;
  if (is_phasing(job.kind)) return 0;
  if (!job.master->actual_values_valid()) return alarm::kLeadingAxis;
  if (job.kind == JobKind::MC_CamIn && !job.cam->interpolated()) return alarm::kCamNotInterpolated;
  const bool controlled = job.kind == JobKind::MC_GearInVelocity || job.master->position_controlled() ||
                          leading->coupling == Coupling::actual;
  if (!controlled) return alarm::kLeadingAxisNotPositionControlled;
  return couples_at_position(job.kind) && !homed_ ? alarm::kNotHomed : 0;
}

bool Axis::led_by_this(const LeadingObject* leading) const noexcept {
  for (int i = 0; leading != nullptr && i < kLongestChain; ++i) {
    if (leading == this) return true;
    if (!among(leading->kind, kAnyAxis)) return false;
    leading = static_cast<const Axis*>(leading)->coupled_leading_axis();
  }
  return false;
}

const LeadingValue* Axis::find_leading_value(const LeadingObject* master) const noexcept {
  for (const LeadingValue& leading : leading_values)
    if (leading.source == master) return &leading;
  return nullptr;
}

/// Ends the running jobs that the new one overrides; false if one of them forbids it.
bool Axis::override_running(JobClass new_job, Job& job) noexcept {
  std::array<OverrideEffect, kSlots> effects{};
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    const Job* running = running_[slot];
    if (running == nullptr) continue;
    effects[slot] = override_effect(new_job, class_of(*running, slot == kBase), position_controlled_);
    const bool weaker =
        effects[slot] == OverrideEffect::abort_by_rank && stop_rank(job.mode) < stop_rank(running->mode);
    if (effects[slot] == OverrideEffect::reject || weaker) {
      job.fail(rejection(new_job, class_of(*running, slot == kBase)));
      return false;
    }
  }
  for (std::size_t slot = 0; slot < kSlots; ++slot)
    if (effects[slot] == OverrideEffect::abort || effects[slot] == OverrideEffect::abort_by_rank)
      end_job(static_cast<Slot>(slot), JobPhase::aborted, ErrorId::none);
  return true;
}

void Axis::install(Job& job) noexcept {
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

void Axis::end_job(Slot slot, JobPhase phase, ErrorId error) noexcept {
  Job* job = running_[slot];
  if (job == nullptr) return;
  running_[slot] = nullptr;
  end(*job, phase, error);
  const bool alone = phase == JobPhase::failed && error != ErrorId::technology_alarm;
  if (slot == kBase && alone) end_job(kBuffered, JobPhase::aborted, ErrorId::none);
  if (slot == kSuperimposed) show_superimposed_command();
  // What moves the axis beside a simulated coupling ends the job, and the shift stays where it is.
  if (slot == kPhasing && simulating()) synchronous_.phase_shift().halt();
  if (slot == kOffset && simulating()) synchronous_.following_offset().halt();
  if (slot == kBase && class_of(*job, true) == JobClass::motion_in) show_motion_in_command();
  if (job->kind == JobKind::MC_Home) leave_homing(*job);
  if (slot == kBase && leaves(job->kind)) data.StatusSynchronizedMotion.FunctionState = 0;
  if (slot == kWaiting || slot == kWaitingOut) {
    data.StatusSynchronizedMotion.WaitingFunctionState =
        waiting_function_state(running_[kWaiting], running_[kWaitingOut]);
    coupling_changed = true;
  }
}

void Axis::end_all_jobs(JobPhase phase, ErrorId error) noexcept {
  for (std::size_t slot = 0; slot < kSlots; ++slot) end_job(static_cast<Slot>(slot), phase, error);
  for (std::size_t i = 0; i < new_count_; ++i) end(*new_jobs_[i], phase, error);
  new_count_ = 0;
  // One that is done keeps the axis locked until its Execute falls.
  if (stop_ != nullptr && stop_->phase != JobPhase::done) stop_ = nullptr;
}

/// Whether a running MC_Stop stops harder than an alarm asks for: then it goes on.
/// @source S7-1500T axis functions, MC_Stop, rank of stop reactions
bool Axis::outranked_by_stop(AlarmReaction reaction) const noexcept {
  const Job* const base = running_[kBase];
  return base != nullptr && base->kind == JobKind::MC_Stop &&
         stop_rank(base->mode) > static_cast<int>(reaction);
}

}  // namespace lockstep
