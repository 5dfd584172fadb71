// Motion of an axis that another one leads.
#include <cmath>

#include "tech_objects/axis.hpp"

namespace lockstep {
namespace {

/// Value of StatusSynchronizedMotion.FunctionState and WaitingFunctionState for a job.
DINT function_state(JobKind kind) noexcept {
  return kind == JobKind::MC_GearIn ? 1 : 2;
}

}  // namespace

void Axis::begin_gear_in(Job& job) noexcept {
  const Dynamics dynamics = effective_dynamics(job);
  if (const int alarm_number = zero_limit(dynamics); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  running_[kBase] = &job;
  job.phase = JobPhase::active;
  position_controlled_ = true;
  synchronous_.begin_gear_in(*find_leading_value(job.master), job, dynamics);
  show_coupling(job, Motion::synchronizing);
}

void Axis::begin_waiting(Job& job) noexcept {
  const Dynamics dynamics = effective_dynamics(job);
  const ErrorId error = awaited_.begin_waiting(*find_leading_value(job.master), job, dynamics, setpoint_);
  if (error != ErrorId::none) return job.fail(error);
  running_[kWaiting] = &job;
  job.phase = JobPhase::waiting;
  data.StatusSynchronizedMotion.WaitingFunctionState = function_state(job.kind);
  coupling_changed = true;
}

/// Each tick while a synchronous job waits: has the leading value met the start?
void Axis::watch_waiting() noexcept {
  switch (awaited_.watch(setpoint_)) {
    case SynchronousMotion::Start::not_yet:
      break;
    case SynchronousMotion::Start::rejected:
      end_job(kWaiting, JobPhase::failed, awaited_.rejection());
      break;
    case SynchronousMotion::Start::synchronizing:
      activate_waiting(Motion::synchronizing);
      break;
    case SynchronousMotion::Start::synchronous:
      activate_waiting(Motion::synchronous);
      break;
  }
}

/// The waiting job becomes active: now it overrides what moves the axis.
void Axis::activate_waiting(Motion motion) noexcept {
  Job& job = *running_[kWaiting];
  if (!awaited_axis_in_order || led_by_this(job.master))
    return end_job(kWaiting, JobPhase::failed, ErrorId::recursive_coupling);
  if (locked_by_stop()) return end_job(kWaiting, JobPhase::failed, ErrorId::locked);
  running_[kWaiting] = nullptr;
  data.StatusSynchronizedMotion.WaitingFunctionState = 0;
  if (!override_running(class_of(job, true), job)) {
    coupling_changed = true;
    return;
  }
  running_[kBase] = &job;
  job.phase = motion == Motion::synchronous ? JobPhase::reached : JobPhase::active;
  position_controlled_ = true;
  synchronous_ = awaited_;
  show_coupling(job, motion);
}

void Axis::show_coupling(const Job& job, Motion motion) noexcept {
  motion_ = motion;
  coupling_changed = true;
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionState = function_state(job.kind);
  status.ActualMaster = job.master->number;
  status.PhaseShift = 0.0;
  status.Offset = 0.0;
}

void Axis::step_synchronous() noexcept {
  synchronous_.advance(setpoint_);
  if (motion_ == Motion::synchronous) return;
  Job* job = running_[kBase];
  if (synchronous_.reversed()) {
    setpoint_ = last_setpoint_;  // the stop begins at the last setpoint that followed
    raise(alarm::kSynchronizing);
    return step_single_axis();
  }
  if (!synchronous_.synchronous()) return;
  motion_ = Motion::synchronous;
  job->phase = JobPhase::reached;
}

void Axis::leave_synchronous() noexcept {
  if (motion_ != Motion::synchronizing && motion_ != Motion::synchronous) return;
  synchronous_.end();
  motion_ = Motion::single_axis;
  coupling_changed = true;
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionState = 0;
  status.ActualMaster = DB_ANY{};
  status.StatusWord = DWORD{};
}

}  // namespace lockstep
