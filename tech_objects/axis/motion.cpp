#include "tech_objects/axis/motion.hpp"

#include <algorithm>
#include <cmath>

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

// ---- Beginning a motion

void MotionOrders::begin(Job& job) noexcept {
  stops_.absorb_superimposed();
  stops_.cut_acceleration();
  Dynamics dynamics = dynamics_.own(job);
  if (job.kind == JobKind::MC_Stop && job.as<StopJob>().mode == StopMode::emergency_ramp)
    dynamics.jerk = 0.0;  // the emergency ramp has none
  if (const ZeroLimit zero = limits_.zero_limit(dynamics); zero.alarm != 0) {
    reactions_.raise(zero.alarm, zero.detail);
    return job.fail(ErrorId::technology_alarm);
  }
  jobs_.put(kBase, job, JobPhase::active);
  coupling_.leave();
  motion_ = AxisMotion::single_axis;
  emergency_ramp_ = EmergencyRamp::none;
  arrival_.begin();
  limits_.remember();
  if (job.kind != JobKind::MC_Halt && job.kind != JobKind::MC_Stop)
    position_control_.set(job.position_controlled);
  // One that has waited for another one is refused only now, when it is known where it begins.
  ErrorId error = refusal(job);
  if (error == ErrorId::none && plan(job, dynamics) == PlanResult::ok) return;
  if (error == ErrorId::none) error = ErrorId::unspecified;
  ends_.end(kBase, JobPhase::failed, error);
  stops_.begin(limits_.maximum(), false);
}

ErrorId MotionOrders::refusal(const Job& job) const noexcept {
  if (modulo_.enabled) return ErrorId::none;
  double from = setpoint_.position.value;
  switch (job.kind) {
    case JobKind::MC_MoveRelative:
      from -= beyond_target_.rounded();
      break;
    case JobKind::MC_MoveSuperimposed: {
      const bool positions =
          motion_ == AxisMotion::single_axis && single_.aim() == SingleAxisMotion::Aim::position;
      const AxisPosition& base = positions ? single_.target() : superimposed_.base_of(setpoint_).position;
      from = base.value + superimposed_.value().rounded();
      break;
    }
    default:
      return ErrorId::none;
  }
  return std::abs(from + job.as<DistanceJob>().distance) <= kPositionRange ? ErrorId::none
                                                                           : ErrorId::distance;
}

PlanResult MotionOrders::plan(Job& job, const Dynamics& dynamics) noexcept {
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
      if (job.as<StopJob>().mode == StopMode::emergency_ramp) power_.ask_for_emergency_ramp();
      [[fallthrough]];
    default:  // MC_Halt
      return plan_stop(job.as<StopJob>(), dynamics);
  }
}

PlanResult MotionOrders::plan_stop(const StopJob& asked, const Dynamics& given) noexcept {
  switch (asked.mode) {
    case StopMode::emergency_ramp:
      return single_.stop(setpoint_, limits_.emergency(), asked.abort_acceleration);
    case StopMode::maximum_dynamics:
      return single_.stop(setpoint_, limits_.maximum(), asked.abort_acceleration);
    default:
      return single_.stop(setpoint_, given, asked.abort_acceleration);
  }
}

PlanResult MotionOrders::plan_homing(const Job& job, const Dynamics& dynamics) noexcept {
  const auto& asked = job.as<HomingJob>();
  if (!homing_.travels()) return single_.run_at(setpoint_, asked.direction * dynamics.velocity, dynamics);
  return move_by(to_double_double(shortest_distance(setpoint_.position.value, asked.position, modulo_)), job,
                 dynamics);
}

/// The velocity held by Current may be the one of a synchronous motion, beyond the limit of the axis' own
/// motion: then it comes down to that.
Dynamics MotionOrders::maximum_for_current(Dynamics dynamics) const noexcept {
  dynamics.velocity = limits_.velocity();
  return dynamics;
}

void MotionOrders::show_target(const AxisPosition& target) noexcept {
  data.StatusPositioning.TargetPosition = target.value;
  data.StatusPositioning.TargetPositionModuloCycle = static_cast<DINT>(target.turns - counted_from_);
}

PlanResult MotionOrders::move_by(DoubleDouble exact_distance, const Job& job,
                                 const Dynamics& dynamics) noexcept {
  const double distance = exact_distance.rounded();
  AxisPosition target = advanced(setpoint_.position, exact_distance, modulo_);
  if (const LREAL* const given = target_position(job)) {
    // The distance is rounded; the target is the given position itself.
    target.value = modulo_.enabled ? normalised({0, *given}, modulo_).value : *given;
  }
  show_target(target);
  if (dynamics.velocity > 0.0) return single_.move_to(setpoint_, target, distance, dynamics);
  Dynamics crawl = dynamics;  // an override of 0 %: plan with the minimum velocity, then hold at once
  crawl.velocity = limits_.velocity();
  const PlanResult result = single_.move_to(setpoint_, target, distance, crawl);
  return result == PlanResult::ok ? single_.replan(setpoint_, dynamics) : result;
}

// ---- One cycle

void MotionOrders::follow_changes(Job& job) noexcept {
  const bool jog = job.kind == JobKind::MC_MoveJog;
  const bool inputs_changed = jog && !same_motion(job, jogged_);
  if (!inputs_changed && !limits_.changed()) return;
  if (job.kind == JobKind::MC_Stop || job.kind == JobKind::MC_Halt || leaves(job.kind)) return;
  limits_.remember();
  const Dynamics wanted = dynamics_.effective(job);
  if (const ZeroLimit zero = limits_.zero_limit(wanted); zero.alarm != 0)
    return reactions_.raise(zero.alarm, zero.detail);
  const double jerk_before = single_.dynamics().jerk;
  const bool jerk_now_limited = jerk_before <= 0.0 && wanted.jerk > 0.0;
  if (inputs_changed || jerk_now_limited) stops_.cut_acceleration();
  Dynamics dynamics = dynamics_.own(job);
  dynamics.jerk = MotionLimits::sufficient_jerk(dynamics.jerk, jerk_before, setpoint_.acceleration,
                                                stops_.margin_to_limit());
  if (superimposed_.advancing_base()) dynamics_.leave_to_superimposed(&job, dynamics);
  PlanResult result = PlanResult::ok;
  if (jog || job.kind == JobKind::MC_Home || job.kind == JobKind::MC_MoveVelocity) {
    result = plan(job, dynamics);
  } else if (!single_.finished() || single_.aim() != SingleAxisMotion::Aim::position) {
    result = single_.replan(setpoint_, dynamics);
  }
  if (jobs_[kBuffered] != nullptr && result == PlanResult::ok) junction_.plan();
  if (job.phase == JobPhase::reached) job.phase = JobPhase::active;
  if (result == PlanResult::ok) return;
  ends_.end(kBase, JobPhase::failed, ErrorId::unspecified);
  stops_.begin(limits_.maximum(), false);
}

}  // namespace lockstep
