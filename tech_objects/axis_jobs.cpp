// Jobs of an axis: taking them over, the override rules, and their ends.
#include <cmath>

#include "tech_objects/axis.hpp"

namespace lockstep {
namespace {

/// Longest chain of leading axes that is followed; a project cannot have more axes.
constexpr int kLongestChain = 65536;

/// Strength of the stop reaction of MC_Stop: emergency stop over maximum dynamics over given dynamics.
int stop_rank(DINT mode) noexcept {
  return mode == 0 ? 3 : mode == 2 ? 2 : 1;
}

bool is_synchronous(JobKind kind) noexcept {
  return kind == JobKind::MC_GearIn || kind == JobKind::MC_GearInPos;
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
  if (const ErrorId error = check(job); error != ErrorId::none) return job.fail(error);
  if (const int alarm_number = missing_precondition(job); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  if (!override_running(class_of(job, false), job)) return;
  install(job);
}

/// Whether the state of the axis permits the job at all.
ErrorId Axis::check(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_Home) {
    if (!position_controlled_) return ErrorId::not_position_controlled;
    const Job* base = running_[kBase];
    const bool coupled = base != nullptr && base->kind == JobKind::MC_GearInPos;
    return coupled ? ErrorId::homing_while_coupled : ErrorId::none;
  }
  if (pending_alarm() != 0) return ErrorId::technology_alarm;
  if (!enabled()) return ErrorId::locked;
  if (locked_by_stop() && job.kind != JobKind::MC_Stop) return ErrorId::locked;
  if (!is_synchronous(job.kind)) return ErrorId::none;
  if (job.master == this) return ErrorId::recursive_coupling;
  // A waiting job couples nothing yet; it is looked at again when it would become active.
  const bool recursive = job.kind == JobKind::MC_GearIn && led_by_this(job.master);
  return recursive ? ErrorId::recursive_coupling : ErrorId::none;
}

/// Preconditions whose absence is a technology alarm; 0: none is missing.
int Axis::missing_precondition(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MoveAbsolute && !homed_) return alarm::kNotHomed;
  if (!is_synchronous(job.kind)) return 0;
  const LeadingValue* leading = find_leading_value(job.master);
  if (leading == nullptr) return alarm::kLeadingAxis;
  const bool controlled = job.master->position_controlled() || leading->coupling == Coupling::actual;
  return controlled ? 0 : alarm::kLeadingAxisNotPositionControlled;
}

bool Axis::led_by_this(const Axis* axis) const noexcept {
  for (int i = 0; axis != nullptr && i < kLongestChain; ++i) {
    if (axis == this) return true;
    axis = axis->coupled_leading_axis();
  }
  return false;
}

const LeadingValue* Axis::find_leading_value(const Axis* master) const noexcept {
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
      job.fail(ErrorId::locked);
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
    case JobKind::MC_GearInPos:
      begin_waiting(job);
      break;
    case JobKind::MC_GearIn:
      begin_gear_in(job);
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
  const bool stopping = job->kind == JobKind::MC_Stop && phase == JobPhase::failed;
  job->phase = stopping ? JobPhase::aborted : phase;  // an alarm shows at MC_Stop as CommandAborted
  job->error = stopping ? ErrorId::none : error;
  if (slot == kWaiting) {
    data.StatusSynchronizedMotion.WaitingFunctionState = 0;
    coupling_changed = true;
  }
}

void Axis::end_all_jobs(JobPhase phase, ErrorId error) noexcept {
  for (std::size_t slot = 0; slot < kSlots; ++slot) end_job(static_cast<Slot>(slot), phase, error);
  for (std::size_t i = 0; i < new_count_; ++i) {
    new_jobs_[i]->phase = phase;
    new_jobs_[i]->error = error;
  }
  new_count_ = 0;
  stop_ = nullptr;
}

/// Direct homing: setpoint and actual position are shifted together; nothing moves.
void Axis::home(Job& job) noexcept {
  const double by = job.mode == 0 ? position_shift(job.position) : job.position;
  if (!std::isfinite(by)) return job.fail(ErrorId::position);
  shift_positions(by);
  if (job.mode == 0 && !has_drive_) {
    // A virtual axis has no following error: the position is the given one to the last bit.
    const AxisPosition exact = normalised({setpoint_.position.turns, job.position}, modulo_);
    setpoint_.position.value = exact.value;
    if (setpoint_.standing() && motion_ == Motion::single_axis && running_[kBase] == nullptr)
      single_.stand(setpoint_);
    actual_ = setpoint_.position;
  }
  homed_ = true;
  job.phase = JobPhase::done;
}

/// Way from the actual position to a home position; on a ring the shorter one.
double Axis::position_shift(double home_position) const noexcept {
  return shortest_distance(actual_.value, home_position, modulo_);
}

void Axis::shift_positions(double by) noexcept {
  setpoint_.position = advanced(setpoint_.position, by, modulo_);
  last_setpoint_.position = advanced(last_setpoint_.position, by, modulo_);
  actual_ = advanced(actual_, by, modulo_);
  shown_actual_ = advanced(shown_actual_, by, modulo_);
  single_.shift(by);
  synchronous_.shift_following(by);
  if (has_drive_) shift_servo(by);
}

}  // namespace lockstep
