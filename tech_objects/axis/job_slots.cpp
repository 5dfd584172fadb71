#include "tech_objects/axis/job_slots.hpp"

#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// What a job shows that another one forbids.
ErrorId rejection(JobClass new_job, JobClass running) noexcept {
  if (running == JobClass::gear_in_velocity) return ErrorId::velocity_gear_active;
  const bool shifts = (new_job == JobClass::phasing && running == JobClass::offset) ||
                      (new_job == JobClass::offset && running == JobClass::phasing);
  return shifts ? ErrorId::shifts_exclude : ErrorId::locked;
}

}  // namespace

void JobSlots::end(Job& job, JobPhase phase, ErrorId error) noexcept {
  const bool stopping = job.kind == JobKind::MC_Stop && phase == JobPhase::failed;
  job.phase = stopping ? JobPhase::aborted : phase;
  job.error = stopping ? ErrorId::none : error;
}

void JobSlots::submit(Job& job) noexcept {
  if (new_count_ == kNewJobs) {
    job.fail(ErrorId::no_job_memory);
    return;
  }
  job.phase = JobPhase::handed_over;
  job.aborted_by = AbortedBy::unknown;
  job.aborted_by_job = nullptr;
  new_[new_count_++] = &job;
}

void JobSlots::end_new(JobPhase phase, ErrorId error) noexcept {
  for (std::size_t i = 0; i < new_count_; ++i) end(*new_[i], phase, error);
  new_count_ = 0;
}

Overriding JobSlots::overriding(JobClass new_job, const Job& job, bool position_controlled) const noexcept {
  Overriding result;
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    const Job* running = running_[slot];
    if (running == nullptr) continue;
    const JobClass running_class = class_of(*running, slot == kBase);
    const OverrideEffect effect = override_effect(new_job, running_class, position_controlled);
    const bool weaker = effect == OverrideEffect::abort_by_rank &&
                        stop_rank(job.as<StopJob>().mode) < stop_rank(running->as<StopJob>().mode);
    if (effect == OverrideEffect::reject || weaker) return {rejection(new_job, running_class), {}};
    result.ends[slot] = effect == OverrideEffect::abort || effect == OverrideEffect::abort_by_rank;
  }
  return result;
}

bool JobSlots::runs_or_waits(bool cam) const noexcept {
  const auto of_kind = [cam](const Job* job) { return job != nullptr && of_cam(job->kind) == cam; };
  const Job* base = running_[kBase];
  const bool runs = of_kind(base) && couples(base->kind);
  return runs || of_kind(running_[kWaiting]) || of_kind(running_[kWaitingOut]);
}

int JobSlots::stop_rank(StopMode mode) noexcept {
  return mode == StopMode::emergency_ramp ? 3 : mode == StopMode::maximum_dynamics ? 2 : 1;
}

bool JobSlots::stops_harder_than(AlarmReaction reaction) const noexcept {
  const Job* const base = running_[kBase];
  return base != nullptr && base->kind == JobKind::MC_Stop &&
         stop_rank(base->as<StopJob>().mode) > static_cast<int>(reaction);
}

}  // namespace lockstep
