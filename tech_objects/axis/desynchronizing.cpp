#include "tech_objects/axis/desynchronizing.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/axis/synchronous_request.hpp"
#include "tech_objects/jobs/function_state.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

void LeavingOrders::begin(Job& job) noexcept {
  const Job* base = jobs_[kBase];
  const bool follows = base != nullptr && led(motion_) && of_cam(base->kind) == of_cam(job.kind);
  if (job.as<LeavingJob>().profile == SyncOutProfileReference::cancel_waiting || !follows) {
    job.phase = JobPhase::done;
    return;
  }
  jobs_.put(kWaitingOut, job, JobPhase::waiting);
  ends_.show_waiting();
}

LeavingOrders::Next LeavingOrders::watch(const Setpoint& candidate) noexcept {
  Job& job = *jobs_[kWaitingOut];
  const auto& asked = job.as<LeavingJob>();
  Dynamics dynamics = dynamics_.effective(job);
  const double target = normalised({0, asked.position}, modulo_).value;
  const bool there = candidate.standing() && last_setpoint_.standing() && candidate.position.value == target;
  Setpoint from = last_setpoint_;
  Setpoint to = candidate;
  if (asked.profile != SyncOutProfileReference::over_distance) {  // begins as the axis' own motions do
    if (const ZeroLimit zero = limits_.zero_limit(dynamics); zero.alarm != 0) {
      reactions_.raise(zero.alarm, zero.detail);  // the stop begins at the last setpoint that followed
      return Next::own_motion;
    }
    from.acceleration = limits_.tolerable_acceleration(from.acceleration, limits_.margin(from));
    to.acceleration = limits_.tolerable_acceleration(to.acceleration, limits_.margin(to));
    limits_.keep_below(dynamics, from.acceleration, limits_.margin(from));
  }
  if (!there && !synchronous_.meets_start_of_leaving(leaving_request(asked), from, to, dynamics))
    return Next::coupling;
  jobs_.take(kWaitingOut);
  ends_.show_waiting();
  if (!ends_.override_running(class_of(job, true), job)) return Next::coupling;
  stops_.absorb_superimposed();
  jobs_.put(kBase, job, JobPhase::active);
  arrival_.begin();
  if (!there) return activate(job, dynamics);
  coupling_.leave();
  single_.stand(setpoint_);
  return Next::own_motion;
}

/// From the setpoint of the last tick: over the leading distance, or with the dynamics of the job.
LeavingOrders::Next LeavingOrders::activate(Job& job, const Dynamics& dynamics) noexcept {
  if (job.as<LeavingJob>().profile == SyncOutProfileReference::over_distance) {
    synchronous_.begin_leaving(setpoint_);
    motion_ = AxisMotion::desynchronizing;
    auto& status = data.StatusSynchronizedMotion;
    status.FunctionState = function_state(job.kind);
    status.PhaseShift = status.Offset = 0.0;
    return Next::distance_out;
  }
  const double distance = synchronous_.leaving().stop_distance();
  const AxisPosition position = synchronous_.leaving().position();
  coupling_.leave();
  stops_.cut_acceleration();
  data.StatusSynchronizedMotion.FunctionState = function_state(job.kind);
  Dynamics own = dynamics;
  own.acceleration = own.deceleration;
  own.velocity = std::max(own.velocity, std::abs(setpoint_.velocity));
  if (single_.move_to(setpoint_, position, distance, own) != PlanResult::ok) {
    ends_.end(kBase, JobPhase::failed, ErrorId::unspecified);
    stops_.begin(limits_.maximum(), false);
    return Next::nothing;
  }
  return Next::own_motion;
}

void LeavingOrders::end() noexcept {
  coupling_.leave();
  data.StatusSynchronizedMotion.FunctionState = function_state(jobs_[kBase]->kind);
  stops_.stand();
}

}  // namespace lockstep
