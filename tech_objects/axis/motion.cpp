// Motion of an axis of its own: positioning, endless motion, jogging and stopping.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {
namespace {

/// Highest deceleration that a data block can hold [u/s²]: what is left when no limit is configured.
/// @source S7-1500T synchronous operation V7, 13.1.16
constexpr double kHighestDeceleration = 2.77777777777778e8;

/// With a MaxJerk that has been lowered the velocity could pass its limit while a present acceleration is run
/// down: of the jerk before as much stays as that needs.
double sufficient_jerk(double jerk, double before, double acceleration, double room) noexcept {
  const double square = acceleration * acceleration;
  if (jerk <= 0.0 || before <= jerk || square <= 2.0 * jerk * room) return jerk;
  return std::min(before, square / (2.0 * room));
}

/// By what places on a ring may be apart by rounding, relative to them: 0.1 + 0.2 is 0.3, not a turn before
/// it.
constexpr double kSamePlace = 4.0 * std::numeric_limits<double>::epsilon();

double positive_or(double value, double other) noexcept {
  return value > 0.0 ? value : other;
}

/// What a superimposed motion adds to the velocity in a direction, 1 or -1, now or when its acceleration has
/// been run down [u/s] ≥ 0.
double greatest_velocity(const Superimposed& superimposed, double direction) noexcept {
  const double v = superimposed.velocity(), a = superimposed.acceleration();
  const double jerk = superimposed.dynamics().jerk;
  const double run_down = jerk > 0.0 ? a * std::abs(a) / (2.0 * jerk) : 0.0;
  return std::max({direction * v, direction * (v + run_down), 0.0});
}

}  // namespace

// ---- Dynamics
// ---------------------------------------------------------------------------------------------------

/// Velocity limit in effect [u/s].
double Axis::velocity_limit() const noexcept {
  return std::min(data.DynamicLimits.MaxVelocity, data.DynamicLimits.Velocity);
}

/// Velocity that a job asks for, before the limit [u/s]. The override counts for the axis' own motion only.
double Axis::wanted_velocity(const Job& job) const noexcept {
  const double own = data.Override.Velocity / 100.0;
  switch (job.kind) {
    case JobKind::MC_GearIn:
    case JobKind::MC_GearInVelocity:
    case JobKind::MC_GearOut:
    case JobKind::MC_CamOut:
      return velocity_limit();
    case JobKind::MC_GearInPos:
    case JobKind::MC_CamIn:
    case JobKind::MC_PhasingAbsolute:
    case JobKind::MC_PhasingRelative:
      return job.velocity < 0.0 ? data.DynamicDefaults.Velocity : job.velocity;
    case JobKind::MC_MoveVelocity:
    case JobKind::MC_MoveJog:
      return std::abs(job.velocity) * own;
    default:
      return (job.velocity < 0.0 ? data.DynamicDefaults.Velocity : job.velocity) * own;
  }
}

/// Negative dynamic values stand for the defaults as they are when the job is handed over; changed later,
/// those count for the next one. The inputs of a jogging block are read in every call, and so are its
/// defaults.
/// @source S7-1500T synchronous operation V7, 13.1.17
void Axis::take_defaults(Job& job) const noexcept {
  if (job.kind == JobKind::MC_MoveJog || gives_values(job.kind)) return;
  const auto& defaults = data.DynamicDefaults;
  const auto take = [](LREAL& value, LREAL instead) {
    if (value < 0.0) value = instead;
  };
  if (job.kind != JobKind::MC_MoveVelocity) take(job.velocity, defaults.Velocity);
  take(job.acceleration, defaults.Acceleration);
  take(job.deceleration, defaults.Deceleration);
  take(job.jerk, defaults.Jerk);
}

/// Dynamic values of a job: defaults for negative ones, cut to the limits with a warning. A MaxJerk of 0.0 is
/// an alarm where it would count (`zero_limit`); it takes no job its jerk.
Dynamics Axis::effective_dynamics(const Job& job) noexcept {
  const auto& defaults = data.DynamicDefaults;
  const auto& limits = data.DynamicLimits;
  const double velocity = wanted_velocity(job);
  const double acceleration = job.acceleration < 0.0 ? defaults.Acceleration : job.acceleration;
  const double deceleration = job.deceleration < 0.0 ? defaults.Deceleration : job.deceleration;
  const double jerk = job.jerk < 0.0 ? defaults.Jerk : job.jerk;
  if (velocity > velocity_limit()) raise(alarm::kVelocityLimited);
  if (acceleration > limits.MaxAcceleration || deceleration > limits.MaxDeceleration)
    raise(alarm::kAccelerationLimited);
  const double highest_jerk = positive_or(limits.MaxJerk, jerk);
  if (jerk > highest_jerk) raise(alarm::kJerkLimited);
  return {.velocity = std::min(velocity, velocity_limit()),
          .acceleration = std::min(acceleration, limits.MaxAcceleration),
          .deceleration = std::min(deceleration, limits.MaxDeceleration),
          .jerk = std::min(jerk, highest_jerk)};
}

/// Dynamic values for a motion of the axis' own that takes over from the present state. The velocity limit
/// counts more than the jerk that a job asks for: with too low a one, the velocity would pass the limit while
/// a present acceleration is run down.
Dynamics Axis::own_dynamics(const Job& job) noexcept {
  Dynamics dynamics = effective_dynamics(job);
  keep_below_limit(dynamics);
  return dynamics;
}

void Axis::keep_below_limit(Dynamics& dynamics) const noexcept {
  keep_below_limit(dynamics, setpoint_.acceleration, room_to_limit());
}

void Axis::keep_below_limit(Dynamics& dynamics, double acceleration, double room) const noexcept {
  const double square = acceleration * acceleration;
  if (dynamics.jerk > 0.0 && square > 2.0 * dynamics.jerk * room)
    dynamics.jerk = std::max(dynamics.jerk, std::min(square / (2.0 * room), data.DynamicLimits.MaxJerk));
}

/// Velocity that is left, in the direction of the present acceleration, up to the limit [u/s] ≥ 0; to a base
/// motion beside what is superimposed.
double Axis::room_to_limit() const noexcept {
  const double direction = setpoint_.acceleration < 0.0 ? -1.0 : 1.0;
  return room_to_limit(setpoint_, advancing_base_ ? greatest_velocity(superimposed_, direction) : 0.0);
}

/// @param beside velocity in that direction that does not count to `from` [u/s]
double Axis::room_to_limit(const Setpoint& from, double beside) const noexcept {
  const double direction = from.acceleration < 0.0 ? -1.0 : 1.0;
  return std::max(velocity_limit() - (direction * from.velocity + beside), 0.0);
}

/// A synchronous motion, or one without jerk limit, may leave an acceleration that not even MaxJerk can run
/// down within the room to the velocity limit: what is too much is dropped.
double Axis::tolerable_acceleration(double acceleration, double room) const noexcept {
  const double most = std::sqrt(2.0 * data.DynamicLimits.MaxJerk * room);
  return std::abs(acceleration) > most ? std::copysign(most, acceleration) : acceleration;
}

Dynamics Axis::maximum_dynamics() const noexcept {
  const double deceleration = positive_or(data.DynamicLimits.MaxDeceleration, kHighestDeceleration);
  return {.velocity = velocity_limit(),
          .acceleration = positive_or(data.DynamicLimits.MaxAcceleration, deceleration),
          .deceleration = deceleration,
          .jerk = data.DynamicLimits.MaxJerk};
}

Dynamics Axis::emergency_dynamics() const noexcept {
  Dynamics dynamics = maximum_dynamics();
  dynamics.deceleration = positive_or(data.DynamicDefaults.EmergencyDeceleration, dynamics.deceleration);
  dynamics.jerk = 0.0;
  return dynamics;
}

/// An alarm for a limit of zero, which no motion can keep; 0: none. That of the jerk counts for a motion that
/// limits its jerk.
int Axis::zero_limit(const Dynamics& dynamics) const noexcept {
  if (velocity_limit() <= 0.0) return alarm::kVelocityLimitZero;
  if (dynamics.acceleration <= 0.0 || dynamics.deceleration <= 0.0) return alarm::kAccelerationLimitZero;
  if (dynamics.jerk > 0.0 && data.DynamicLimits.MaxJerk <= 0.0) return alarm::kJerkLimitZero;
  return 0;
}

// ---- Beginning a motion
// -----------------------------------------------------------------------------------------

void Axis::begin_base_motion(Job& job) noexcept {
  absorb_superimposed();
  cut_acceleration();
  Dynamics dynamics = own_dynamics(job);
  if (job.kind == JobKind::MC_Stop && job.mode == 0) dynamics.jerk = 0.0;  // the emergency ramp has none
  if (const int alarm_number = zero_limit(dynamics); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  running_[kBase] = &job;
  job.phase = JobPhase::active;
  leave_synchronous();
  motion_ = Motion::single_axis;
  emergency_ramp_ = EmergencyRamp::none;
  in_window_ticks_ = 0;
  since_target_ticks_ = 0;
  remember_limits();
  if (job.kind != JobKind::MC_Halt && job.kind != JobKind::MC_Stop)
    set_position_control(job.position_controlled);
  // One that has waited for another one is refused only now, when it is known where it begins.
  ErrorId error = target_refusal(job);
  if (error == ErrorId::none && plan(job, dynamics) == PlanResult::ok) return;
  if (error == ErrorId::none) error = ErrorId::unspecified;
  end_job(kBase, JobPhase::failed, error);
  begin_stop(maximum_dynamics(), false);
}

/// Whether a job would leave the range of positions by where it ends, begun at this moment. On a ring every
/// place is inside; targets themselves are checked where they come in.
ErrorId Axis::target_refusal(const Job& job) const noexcept {
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
  return std::abs(from + job.position) <= kPositionRange ? ErrorId::none : ErrorId::distance;
}

PlanResult Axis::plan(Job& job, const Dynamics& dynamics) noexcept {
  switch (job.kind) {
    case JobKind::MC_MoveAbsolute:
      return move_by(absolute_way(job, dynamics), job, dynamics);
    case JobKind::MC_MoveRelative:
      return move_by(DoubleDouble{job.position, 0.0} - beyond_target_, job, dynamics);
    case JobKind::MC_MoveVelocity: {
      if (job.current) {  // from now on a velocity like any other, of which the override is part already
        const double own = data.Override.Velocity / 100.0;
        job.current = false;
        job.velocity = own > 0.0 ? setpoint_.velocity / own : setpoint_.velocity;
        if (own > 0.0) return single_.run_at(setpoint_, setpoint_.velocity, maximum_for_current(dynamics));
      }
      return single_.run_at(setpoint_, std::copysign(dynamics.velocity, job.velocity), dynamics);
    }
    case JobKind::MC_Home:
      return plan_homing(job, dynamics);
    case JobKind::MC_MoveJog:
      jogged_ = job;
      return single_.run_at(setpoint_, dynamics.velocity * job.direction, dynamics);
    case JobKind::MC_Stop:
      stop_ = &job;
      if (job.mode == 0) {
        ask_for_emergency_ramp();
        return single_.stop(setpoint_, emergency_dynamics(), job.abort_acceleration);
      }
      if (job.mode == 2) return single_.stop(setpoint_, maximum_dynamics(), job.abort_acceleration);
      [[fallthrough]];
    default:  // MC_Halt
      return single_.stop(setpoint_, dynamics, job.abort_acceleration);
  }
}

/// The velocity held by Current may be the one of a synchronous motion, beyond the limit of the axis' own
/// motion: then it comes down to that.
Dynamics Axis::maximum_for_current(Dynamics dynamics) const noexcept {
  dynamics.velocity = velocity_limit();
  return dynamics;
}

/// Way to the target of MC_MoveAbsolute [u]. On a ring a motion that blends counts it from the target before.
DoubleDouble Axis::absolute_way(const Job& job, const Dynamics& dynamics) const noexcept {
  const bool directed = modulo_.enabled && job.direction != 3;
  const auto reachable = [&](double distance) noexcept {
    return directed && distance != 0.0 ? beyond_stopping_distance(distance, dynamics) : distance;
  };
  if (!modulo_.enabled || beyond_target_ == DoubleDouble{})
    return {reachable(absolute_distance(job, setpoint_.position.value)), 0.0};
  const AxisPosition before = advanced(setpoint_.position, -beyond_target_, modulo_);
  return DoubleDouble{reachable(absolute_distance(job, before.value)), 0.0} - beyond_target_;
}

/// Way from a position to the target of MC_MoveAbsolute [u].
double Axis::absolute_distance(const Job& job, double here) const noexcept {
  if (!modulo_.enabled) return job.position - here;
  const double target = normalised({0, job.position}, modulo_).value;
  const double shortest = shortest_distance(here, target, modulo_);
  const double same_place = kSamePlace * (std::abs(modulo_.start) + modulo_.length);
  if (job.direction == 3 || std::abs(shortest) <= same_place) return shortest;
  return job.direction == 1 ? positive_distance(here, target, modulo_)
                            : negative_distance(here, target, modulo_);
}

/// In a direction that is asked for, on to the pass of the target that the axis can still come to rest at:
/// turning back would be the other direction.
double Axis::beyond_stopping_distance(double distance, const Dynamics& dynamics) const noexcept {
  const double heading = distance < 0.0 ? -1.0 : 1.0;
  const double velocity = heading * setpoint_.velocity;
  if (velocity <= 0.0 || dynamics.velocity <= 0.0) return distance;
  const double most = std::max(velocity, dynamics.velocity) + 1.0;
  const ProfileLimits limits{.velocity_max = most,
                             .velocity_min = -most,
                             .acceleration = dynamics.acceleration,
                             .deceleration = dynamics.deceleration,
                             .jerk = dynamics.jerk};
  Profile stop;
  const MotionState now{0.0, velocity, heading * setpoint_.acceleration};
  if (plan_stop(now, limits, PresentAcceleration::keep, stop) != PlanResult::ok) return distance;
  const double missing = stop.target().position - std::abs(distance);
  // A rounding is no reason for a turn: a motion that is begun anew at its own target stays there.
  if (missing <= kSamePlace * (std::abs(modulo_.start) + modulo_.length) * 16.0) return distance;
  return distance + heading * std::ceil(missing / modulo_.length) * modulo_.length;
}

void Axis::show_target(const AxisPosition& target) noexcept {
  data.StatusPositioning.TargetPosition = target.value;
  data.StatusPositioning.TargetPositionModuloCycle = static_cast<DINT>(target.turns - counted_from_);
}

PlanResult Axis::move_by(DoubleDouble exact_way, const Job& job, const Dynamics& dynamics) noexcept {
  const double way = exact_way.rounded();
  AxisPosition target = advanced(setpoint_.position, exact_way, modulo_);
  if (job.kind == JobKind::MC_MoveAbsolute || job.kind == JobKind::MC_Home) {
    // The way is rounded; the target is the given position itself.
    target.value = modulo_.enabled ? normalised({0, job.position}, modulo_).value : job.position;
  }
  show_target(target);
  if (dynamics.velocity > 0.0) return single_.move_to(setpoint_, target, way, dynamics);
  Dynamics crawl = dynamics;  // an override of 0 %: plan with the least velocity, then hold at once
  crawl.velocity = velocity_limit();
  const PlanResult result = single_.move_to(setpoint_, target, way, crawl);
  return result == PlanResult::ok ? single_.replan(setpoint_, dynamics) : result;
}

void Axis::begin_stop(const Dynamics& dynamics, bool abort_acceleration) noexcept {
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

void Axis::step_single_axis() noexcept {
  Job* job = running_[kBase];
  if (job != nullptr && (limits_changed() || job->kind == JobKind::MC_MoveJog)) follow_changes(*job);
  single_.advance(setpoint_);
  if (advancing_base_) add_superimposed();
  if (running_[kBase] != nullptr) watch_base_job(*running_[kBase]);
  if (running_[kBuffered] != nullptr) watch_buffered();
}

/// Limits and override count at once; so do the inputs of a jogging block. Seldom: not part of every cycle.
[[gnu::noinline]] void Axis::follow_changes(Job& job) noexcept {
  const bool jog = job.kind == JobKind::MC_MoveJog;
  const bool inputs_changed =
      jog && (job.direction != jogged_.direction || job.velocity != jogged_.velocity ||
              job.acceleration != jogged_.acceleration || job.deceleration != jogged_.deceleration ||
              job.jerk != jogged_.jerk);
  if (!inputs_changed && !limits_changed()) return;
  if (job.kind == JobKind::MC_Stop || job.kind == JobKind::MC_Halt || leaves(job.kind)) return;
  remember_limits();
  const Dynamics wanted = effective_dynamics(job);
  if (const int alarm_number = zero_limit(wanted); alarm_number != 0) return raise(alarm_number);
  const double jerk_before = single_.dynamics().jerk;
  const bool jerk_now_limited = jerk_before <= 0.0 && wanted.jerk > 0.0;
  if (inputs_changed || jerk_now_limited) cut_acceleration();
  Dynamics dynamics = own_dynamics(job);
  dynamics.jerk = sufficient_jerk(dynamics.jerk, jerk_before, setpoint_.acceleration, room_to_limit());
  if (advancing_base_) leave_to_superimposed(&job, dynamics);
  PlanResult result = PlanResult::ok;
  if (jog || job.kind == JobKind::MC_Home || job.kind == JobKind::MC_MoveVelocity) {
    result = plan(job, dynamics);
  } else if (!single_.finished() || single_.aim() != SingleAxisMotion::Aim::position) {
    result = single_.replan(setpoint_, dynamics);
  }
  if (running_[kBuffered] != nullptr && result == PlanResult::ok) plan_blending();
  if (job.phase == JobPhase::reached) job.phase = JobPhase::active;
  if (result == PlanResult::ok) return;
  end_job(kBase, JobPhase::failed, ErrorId::unspecified);
  begin_stop(maximum_dynamics(), false);
}

void Axis::remember_limits() noexcept {
  const TO_Struct_DynamicLimits& limits = data.DynamicLimits;
  planned_ = {data.Override.Velocity, limits.Velocity, limits.MaxAcceleration, limits.MaxDeceleration,
              limits.MaxJerk};
}

void Axis::watch_base_job(Job& job) noexcept {
  const bool passes = single_.aim() == SingleAxisMotion::Aim::position && single_.target_velocity() != 0.0;
  if (!single_.finished() || passes) return;
  switch (job.kind) {
    case JobKind::MC_MoveVelocity:
      job.phase = JobPhase::reached;
      break;
    case JobKind::MC_MoveJog:
      if (job.direction != 0) {
        job.phase = JobPhase::reached;
      } else {
        end_job(kBase, JobPhase::done, ErrorId::none);
      }
      break;
    case JobKind::MC_Home:
      if (homing_.phase != HomingPhase::travel) break;
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

/// Done once the actual position has stayed in the positioning window for the dwell time; alarm 541 if it
/// does not come there within the tolerance time, or leaves the window within the dwell time.
void Axis::watch_positioning() noexcept {
  const auto& monitoring = data.PositioningMonitoring;
  // While a superimposed motion goes on, the axis cannot be there; its base motion has come to rest.
  const double away =
      superimposed_.resting() ? std::abs(rounded_difference(actual_, setpoint_.position, modulo_)) : 0.0;
  ++since_target_ticks_;
  const bool silent = has_drive_ && position_monitoring_off();
  if (away > monitoring.Window && in_window_ticks_ > 0 && !silent) return raise(alarm::kPositioning);
  in_window_ticks_ = away <= monitoring.Window ? in_window_ticks_ + 1 : 0;
  if (in_window_ticks_ > ticks_of(monitoring.MinDwellTime)) {
    end_job(kBase, JobPhase::done, ErrorId::none);
  } else if (in_window_ticks_ == 0 && since_target_ticks_ > ticks_of(monitoring.ToleranceTime) && !silent) {
    raise(alarm::kPositioning);
  }
}

/// A stop under position control is done when the actual position has settled as well. A drive whose torque
/// is limited may never get there: MC_Halt is done when the axis has stood for the dwell time.
void Axis::watch_standstill() noexcept {
  const bool settled = !has_drive_ || !moving(actual_velocity_);
  const bool halts = position_controlled_ && running_[kBase]->kind == JobKind::MC_Halt;
  const bool limited = has_drive_ && position_monitoring_off();
  if (halts && !limited) {
    if (settled) watch_positioning();
    return;
  }
  in_window_ticks_ = settled ? in_window_ticks_ + 1 : 0;
  if (!settled || (halts && in_window_ticks_ <= ticks_of(data.PositioningMonitoring.MinDwellTime))) return;
  end_job(kBase, JobPhase::done, ErrorId::none);
}

}  // namespace lockstep
