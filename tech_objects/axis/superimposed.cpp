// What is added to the base motion: MC_MoveSuperimposed, MC_MotionInSuperimposed, MC_HaltSuperimposed.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {
namespace {

/// What a limit still leaves of `used`; nothing that is used leaves it all.
double rest_of(double limit, double used) noexcept {
  return std::max(limit - used, 0.0);
}

/// What a superimposed motion that comes to rest is left at least of the limits, or leaves; and what it is
/// given if the base motion leaves it less.
constexpr double kLeastPart = 0.1;
constexpr double kHalf = 0.5;

Dynamics part_of(const Dynamics& whole, double part) noexcept {
  const double acceleration = part * std::min(whole.acceleration, whole.deceleration);
  return {whole.velocity, acceleration, acceleration, part * whole.jerk};
}

/// What is wanted, but no more than there is; a jerk of 0 is none that limits.
Dynamics braking(const Dynamics& wanted, const Dynamics& most, double velocity) noexcept {
  const bool jerk_limited = wanted.jerk > 0.0 && most.jerk > 0.0;
  return {.velocity = velocity,
          .acceleration = std::min(wanted.acceleration, most.acceleration),
          .deceleration = std::min(wanted.deceleration, most.deceleration),
          .jerk = jerk_limited ? std::min(wanted.jerk, most.jerk) : std::max(wanted.jerk, most.jerk)};
}

}  // namespace

// ---- Beginning
// --------------------------------------------------------------------------------------------------

void Axis::begin_superimposed(Job& job) noexcept {
  if (job.kind == JobKind::MC_HaltSuperimposed && superimposed_.resting()) {
    if (superimposed_.in_use()) superimposed_.rest();  // a distance that waited is given up
    job.phase = JobPhase::done;
    return;
  }
  if (job.kind != JobKind::MC_MotionInSuperimposed) {
    superimposed_wanted_ = effective_dynamics(job);
    if (const int alarm_number = zero_limit(superimposed_wanted_); alarm_number != 0) {
      raise(alarm_number);
      return job.fail(ErrorId::technology_alarm);
    }
  }
  if (job.kind == JobKind::MC_MoveSuperimposed) take_position_control();
  if (!superimposed_.in_use()) {
    base_ = setpoint_;
    superimposed_.begin();
  }
  superimposed_.cut_acceleration(maximum_dynamics().acceleration);
  running_[kSuperimposed] = &job;
  job.phase = JobPhase::active;
  show_superimposed_command();
  if (const ErrorId error = begin_superimposed_part(job); error != ErrorId::none) {
    superimposed_.rest();
    end_job(kSuperimposed, JobPhase::failed, error);
  }
}

ErrorId Axis::begin_superimposed_part(Job& job) noexcept {
  if (job.kind == JobKind::MC_MotionInSuperimposed) {
    superimposed_.begin_giving();
    return ErrorId::none;
  }
  superimposed_wanted_.velocity = job.velocity < 0.0 ? data.DynamicDefaults.Velocity : job.velocity;
  const bool halts = job.kind == JobKind::MC_HaltSuperimposed;
  if (halts) superimposed_wanted_.velocity = velocity_limit();
  const Dynamics room = quick_enough(first_room());
  const PlanResult result =
      halts ? superimposed_.stop(room, job.abort_acceleration) : superimposed_.move_by(job.position, room);
  return result == PlanResult::ok ? ErrorId::none : ErrorId::unspecified;
}

/// Dynamic values with which a superimposed motion begins. One that is under way has to brake even if the
/// base motion leaves nothing, at least of the jerk: by what its profile has had until now. Values that were
/// given had no room of their own: if there is next to none, half of the limits, and the base motion is
/// planned anew with the other half, which gives way no faster than its own jerk.
Dynamics Axis::first_room() noexcept {
  superimposed_room_ = superimposed_room();
  const Dynamics& room = superimposed_room_;
  if (superimposed_.resting()) return room;
  if (superimposed_.planned()) {
    if (room.acceleration > 0.0 && room.deceleration > 0.0) return room;
    return braking(superimposed_wanted_, superimposed_.dynamics(), room.velocity);
  }
  const Dynamics most = maximum_dynamics();
  if (motion_ == Motion::single_axis) {
    const double whole = std::min(most.acceleration, most.deceleration);
    superimposed_.cut_acceleration(
        rest_of(whole, std::max(std::abs(base_.acceleration), kLeastPart * whole)));
  }
  const Dynamics least = braking(superimposed_wanted_, part_of(most, kLeastPart), room.velocity);
  const bool enough = room.acceleration >= least.acceleration && room.deceleration >= least.deceleration &&
                      (room.jerk <= 0.0 || room.jerk >= least.jerk);
  if (enough) return room;
  Dynamics share = braking(superimposed_wanted_, part_of(most, kHalf), room.velocity);
  const double jerk = single_.dynamics().jerk;
  if (jerk > 0.0) share.jerk = std::min(share.jerk, jerk);
  planned_.override_velocity = std::numeric_limits<double>::quiet_NaN();
  return share;
}

/// A motion that goes on without position control goes on from where the axis is.
void Axis::take_position_control() noexcept {
  if (position_controlled_) return;
  const AxisPosition before = setpoint_.position;
  set_position_control(true);
  const double by = rounded_difference(setpoint_.position, before, modulo_);
  single_.shift(by);
  base_.position = advanced(base_.position, by, modulo_);
}

// ---- Room
// -----------------------------------------------------------------------------------------------------

/// Dynamic values for the distance of MC_MoveSuperimposed in this cycle. On a single-axis motion the sum
/// keeps within the limits, and the base motion comes first; a synchronous motion is not limited by them.
Dynamics Axis::superimposed_room() const noexcept {
  Dynamics room = superimposed_wanted_;
  room.velocity = std::min(room.velocity * data.Override.Velocity / 100.0, velocity_limit());
  if (led()) return room;
  const Dynamics left = left_by_base();
  room.velocity = std::min(room.velocity, left.velocity);
  room.acceleration = std::min(room.acceleration, left.acceleration);
  room.deceleration = std::min(room.deceleration, left.deceleration);
  if (room.jerk > 0.0) room.jerk = std::min(room.jerk, left.jerk);
  const bool jerk_left = room.jerk > 0.0 || superimposed_wanted_.jerk <= 0.0;
  if (!jerk_left) room.acceleration = room.deceleration = 0.0;
  return room;
}

/// What the limits leave beside a base motion of the axis' own, from now until its end: as long as it changes
/// its velocity, all but the dynamic values that it has, or what it has taken over beyond them and runs down.
/// At a constant velocity it may have to change it again, and is left half of the limits, or what it was
/// started with.
Dynamics Axis::left_by_base() const noexcept {
  Dynamics left = maximum_dynamics();
  left.acceleration = left.deceleration = std::min(left.acceleration, left.deceleration);
  left.velocity = velocity_left_by_base(superimposed_.direction());
  if (motion_ != Motion::single_axis || (single_.finished() && running_[kBase] == nullptr)) return left;
  const Dynamics used = single_.demand(base_);
  const bool changes = !single_.finished();
  const auto share = [changes](double limit, double part) {
    return changes ? rest_of(limit, part) : std::max(limit - part, 0.5 * limit);
  };
  left.acceleration = left.deceleration = share(left.acceleration, used.acceleration);
  left.jerk = share(left.jerk, used.jerk);
  return left;
}

/// What is left of the velocity limit in a direction, 1 or -1; 0: in either [u/s] ≥ 0.
double Axis::velocity_left_by_base(int side) const noexcept {
  const bool changes = motion_ == Motion::single_axis && !single_.finished();
  double used = side == 0 ? std::abs(base_.velocity) : std::max(side * base_.velocity, 0.0);
  if (changes) used = side == 0 ? single_.demand(base_).velocity : single_.fastest(base_, side);
  return rest_of(velocity_limit(), used);
}

/// The velocity limit counts more than the jerk: a present acceleration is run down before it is exceeded.
Dynamics Axis::quick_enough(Dynamics room) noexcept {
  const double a = superimposed_.acceleration();
  const int side = a < 0.0 ? -1 : 1;
  const double most = led() ? velocity_limit() : velocity_left_by_base(side);
  const double left = rest_of(most, side * superimposed_.velocity());
  const double most_jerk = data.DynamicLimits.MaxJerk;
  if (room.jerk > 0.0 && a * a > 2.0 * room.jerk * left)
    room.jerk = std::min(a * a / (2.0 * left), most_jerk);
  superimposed_.cut_acceleration(std::sqrt(2.0 * most_jerk * left));
  return room;
}

/// Whether a base motion that is planned anew with these values leaves a motion against it as it is.
bool Axis::stays_against_superimposed(const Job* job, const Dynamics& dynamics) const noexcept {
  const int side = superimposed_.direction();
  if (job == nullptr || side == 0 || single_.fastest(base_, side) > 0.0) return false;
  const Dynamics& before = single_.dynamics();
  const bool less_jerk = dynamics.jerk > 0.0 && (before.jerk <= 0.0 || dynamics.jerk < before.jerk);
  switch (job->kind) {
    case JobKind::MC_MoveVelocity:
      return side * job->velocity <= 0.0;
    case JobKind::MC_MoveJog:
      return side * job->direction <= 0;
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:  // with less it may pass its target and come back
      return dynamics.deceleration >= before.deceleration && !less_jerk;
    default:
      return false;
  }
}

/// A base motion that is planned anew keeps to what the superimposed motion under way leaves, within a step.
/// What that only runs down yet it is given back later.
void Axis::leave_to_superimposed(const Job* job, Dynamics& dynamics) noexcept {
  const Dynamics& used = superimposed_uses_;
  if (used.acceleration <= 0.0 || led()) return;
  const Dynamics whole = dynamics;
  const Dynamics most = maximum_dynamics();
  const auto curb = [](double& value, double left) {
    if (left > 0.0) value = std::min(value, left);
  };
  // The one may brake the way in which the other speeds up.
  curb(dynamics.acceleration, most.acceleration - used.acceleration);
  curb(dynamics.deceleration, most.deceleration - used.acceleration);
  if (dynamics.jerk > 0.0 && used.jerk > 0.0) curb(dynamics.jerk, most.jerk - used.jerk);
  if (!stays_against_superimposed(job, dynamics))
    dynamics.velocity = std::min(dynamics.velocity, rest_of(most.velocity, used.velocity));
  keep_below_limit(dynamics);
  base_curbed_ |= dynamics != whole;
  curbed_for_a_while_ = base_curbed_ && superimposed_runs_down();
}

/// Whether the superimposed motion uses more than its dynamic values.
bool Axis::superimposed_runs_down() const noexcept {
  const Dynamics& own = superimposed_.dynamics();
  return superimposed_uses_.velocity > own.velocity ||
         superimposed_uses_.acceleration > std::max(own.acceleration, own.deceleration);
}

/// Beside a base motion counts what the superimposed motion uses from the last setpoint on, also in the tick
/// in which it ends, and what it does once it has been advanced.
void Axis::advance_superimposed_in_view() noexcept {
  const bool planned = superimposed_.planned();
  const Dynamics before = planned ? superimposed_.demand() : Dynamics{};
  advance_superimposed();
  superimposed_uses_ = planned || superimposed_.planned() ? superimposed_.demand() : Dynamics{};
  superimposed_uses_.velocity = std::max(superimposed_uses_.velocity, before.velocity);
  superimposed_uses_.acceleration = std::max(superimposed_uses_.acceleration, before.acceleration);
  if (!curbed_for_a_while_ || superimposed_runs_down()) return;
  curbed_for_a_while_ = false;
  planned_.override_velocity =
      std::numeric_limits<double>::quiet_NaN();  // the base motion may have more again
}

/// A halt, or a stop for which no job asks any more, makes room as other base motions do, but does not turn
/// back: where it runs its deceleration down already, it keeps the jerk that it needs for that.
void Axis::replan_stop() noexcept {
  Job* const job = running_[kBase];
  if (job != nullptr && job->kind != JobKind::MC_Halt) return;
  remember_limits();
  if (motion_ != Motion::single_axis || single_.aim() != SingleAxisMotion::Aim::stand || single_.finished())
    return;
  const double jerk = single_.dynamics().jerk;
  Dynamics dynamics = job != nullptr ? own_dynamics(*job) : single_.dynamics();
  leave_to_superimposed(job, dynamics);
  const double v = setpoint_.velocity, a = setpoint_.acceleration;
  if (dynamics.jerk > 0.0 && a * v < 0.0)
    dynamics.jerk = std::max(dynamics.jerk, std::min(jerk, a * a / (2.0 * std::abs(v))));
  static_cast<void>(single_.stop(setpoint_, dynamics, false));  // else it goes on as it is
}

// ---- One cycle
// --------------------------------------------------------------------------------------------------

/// The base motion goes on by itself; then what is superimposed is added.
void Axis::step_superimposed() noexcept {
  advance_superimposed_in_view();
  if (!superimposed_.in_use()) return step_base();
  setpoint_ = base_;
  advancing_base_ = true;
  if (std::isnan(planned_.override_velocity)) replan_stop();
  step_base();
  if (advancing_base_) add_superimposed();
  if (!superimposed_.in_use()) return;
  data.StatusPositioning.SuperimposedDistance = std::abs(superimposed_.value().rounded());
  const Job* job = running_[kSuperimposed];
  if (job != nullptr) {
    const bool given = job->kind == JobKind::MC_MotionInSuperimposed;
    const bool exceeded = given && std::abs(setpoint_.velocity) > data.DynamicLimits.MaxVelocity;
    set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, exceeded);
    return;
  }
  if (!superimposed_.finished()) return;
  if (base_curbed_)
    planned_.override_velocity = std::numeric_limits<double>::quiet_NaN();  // it may have all again
  base_curbed_ = curbed_for_a_while_ = false;
  const bool base_rests = motion_ == Motion::single_axis && running_[kBase] == nullptr && single_.finished();
  if (!base_rests || simulating()) return;
  absorb_superimposed();
  single_.stand(setpoint_);
}

void Axis::advance_superimposed() noexcept {
  Job* job = running_[kSuperimposed];
  if (job != nullptr && job->kind == JobKind::MC_MotionInSuperimposed) return follow_given_superimposed(*job);
  if (job != nullptr && job->kind == JobKind::MC_MoveSuperimposed) follow_room();
  if (!superimposed_.in_use()) return;  // an alarm has ended it
  superimposed_.advance();
  if (running_[kSuperimposed] != nullptr && superimposed_.finished())
    end_job(kSuperimposed, JobPhase::done, ErrorId::none);
}

/// Override, limits and the base motion count at once.
void Axis::follow_room() noexcept {
  Dynamics wanted = superimposed_wanted_;
  wanted.acceleration = std::min(wanted.acceleration, data.DynamicLimits.MaxAcceleration);
  wanted.deceleration = std::min(wanted.deceleration, data.DynamicLimits.MaxDeceleration);
  if (const int alarm_number = zero_limit(wanted); alarm_number != 0) return raise(alarm_number);
  const Dynamics room = superimposed_room();
  if (room == superimposed_room_) return;
  superimposed_room_ = room;
  if (superimposed_.make_room(quick_enough(room)) == PlanResult::ok) return;
  end_job(kSuperimposed, JobPhase::failed, ErrorId::unspecified);
  if (superimposed_.stop(maximum_dynamics(), true) != PlanResult::ok) superimposed_.rest();
}

/// MC_MotionInSuperimposed: the values of the last call. Without Enable they go to zero at once.
void Axis::follow_given_superimposed(Job& job) noexcept {
  if (job.input_error != ErrorId::none) {
    end_job(kSuperimposed, JobPhase::failed, job.input_error);
    superimposed_.cut_acceleration(maximum_dynamics().acceleration);
    superimposed_wanted_ = maximum_dynamics();
    if (superimposed_.stop(first_room(), true) != PlanResult::ok) superimposed_.rest();
    return superimposed_.advance();
  }
  if (!job.hold) {
    superimposed_.rest();
    return end_job(kSuperimposed, JobPhase::done, ErrorId::none);
  }
  superimposed_.give(job.position, job.velocity, job.acceleration);
}

/// … function → + offset → + superimposed → setpoint
void Axis::add_superimposed() noexcept {
  base_ = setpoint_;
  setpoint_ = with_superimposed(base_);
  advancing_base_ = false;
}

Setpoint Axis::with_superimposed(const Setpoint& base) const noexcept {
  return {advanced(base.position, superimposed_.value(), modulo_), base.velocity + superimposed_.velocity(),
          base.acceleration + superimposed_.acceleration()};
}

/// Before any base motion begins anew: it takes over from what the axis does in all, and the superimposed
/// part is one of the base motion from now on. Within a step, before the base motion has been advanced, that
/// is the last setpoint.
void Axis::absorb_superimposed() noexcept {
  if (!superimposed_.in_use()) return;
  if (advancing_base_) setpoint_ = last_setpoint_;
  advancing_base_ = false;
  end_job(kSuperimposed, JobPhase::aborted, ErrorId::none);
  superimposed_.reset();
  base_curbed_ = curbed_for_a_while_ = false;
  data.StatusPositioning.SuperimposedDistance = 0.0;
}

void Axis::show_superimposed_command() noexcept {
  const Job* job = running_[kSuperimposed];
  const auto runs = [job](JobKind kind) { return job != nullptr && job->kind == kind; };
  set_bit(data.StatusWord, StatusBit::MoveSuperimposedCommand, runs(JobKind::MC_MoveSuperimposed));
  set_bit(data.StatusWord2, Status2Bit::MotionInSuperimposedCommand, runs(JobKind::MC_MotionInSuperimposed));
  set_bit(data.StatusWord2, Status2Bit::HaltSuperimposedCommand, runs(JobKind::MC_HaltSuperimposed));
  if (!runs(JobKind::MC_MotionInSuperimposed))
    set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, false);
}

}  // namespace lockstep
