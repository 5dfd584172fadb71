#include "tech_objects/axis/job_ends.hpp"

#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/jobs/function_state.hpp"

namespace lockstep {

void JobEnds::end(Slot slot, JobPhase phase, ErrorId error) noexcept {
  Job* const job = jobs_.take(slot);
  if (job == nullptr) return;
  JobSlots::end(*job, phase, error);
  const bool alone = phase == JobPhase::failed && error != ErrorId::technology_alarm;
  if (slot == kBase && alone) end(kBuffered, JobPhase::aborted, ErrorId::none);
  if (slot == kSuperimposed) show_superimposed_command();
  // What moves the axis beside a simulated coupling ends the job, and the shift stays where it is.
  if (slot == kPhasing && simulated_ != nullptr) synchronous_.phase_shift().halt();
  if (slot == kOffset && simulated_ != nullptr) synchronous_.following_offset().halt();
  if (slot == kBase && class_of(*job, true) == JobClass::motion_in) show_motion_in_command();
  if (job->kind == JobKind::MC_Home) leave_homing();
  if (slot == kBase && leaves(job->kind)) data.StatusSynchronizedMotion.FunctionState = 0;
  if (slot == kWaiting || slot == kWaitingOut) {
    show_waiting();
    attention.coupling_has_changed();
  }
}

void JobEnds::abort(Slot slot, AbortedBy by, const Job* job) noexcept {
  Job* const aborted = jobs_[slot];
  if (aborted == nullptr) return;
  aborted->aborted_by = by;
  aborted->aborted_by_job = job;
  end(slot, JobPhase::aborted, ErrorId::none);
}

void JobEnds::abort_shifts(AbortedBy by, const Job* job) noexcept {
  for (const Slot slot : {kPhasing, kOffset, kWaitingOut}) abort(slot, by, job);
}

void JobEnds::end_all(JobPhase phase, ErrorId error, AbortedBy by) noexcept {
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    if (Job* const job = jobs_[slot]; job != nullptr) job->aborted_by = by;
    end(static_cast<Slot>(slot), phase, error);
  }
  jobs_.end_new(phase, error);
  jobs_.unlock_unless_done();
}

bool JobEnds::override_running(JobClass new_job, Job& job) noexcept {
  const Overriding effects = jobs_.overriding(new_job, job, position_controlled_);
  if (effects.refusal != ErrorId::none) {
    job.fail(effects.refusal);
    return false;
  }
  for (std::size_t slot = 0; slot < kSlots; ++slot)
    if (effects.ends[slot]) abort(static_cast<Slot>(slot), AbortedBy::job, &job);
  return true;
}

void JobEnds::leave_homing() noexcept {
  homing_.end();
  homing_now_ = false;
  switches_.renew_watch();
}

void JobEnds::show_waiting() noexcept {
  data.StatusSynchronizedMotion.WaitingFunctionState =
      waiting_function_state(jobs_[kWaiting], jobs_[kWaitingOut]);
}

void JobEnds::show_superimposed_command() noexcept {
  const Job* job = jobs_[kSuperimposed];
  const auto runs = [job](JobKind kind) { return job != nullptr && job->kind == kind; };
  set_bit(data.StatusWord, StatusBit::MoveSuperimposedCommand, runs(JobKind::MC_MoveSuperimposed));
  set_bit(data.StatusWord2, Status2Bit::MotionInSuperimposedCommand, runs(JobKind::MC_MotionInSuperimposed));
  set_bit(data.StatusWord2, Status2Bit::HaltSuperimposedCommand, runs(JobKind::MC_HaltSuperimposed));
  if (!runs(JobKind::MC_MotionInSuperimposed))
    set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, false);
}

void JobEnds::show_motion_in_command() noexcept {
  const Job* job = jobs_[kBase];
  DINT state = 0;
  if (job != nullptr && job->kind == JobKind::MC_MotionInVelocity) state = 1;
  if (job != nullptr && job->kind == JobKind::MC_MotionInPosition) state = 2;
  set_bit(data.StatusWord, StatusBit::MotionInCommand, state != 0);
  data.StatusMotionIn.FunctionState = state;
  if (state == 0) set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, false);
}

}  // namespace lockstep
