// What is added to the base motion: MC_MoveSuperimposed, MC_MotionInSuperimposed, MC_HaltSuperimposed.
#include <cmath>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {
// ---- Beginning
// --------------------------------------------------------------------------------------------------

void AxisOrders::begin_superimposed(Job& job) noexcept {
  if (job.kind == JobKind::MC_HaltSuperimposed && superimposed_.resting()) {
    if (superimposed_.in_use()) superimposed_.rest();  // a distance that waited is given up
    job.phase = JobPhase::done;
    return;
  }
  if (job.kind != JobKind::MC_MotionInSuperimposed) {
    const Dynamics wanted = effective_dynamics(job);
    superimposed_.want(wanted);
    if (const int alarm_number = limits_.zero_limit(wanted); alarm_number != 0) {
      raise(alarm_number);
      return job.fail(ErrorId::technology_alarm);
    }
  }
  if (job.kind == JobKind::MC_MoveSuperimposed) take_position_control();
  superimposed_.begin(setpoint_, limits_.maximum().acceleration);
  jobs_.put(kSuperimposed, job, JobPhase::active);
  show_superimposed_command();
  if (job.kind == JobKind::MC_MotionInSuperimposed) return superimposed_.begin_giving();
  if (superimposed_.begin_motion(job, base_motion(), limits_) == PlanResult::ok) return;
  superimposed_.rest();
  end_job(kSuperimposed, JobPhase::failed, ErrorId::unspecified);
}

/// A motion that goes on without position control goes on from where the axis is.
void AxisOrders::take_position_control() noexcept {
  if (position_controlled_) return;
  const AxisPosition before = setpoint_.position;
  set_position_control(true);
  const double by = rounded_difference(setpoint_.position, before, modulo_);
  single_.shift(by);
  superimposed_.shift_base(by, modulo_);
}

BaseMotion AxisOrders::base_motion() const noexcept {
  return {single_, jobs_[kBase], motion_ == Motion::single_axis, led()};
}

/// A base motion that is planned anew within a step leaves what is superimposed its share.
void AxisOrders::leave_to_superimposed(const Job* job, Dynamics& dynamics) noexcept {
  superimposed_.curb(dynamics, setpoint_, base_motion(), job, limits_);
}

/// A halt, or a stop for which no job asks any more, makes room as other base motions do, but does not turn
/// back: where it runs its deceleration down already, it keeps the jerk that it needs for that.
void AxisOrders::replan_stop() noexcept {
  Job* const job = jobs_[kBase];
  if (job != nullptr && job->kind != JobKind::MC_Halt) return;
  limits_.remember();
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
void AxisOrders::step_superimposed() noexcept {
  const SuperimposedMotion::Demand before = superimposed_.demand();
  advance_superimposed();
  if (superimposed_.take_demand(before)) limits_.forget();
  if (!superimposed_.in_use()) return step_base();
  setpoint_ = superimposed_.begin_base();
  if (limits_.forgotten()) replan_stop();
  step_base();
  if (superimposed_.advancing_base()) add_superimposed();
  if (!superimposed_.in_use()) return;
  data.StatusPositioning.SuperimposedDistance = std::abs(superimposed_.value().rounded());
  const Job* job = jobs_[kSuperimposed];
  if (job != nullptr) {
    const bool given = job->kind == JobKind::MC_MotionInSuperimposed;
    const bool exceeded = given && std::abs(setpoint_.velocity) > data.DynamicLimits.MaxVelocity;
    set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, exceeded);
    return;
  }
  if (!superimposed_.finished()) return;
  if (superimposed_.give_back()) limits_.forget();
  const bool base_rests = motion_ == Motion::single_axis && jobs_[kBase] == nullptr && single_.finished();
  if (!base_rests || simulating()) return;
  absorb_superimposed();
  single_.stand(setpoint_);
}

void AxisOrders::advance_superimposed() noexcept {
  Job* job = jobs_[kSuperimposed];
  if (job != nullptr && job->kind == JobKind::MC_MotionInSuperimposed) return follow_given_superimposed(*job);
  if (job != nullptr && job->kind == JobKind::MC_MoveSuperimposed) follow_share();
  if (!superimposed_.in_use()) return;  // an alarm has ended it
  superimposed_.advance();
  if (jobs_[kSuperimposed] != nullptr && superimposed_.finished())
    end_job(kSuperimposed, JobPhase::done, ErrorId::none);
}

/// Override, limits and the base motion count at once.
void AxisOrders::follow_share() noexcept {
  const Dynamics wanted = superimposed_.wanted_within(data.DynamicLimits);
  if (const int alarm_number = limits_.zero_limit(wanted); alarm_number != 0) return raise(alarm_number);
  if (superimposed_.follow_share(base_motion(), limits_) == PlanResult::ok) return;
  end_job(kSuperimposed, JobPhase::failed, ErrorId::unspecified);
  superimposed_.stop(limits_.maximum(), true);
}

/// MC_MotionInSuperimposed: the values of the last call. Without Enable they go to zero at once.
void AxisOrders::follow_given_superimposed(Job& job) noexcept {
  const auto& asked = job.as<MotionInJob>();
  if (asked.error != ErrorId::none) {
    end_job(kSuperimposed, JobPhase::failed, asked.error);
    return superimposed_.brake(base_motion(), limits_);
  }
  if (!asked.hold) {
    superimposed_.rest();
    return end_job(kSuperimposed, JobPhase::done, ErrorId::none);
  }
  superimposed_.give(asked.position, asked.velocity, asked.acceleration);
}

void AxisOrders::add_superimposed() noexcept {
  setpoint_ = superimposed_.add_to(setpoint_, modulo_);
}

/// Before any base motion begins anew: it takes over from what the axis does in all, and the superimposed
/// part is one of the base motion from now on. Within a step, before the base motion has been advanced, that
/// is the last setpoint.
void AxisOrders::absorb_superimposed() noexcept {
  if (!superimposed_.in_use()) return;
  if (superimposed_.advancing_base()) setpoint_ = last_setpoint_;
  superimposed_.leave_base();
  end_job(kSuperimposed, JobPhase::aborted, ErrorId::none);
  superimposed_.reset();
  data.StatusPositioning.SuperimposedDistance = 0.0;
}

void AxisOrders::show_superimposed_command() noexcept {
  const Job* job = jobs_[kSuperimposed];
  const auto runs = [job](JobKind kind) { return job != nullptr && job->kind == kind; };
  set_bit(data.StatusWord, StatusBit::MoveSuperimposedCommand, runs(JobKind::MC_MoveSuperimposed));
  set_bit(data.StatusWord2, Status2Bit::MotionInSuperimposedCommand, runs(JobKind::MC_MotionInSuperimposed));
  set_bit(data.StatusWord2, Status2Bit::HaltSuperimposedCommand, runs(JobKind::MC_HaltSuperimposed));
  if (!runs(JobKind::MC_MotionInSuperimposed))
    set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, false);
}

}  // namespace lockstep
