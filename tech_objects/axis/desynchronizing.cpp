// Out of a synchronous motion: MC_GearOut, and the simulation of a synchronous motion.
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/synchronous_request.hpp"
#include "tech_objects/jobs/function_state.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// Turns by which a position has to be moved to lie next to a place.
std::int64_t turns_between(AxisPosition position, AxisPosition place, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return 0;
  const double apart = position.value - place.value;
  const std::int64_t over_the_end = apart > 0.5 * modulo.length ? -1 : apart < -0.5 * modulo.length ? 1 : 0;
  return place.turns - position.turns + over_the_end;
}

}  // namespace

// ---- MC_GearOut, MC_CamOut
// -------------------------------------------------------------------------------------------------

/// What waits has been cancelled by the override rules; an active gear (cam) is left when the start is met.
void AxisOrders::begin_sync_out(Job& job) noexcept {
  const Job* base = jobs_[kBase];
  const bool follows = base != nullptr && led() && of_cam(base->kind) == of_cam(job.kind);
  if (job.mode == kCancelWaiting || !follows) {
    job.phase = JobPhase::done;
    return;
  }
  jobs_.put(kWaitingOut, job, JobPhase::waiting);
  data.StatusSynchronizedMotion.WaitingFunctionState =
      waiting_function_state(jobs_[kWaiting], jobs_[kWaitingOut]);
}

/// Each tick while desynchronizing waits; true if it has begun and the setpoint is made. It looks at where
/// the axis is with all that is superimposed.
bool AxisOrders::watch_sync_out(const Setpoint& candidate) noexcept {
  Job& job = *jobs_[kWaitingOut];
  Dynamics dynamics = effective_dynamics(job);
  const double target = normalised({0, job.position}, modulo_).value;
  const bool there = candidate.standing() && last_setpoint_.standing() && candidate.position.value == target;
  Setpoint from = last_setpoint_;
  Setpoint to = candidate;
  if (job.mode != ProfileReference::over_distance) {  // begins as the axis' own motions do
    if (const int alarm_number = limits_.zero_limit(dynamics); alarm_number != 0) {
      raise(alarm_number);  // the stop begins at the last setpoint that followed
      step_single_axis();
      return true;
    }
    from.acceleration = limits_.tolerable_acceleration(from.acceleration, limits_.margin(from));
    to.acceleration = limits_.tolerable_acceleration(to.acceleration, limits_.margin(to));
    limits_.keep_below(dynamics, from.acceleration, limits_.margin(from));
  }
  if (!there && !synchronous_.meets_start_of_leaving(leaving_request(job), from, to, dynamics)) return false;
  jobs_.take(kWaitingOut);
  data.StatusSynchronizedMotion.WaitingFunctionState =
      waiting_function_state(jobs_[kWaiting], jobs_[kWaitingOut]);
  if (!override_running(class_of(job, true), job)) return false;
  absorb_superimposed();
  jobs_.put(kBase, job, JobPhase::active);
  arrival_.begin();
  if (there) {
    leave_synchronous();
    single_.stand(setpoint_);
    step_single_axis();
  } else {
    activate_sync_out(job, dynamics);
  }
  return true;
}

/// From the setpoint of the last tick: over the leading distance, or with the dynamics of the job.
void AxisOrders::activate_sync_out(Job& job, const Dynamics& dynamics) noexcept {
  if (job.mode == ProfileReference::over_distance) {
    synchronous_.begin_leaving(setpoint_);
    motion_ = Motion::desynchronizing;
    auto& status = data.StatusSynchronizedMotion;
    status.FunctionState = function_state(job.kind);
    status.PhaseShift = status.Offset = 0.0;
    return step_synchronous();
  }
  const double way = synchronous_.leaving().stop_distance();
  const AxisPosition position = synchronous_.leaving().position();
  leave_synchronous();
  cut_acceleration();
  data.StatusSynchronizedMotion.FunctionState = function_state(job.kind);
  Dynamics own = dynamics;
  own.acceleration = own.deceleration;
  own.velocity = std::max(own.velocity, std::abs(setpoint_.velocity));
  if (single_.move_to(setpoint_, position, way, own) != PlanResult::ok) {
    end_job(kBase, JobPhase::failed, ErrorId::unspecified);
    return begin_stop(limits_.maximum(), false);
  }
  step_single_axis();
}

/// The following axis has come to rest at its stop position.
void AxisOrders::end_desynchronizing() noexcept {
  leave_synchronous();
  data.StatusSynchronizedMotion.FunctionState = function_state(jobs_[kBase]->kind);
  setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  single_.stand(setpoint_);
}

// ---- MC_SynchronizedMotionSimulation
// ----------------------------------------------------------------------------

void AxisOrders::watch_simulation() noexcept {
  SimulationRequest& request = simulation_request;
  request.error = ErrorId::none;
  if (request.enable && !simulating()) begin_simulation();
  if (!request.enable && simulating()) end_simulation();
  if (simulating()) {
    look_at_coupling(*simulated_);
    synchronous_.advance(ghost_);
    show_passes();
  }
  if (!request.enable && !simulating()) request.owner = nullptr;
}

/// A cam that is passed again and again shows its ends in simulation as well.
void AxisOrders::show_passes() noexcept {
  if (!synchronous_.at_cam_end() || synchronous_.passed_once()) return;
  ++simulated_->ends;
  synchronous_.clear_cam_end();
}

/// Whether a setpoint of the coupling stands; one that follows measured values does within the standstill
/// signal.
bool AxisOrders::coupling_stands(const Setpoint& setpoint) const noexcept {
  return setpoint.standing() || (synchronous_.follows_actual_value() && !moving(setpoint.velocity));
}

/// The gear goes on without the axis: only while it is synchronous and the leading axis stands. The axis has
/// to stand as well: it may still brake with the last tick, or be shifted by an offset.
void AxisOrders::begin_simulation() noexcept {
  const bool leading_stands = led() && coupled_.leading->leading_value_stands();
  if (motion_ != Motion::synchronous || !leading_stands || !coupling_stands(base_setpoint())) {
    simulation_request.error = ErrorId::no_synchronous_operation;
    return;
  }
  simulated_ = jobs_[kBase];
  jobs_.take(kBase);
  ghost_ = base_setpoint();
  motion_ = Motion::single_axis;
  single_.stand(base_setpoint());
}

/// What forbids that the setpoints of the coupling count again. They have to agree with those of the axis:
/// both stand, at the same place. On a ring the turns that one of them has made meanwhile do not count, and a
/// velocity gear has no place.
ErrorId AxisOrders::check_end_of_simulation() const noexcept {
  if (!enabled() || jobs_.locked()) return ErrorId::locked;
  const Setpoint own = base_setpoint();
  if (!own.standing() || !coupling_stands(ghost_)) return ErrorId::position;
  if (simulated_->kind == JobKind::MC_GearInVelocity) return ErrorId::none;
  // Position control is taken up where the axis is.
  const double place = has_drive_ && !position_controlled_ ? actual_.value : own.position.value;
  const double away = std::abs(shortest_distance(place, ghost_.position.value, modulo_));
  return away <= data.PositioningMonitoring.Window ? ErrorId::none : ErrorId::position;
}

/// The setpoints of the coupling count again, with its position control.
void AxisOrders::end_simulation() noexcept {
  simulation_request.error = check_end_of_simulation();
  if (simulation_request.error != ErrorId::none) return;
  end_job(kBase, JobPhase::aborted, ErrorId::none);
  set_position_control(simulated_->position_controlled);
  synchronous_.turn_following(turns_between(ghost_.position, base_setpoint().position, modulo_));
  jobs_.put_back(kBase, *simulated_);
  simulated_ = nullptr;
  motion_ = Motion::synchronous;
}

void AxisOrders::end_simulated_gear(JobPhase phase, ErrorId error) noexcept {
  if (simulated_ == nullptr) return;
  simulated_->phase = phase;
  simulated_->error = error;
  simulated_ = nullptr;
  forget_coupling();
}

}  // namespace lockstep
