// Jobs of an axis: taking them over, and who does what they ask for.
#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/direct_homing.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

void Axis::submit(Job& job) noexcept {
  if (!acts_at_once(job.kind)) {
    attention.job_is_new();
    return jobs_.submit(job);
  }
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
      return sensors_.set(job.as<SensorJob>());
    case JobKind::MC_SetAxisSTW:
      return drive_control_.set_free_bits(job.as<ControlBitsJob>(), has_drive_);
    default:  // MC_WriteParameter
      return switches_.activate_limit_switches(job.as<LimitSwitchesJob>().active);
  }
}

void Axis::start_jobs() noexcept {
  jobs_.take_new([this](Job& job) { start(job); });
}

void Axis::start(Job& job) noexcept {
  if (job.kind == JobKind::MC_Reset) {
    const ErrorId error = reset(job.as<ResetJob>().restart);
    if (error != ErrorId::none) return job.fail(error);
    job.phase = JobPhase::done;
    return;
  }
  limits_.take_defaults(job);
  if (const ErrorId error = checks_.refusal(job); error != ErrorId::none) {
    if (error == ErrorId::technology_alarm) return JobSlots::end(job, JobPhase::failed, error);
    return job.fail(error);
  }
  if (clamping_.found())
    if (const ErrorId error = torque_.check_at_fixed_stop(job); error != ErrorId::none)
      return job.fail(error);
  if (const MissingPrecondition missing = checks_.missing_precondition(job); missing.alarm != 0) {
    reactions_.raise(missing.alarm, missing.detail);
    return job.fail(ErrorId::technology_alarm);
  }
  if (is_shift(job.kind) && job.as<ShiftJob>().profile == ShiftProfileReference::cancel_waiting)
    return shifting_.cancel_waiting(job);
  if (job.buffer_mode != BufferMode::mcAborting && buffer_.take(job)) return;
  if (couples_at_position(job.kind)) return following_.begin_waiting(job);
  if (!ends_.override_running(class_of(job, false), job)) return;
  install(job);
}

void Axis::install(Job& job) noexcept {
  switch (job.kind) {
    case JobKind::MC_Home:
      home(job);
      break;
    case JobKind::MC_GearIn:
    case JobKind::MC_GearInVelocity:
      following_.begin_gear_in(job);
      break;
    case JobKind::MC_GearOut:
    case JobKind::MC_CamOut:
      leaving_.begin(job);
      break;
    case JobKind::MC_PhasingAbsolute:
    case JobKind::MC_PhasingRelative:
    case JobKind::MC_OffsetAbsolute:
    case JobKind::MC_OffsetRelative:
      shifting_.begin(job);
      break;
    case JobKind::MC_MoveSuperimposed:
    case JobKind::MC_MotionInSuperimposed:
    case JobKind::MC_HaltSuperimposed:
      superimposed_orders_.begin(job);
      break;
    case JobKind::MC_MotionInVelocity:
    case JobKind::MC_MotionInPosition:
      given_.begin(job);
      break;
    default:
      motion_orders_.begin(job);
      break;
  }
}

void Axis::home(Job& job) noexcept {
  switch (class_of(job, true)) {
    case JobClass::home_cancel:  // the override rules have ended what it ends
      job.phase = JobPhase::done;
      break;
    case JobClass::home_passive:
      homing_orders_.begin_in_passing(job);
      break;
    case JobClass::home_active:
      homing_orders_.begin_active(job);
      break;
    default:
      direct_homing_.home(job);
      break;
  }
  if (job.phase != JobPhase::failed) count_homing(job);
}

ErrorId Axis::reset(bool restart) noexcept {
  // An alarm may have removed the enable; while MC_Power still asks for it the axis is not disabled.
  if (restart && (power.enable || power_state_ != PowerState::off)) {
    reactions_.raise(alarm::kRestartNotCarriedOut, {.cause = AlarmCause::enabled});
    return ErrorId::restart_refused;
  }
  reactions_.acknowledge();
  if (restart) this->restart();
  if (has_drive_ && (encoders_.lost() || drive_->in_trouble())) faults_.acknowledge();
  return ErrorId::none;
}

}  // namespace lockstep
