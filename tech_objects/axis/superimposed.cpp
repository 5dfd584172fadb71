#include "tech_objects/axis/superimposed.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep {

void SuperimposedOrders::begin(Job& job) noexcept {
  if (job.kind == JobKind::MC_HaltSuperimposed && superimposed_.resting()) {
    if (superimposed_.in_use()) superimposed_.rest();  // a distance that waited is given up
    job.phase = JobPhase::done;
    return;
  }
  if (job.kind != JobKind::MC_MotionInSuperimposed) {
    const Dynamics wanted = dynamics_.effective(job);
    superimposed_.want(wanted);
    if (const ZeroLimit zero = limits_.zero_limit(wanted); zero.alarm != 0) {
      reactions_.raise(zero.alarm, zero.detail);
      return job.fail(ErrorId::technology_alarm);
    }
  }
  if (job.kind == JobKind::MC_MoveSuperimposed) take_position_control();
  superimposed_.begin(setpoint_, limits_.maximum().acceleration);
  jobs_.put(kSuperimposed, job, JobPhase::active);
  ends_.show_superimposed_command();
  if (job.kind == JobKind::MC_MotionInSuperimposed) return superimposed_.begin_giving();
  if (superimposed_.begin_motion(job, dynamics_.base_motion(), limits_) == PlanResult::ok) return;
  superimposed_.rest();
  ends_.end(kSuperimposed, JobPhase::failed, ErrorId::unspecified);
}

/// A motion that goes on without position control goes on from where the axis is.
void SuperimposedOrders::take_position_control() noexcept {
  if (position_controlled_) return;
  const AxisPosition before = setpoint_.position;
  position_control_.set(true);
  const double by = rounded_difference(setpoint_.position, before, modulo_);
  single_.shift(by);
  superimposed_.shift_base(by, modulo_);
}

void SuperimposedOrders::replan_stop() noexcept {
  Job* const job = jobs_[kBase];
  if (job != nullptr && job->kind != JobKind::MC_Halt) return;
  limits_.remember();
  if (motion_ != AxisMotion::single_axis || single_.aim() != SingleAxisMotion::Aim::stand ||
      single_.finished())
    return;
  const double jerk = single_.dynamics().jerk;
  Dynamics dynamics = job != nullptr ? dynamics_.own(*job) : single_.dynamics();
  dynamics_.leave_to_superimposed(job, dynamics);
  const double v = setpoint_.velocity, a = setpoint_.acceleration;
  if (dynamics.jerk > 0.0 && a * v < 0.0)
    dynamics.jerk = std::max(dynamics.jerk, std::min(jerk, a * a / (2.0 * std::abs(v))));
  static_cast<void>(single_.stop(setpoint_, dynamics, false));  // else it goes on as it is
}

// ---- One cycle

void SuperimposedOrders::advance() noexcept {
  const SuperimposedMotion::Demand before = superimposed_.demand();
  follow_job();
  if (superimposed_.take_demand(before)) limits_.forget();
}

void SuperimposedOrders::finish() noexcept {
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
  const bool base_rests = motion_ == AxisMotion::single_axis && jobs_[kBase] == nullptr && single_.finished();
  if (!base_rests || simulated_ != nullptr) return;
  stops_.absorb_superimposed();
  single_.stand(setpoint_);
}

void SuperimposedOrders::follow_job() noexcept {
  Job* job = jobs_[kSuperimposed];
  if (job != nullptr && job->kind == JobKind::MC_MotionInSuperimposed) return follow_given(*job);
  if (job != nullptr && job->kind == JobKind::MC_MoveSuperimposed) follow_share();
  if (!superimposed_.in_use()) return;  // an alarm has ended it
  superimposed_.advance();
  if (jobs_[kSuperimposed] != nullptr && superimposed_.finished())
    ends_.end(kSuperimposed, JobPhase::done, ErrorId::none);
}

/// Override, limits and the base motion count at once.
void SuperimposedOrders::follow_share() noexcept {
  const Dynamics wanted = superimposed_.wanted_within(data.DynamicLimits);
  if (const ZeroLimit zero = limits_.zero_limit(wanted); zero.alarm != 0)
    return reactions_.raise(zero.alarm, zero.detail);
  if (superimposed_.follow_share(dynamics_.base_motion(), limits_) == PlanResult::ok) return;
  ends_.end(kSuperimposed, JobPhase::failed, ErrorId::unspecified);
  superimposed_.stop(limits_.maximum(), true);
}

/// MC_MotionInSuperimposed: the values of the last call. Without Enable they go to zero at once.
void SuperimposedOrders::follow_given(Job& job) noexcept {
  const auto& asked = job.as<MotionInJob>();
  if (asked.error != ErrorId::none) {
    ends_.end(kSuperimposed, JobPhase::failed, asked.error);
    return superimposed_.brake(dynamics_.base_motion(), limits_);
  }
  if (!asked.hold) {
    superimposed_.rest();
    return ends_.end(kSuperimposed, JobPhase::done, ErrorId::none);
  }
  superimposed_.give(asked.position, asked.velocity, asked.acceleration);
}

}  // namespace lockstep
