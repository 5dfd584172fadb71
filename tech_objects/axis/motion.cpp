// Motion of an axis of its own: positioning, endless motion, jogging and stopping.
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/target_distance.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// The position at which a job has its target; nullptr: it is a distance away.
const LREAL* target_position(const Job& job) noexcept {
  if (job.kind == JobKind::MC_Home) return &job.as<HomingJob>().position;
  return job.kind == JobKind::MC_MoveAbsolute ? &job.as<MoveAbsoluteJob>().position : nullptr;
}

/// Whether two jobs of MC_MoveJog ask for the same motion.
bool same_motion(const Job& one, const Job& other) noexcept {
  return one.as<JogJob>().direction == other.as<JogJob>().direction && one.velocity == other.velocity &&
         one.acceleration == other.acceleration && one.deceleration == other.deceleration &&
         one.jerk == other.jerk;
}

}  // namespace

// ---- Dynamics
// ---------------------------------------------------------------------------------------------------

/// Dynamic values of a job, cut to the limits with a warning.
Dynamics AxisOrders::effective_dynamics(const Job& job) noexcept {
  const ExceededLimits exceeded = limits_.exceeded(job);
  if (exceeded.velocity) raise(alarm::kVelocityLimited);
  if (exceeded.acceleration) raise(alarm::kAccelerationLimited);
  if (exceeded.jerk) raise(alarm::kJerkLimited);
  return limits_.effective(job);
}

/// Dynamic values for a motion of the axis' own that takes over from the present state, below the velocity
/// limit.
Dynamics AxisOrders::own_dynamics(const Job& job) noexcept {
  Dynamics dynamics = effective_dynamics(job);
  limits_.keep_below(dynamics, setpoint_.acceleration, room_to_limit());
  return dynamics;
}

/// Velocity that is left, in the direction of the present acceleration, up to the limit [u/s] ≥ 0; to a base
/// motion beside what is superimposed.
double AxisOrders::room_to_limit() const noexcept {
  const double direction = setpoint_.acceleration < 0.0 ? -1.0 : 1.0;
  return limits_.margin(setpoint_,
                        superimposed_.advancing_base() ? superimposed_.maximum_velocity(direction) : 0.0);
}

// ---- Beginning a motion
// -----------------------------------------------------------------------------------------

void AxisOrders::begin_base_motion(Job& job) noexcept {
  absorb_superimposed();
  cut_acceleration();
  Dynamics dynamics = own_dynamics(job);
  if (job.kind == JobKind::MC_Stop && job.as<StopJob>().mode == StopMode::emergency_ramp)
    dynamics.jerk = 0.0;  // the emergency ramp has none
  if (const int alarm_number = limits_.zero_limit(dynamics); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  jobs_.put(kBase, job, JobPhase::active);
  leave_synchronous();
  motion_ = Motion::single_axis;
  emergency_ramp_ = EmergencyRamp::none;
  arrival_.begin();
  limits_.remember();
  if (job.kind != JobKind::MC_Halt && job.kind != JobKind::MC_Stop)
    set_position_control(job.position_controlled);
  // One that has waited for another one is refused only now, when it is known where it begins.
  ErrorId error = target_refusal(job);
  if (error == ErrorId::none && plan(job, dynamics) == PlanResult::ok) return;
  if (error == ErrorId::none) error = ErrorId::unspecified;
  end_job(kBase, JobPhase::failed, error);
  begin_stop(limits_.maximum(), false);
}

/// Whether a job would leave the range of positions by where it ends, begun at this moment. On a ring every
/// place is inside; targets themselves are checked where they come in.
ErrorId AxisOrders::target_refusal(const Job& job) const noexcept {
  if (modulo_.enabled) return ErrorId::none;
  double from = setpoint_.position.value;
  switch (job.kind) {
    case JobKind::MC_MoveRelative:
      from -= beyond_target_.rounded();
      break;
    case JobKind::MC_MoveSuperimposed: {
      const bool positions =
          motion_ == Motion::single_axis && single_.aim() == SingleAxisMotion::Aim::position;
      const AxisPosition& base = positions ? single_.target() : base_setpoint().position;
      from = base.value + superimposed_.value().rounded();
      break;
    }
    default:
      return ErrorId::none;
  }
  return std::abs(from + job.as<DistanceJob>().distance) <= kPositionRange ? ErrorId::none
                                                                           : ErrorId::distance;
}

PlanResult AxisOrders::plan(Job& job, const Dynamics& dynamics) noexcept {
  switch (job.kind) {
    case JobKind::MC_MoveAbsolute:
      return move_by(
          absolute_distance(job.as<MoveAbsoluteJob>(), setpoint_, beyond_target_, dynamics, modulo_), job,
          dynamics);
    case JobKind::MC_MoveRelative:
      return move_by(DoubleDouble{job.as<DistanceJob>().distance, 0.0} - beyond_target_, job, dynamics);
    case JobKind::MC_MoveVelocity: {
      auto& asked = job.as<VelocityJob>();
      if (asked.current) {  // from now on a velocity like any other, of which the override is part already
        const double own = data.Override.Velocity / 100.0;
        asked.current = false;
        job.velocity = own > 0.0 ? setpoint_.velocity / own : setpoint_.velocity;
        if (own > 0.0) return single_.run_at(setpoint_, setpoint_.velocity, maximum_for_current(dynamics));
      }
      return single_.run_at(setpoint_, std::copysign(dynamics.velocity, job.velocity), dynamics);
    }
    case JobKind::MC_Home:
      return plan_homing(job, dynamics);
    case JobKind::MC_MoveJog:
      jogged_ = job;
      return single_.run_at(setpoint_, dynamics.velocity * job.as<JogJob>().direction, dynamics);
    case JobKind::MC_Stop:
      jobs_.lock(job);
      if (job.as<StopJob>().mode == StopMode::emergency_ramp) ask_for_emergency_ramp();
      [[fallthrough]];
    default:  // MC_Halt
      return plan_stop(job.as<StopJob>(), dynamics);
  }
}

PlanResult AxisOrders::plan_stop(const StopJob& asked, const Dynamics& given) noexcept {
  switch (asked.mode) {
    case StopMode::emergency_ramp:
      return single_.stop(setpoint_, limits_.emergency(), asked.abort_acceleration);
    case StopMode::maximum_dynamics:
      return single_.stop(setpoint_, limits_.maximum(), asked.abort_acceleration);
    default:
      return single_.stop(setpoint_, given, asked.abort_acceleration);
  }
}

/// The velocity held by Current may be the one of a synchronous motion, beyond the limit of the axis' own
/// motion: then it comes down to that.
Dynamics AxisOrders::maximum_for_current(Dynamics dynamics) const noexcept {
  dynamics.velocity = limits_.velocity();
  return dynamics;
}

void AxisOrders::show_target(const AxisPosition& target) noexcept {
  data.StatusPositioning.TargetPosition = target.value;
  data.StatusPositioning.TargetPositionModuloCycle = static_cast<DINT>(target.turns - counted_from_);
}

PlanResult AxisOrders::move_by(DoubleDouble exact_way, const Job& job, const Dynamics& dynamics) noexcept {
  const double way = exact_way.rounded();
  AxisPosition target = advanced(setpoint_.position, exact_way, modulo_);
  if (const LREAL* const given = target_position(job)) {
    // The way is rounded; the target is the given position itself.
    target.value = modulo_.enabled ? normalised({0, *given}, modulo_).value : *given;
  }
  show_target(target);
  if (dynamics.velocity > 0.0) return single_.move_to(setpoint_, target, way, dynamics);
  Dynamics crawl = dynamics;  // an override of 0 %: plan with the least velocity, then hold at once
  crawl.velocity = limits_.velocity();
  const PlanResult result = single_.move_to(setpoint_, target, way, crawl);
  return result == PlanResult::ok ? single_.replan(setpoint_, dynamics) : result;
}

void AxisOrders::begin_stop(const Dynamics& dynamics, bool abort_acceleration) noexcept {
  absorb_superimposed();
  leave_synchronous();
  motion_ = Motion::single_axis;
  cut_acceleration();
  if (single_.stop(setpoint_, dynamics, abort_acceleration) == PlanResult::ok) return;
  setpoint_.velocity = 0.0;  // no ramp can be planned from such a state: stand
  setpoint_.acceleration = 0.0;
  single_.stand(setpoint_);
}

// ---- One cycle
// --------------------------------------------------------------------------------------------------

void AxisOrders::step_single_axis() noexcept {
  Job* job = jobs_[kBase];
  if (job != nullptr && (limits_.changed() || job->kind == JobKind::MC_MoveJog)) follow_changes(*job);
  single_.advance(setpoint_);
  if (superimposed_.advancing_base()) add_superimposed();
  if (jobs_[kBase] != nullptr) watch_base_job(*jobs_[kBase]);
  if (jobs_[kBuffered] != nullptr) watch_buffered();
}

/// Limits and override count at once; so do the inputs of a jogging block. Seldom: not part of every cycle.
[[gnu::noinline]] void AxisOrders::follow_changes(Job& job) noexcept {
  const bool jog = job.kind == JobKind::MC_MoveJog;
  const bool inputs_changed = jog && !same_motion(job, jogged_);
  if (!inputs_changed && !limits_.changed()) return;
  if (job.kind == JobKind::MC_Stop || job.kind == JobKind::MC_Halt || leaves(job.kind)) return;
  limits_.remember();
  const Dynamics wanted = effective_dynamics(job);
  if (const int alarm_number = limits_.zero_limit(wanted); alarm_number != 0) return raise(alarm_number);
  const double jerk_before = single_.dynamics().jerk;
  const bool jerk_now_limited = jerk_before <= 0.0 && wanted.jerk > 0.0;
  if (inputs_changed || jerk_now_limited) cut_acceleration();
  Dynamics dynamics = own_dynamics(job);
  dynamics.jerk =
      MotionLimits::sufficient_jerk(dynamics.jerk, jerk_before, setpoint_.acceleration, room_to_limit());
  if (superimposed_.advancing_base()) leave_to_superimposed(&job, dynamics);
  PlanResult result = PlanResult::ok;
  if (jog || job.kind == JobKind::MC_Home || job.kind == JobKind::MC_MoveVelocity) {
    result = plan(job, dynamics);
  } else if (!single_.finished() || single_.aim() != SingleAxisMotion::Aim::position) {
    result = single_.replan(setpoint_, dynamics);
  }
  if (jobs_[kBuffered] != nullptr && result == PlanResult::ok) plan_blending();
  if (job.phase == JobPhase::reached) job.phase = JobPhase::active;
  if (result == PlanResult::ok) return;
  end_job(kBase, JobPhase::failed, ErrorId::unspecified);
  begin_stop(limits_.maximum(), false);
}

void AxisOrders::watch_base_job(Job& job) noexcept {
  const bool passes = single_.aim() == SingleAxisMotion::Aim::position && single_.target_velocity() != 0.0;
  if (!single_.finished() || passes) return;
  switch (job.kind) {
    case JobKind::MC_MoveVelocity:
      job.phase = JobPhase::reached;
      break;
    case JobKind::MC_MoveJog:
      if (job.as<JogJob>().direction != 0) {
        job.phase = JobPhase::reached;
      } else {
        end_job(kBase, JobPhase::done, ErrorId::none);
      }
      break;
    case JobKind::MC_Home:
      if (!homing_.travels()) break;
      [[fallthrough]];
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:
    case JobKind::MC_GearOut:
    case JobKind::MC_CamOut:
      watch_positioning();
      break;
    default:
      watch_standstill();
      break;
  }
}

/// Alarm 541 where a positioning misses its window.
void AxisOrders::watch_positioning() noexcept {
  // While a superimposed motion goes on, the axis cannot be there; its base motion has come to rest.
  const double distance =
      superimposed_.resting() ? std::abs(rounded_difference(actual_, setpoint_.position, modulo_)) : 0.0;
  const bool monitored = !(has_drive_ && position_monitoring_off());
  take_arrival(arrival_.watch_position(distance, data.PositioningMonitoring, monitored));
}

void AxisOrders::take_arrival(Arrival::Verdict verdict) noexcept {
  if (verdict == Arrival::Verdict::arrived) end_job(kBase, JobPhase::done, ErrorId::none);
  if (verdict == Arrival::Verdict::missed) raise(alarm::kPositioning);
}

/// A stop under position control is done when the actual position has settled as well. A drive whose torque
/// is limited may never get there: MC_Halt is done when the axis has stood for the dwell time.
void AxisOrders::watch_standstill() noexcept {
  const bool settled = !has_drive_ || !moving(actual_velocity_);
  const bool halts = position_controlled_ && jobs_[kBase]->kind == JobKind::MC_Halt;
  const bool limited = has_drive_ && position_monitoring_off();
  if (halts && !limited) {
    if (settled) watch_positioning();
    return;
  }
  take_arrival(arrival_.watch_rest(settled, halts, data.PositioningMonitoring.MinDwellTime));
}

}  // namespace lockstep
