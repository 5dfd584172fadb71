// A job that waits for the end of the one before it, and motions that blend into each other.
#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/target_distance.hpp"

namespace lockstep {
namespace {

bool blends(const Job& job) noexcept {
  return job.buffer_mode >= BufferMode::mcBlendingLow;
}

bool positions(const Job& job) noexcept {
  return job.kind == JobKind::MC_MoveAbsolute || job.kind == JobKind::MC_MoveRelative;
}

}  // namespace

/// Whether the job waits, or has been refused; false: nothing runs that it could wait for, and it starts at
/// once.
bool AxisOrders::buffer(Job& job) noexcept {
  const Job* base = jobs_[kBase];
  if (base == nullptr && !simulating()) return false;
  const bool own = base != nullptr && motion_ == Motion::single_axis && !leaves(base->kind);
  if (!own) {
    job.fail(ErrorId::mode);
    return true;
  }
  if (jobs_[kBuffered] != nullptr && jobs_[kBuffered] == job.replaces)
    end_job(kBuffered, JobPhase::aborted, ErrorId::none);
  if (jobs_[kBuffered] != nullptr) {
    job.fail(ErrorId::no_job_memory);
    return true;
  }
  jobs_.put(kBuffered, job, JobPhase::waiting);
  blending_.release();
  if (blends(job)) plan_blending();
  return true;
}

/// Each tick in which a job waits: the one before it may have ended, or have passed its target on the way.
void AxisOrders::watch_buffered() noexcept {
  Job* base = jobs_[kBase];
  if (base != nullptr) {
    const bool passed = single_.finished() && single_.aim() == SingleAxisMotion::Aim::position &&
                        single_.target_velocity() != 0.0;
    const bool released = base->kind == JobKind::MC_MoveVelocity && base->phase == JobPhase::reached;
    if (passed) end_job(kBase, JobPhase::done, ErrorId::none);
    if (released) end_job(kBase, JobPhase::aborted, ErrorId::none);
    if (!passed && !released) return speed_up_for_junction();
    if (passed) beyond_target_ = difference(base_setpoint().position, single_.target(), modulo_);
  }
  Job& job = *jobs_[kBuffered];
  jobs_.take(kBuffered);
  blending_.release();
  if (override_running(JobClass::motion, job))
    begin_base_motion(job);
  else
    begin_stop(limits_.maximum(), false);
  beyond_target_ = {};
}

// ---- Blending
// ---------------------------------------------------------------------------------------------------

/// The running positioning passes its target with the velocity that the mode of the next job asks for.
void AxisOrders::plan_blending() noexcept {
  const Job& base = *jobs_[kBase];
  const bool under_way =
      positions(base) && !single_.finished() && single_.aim() == SingleAxisMotion::Aim::position;
  if (!under_way || single_.dynamics().velocity <= 0.0) return;
  const Job& next = *jobs_[kBuffered];
  if (blending_.plan(single_, base_setpoint(), motion_after_target(next), next.buffer_mode,
                     limits_.velocity(), modulo_))
    speed_up_for_junction();
}

void AxisOrders::speed_up_for_junction() noexcept {
  if (!blending_.due_to_speed_up(single_, base_setpoint(), modulo_)) return;
  blending_.speed_up(single_, base_setpoint(), motion_after_target(*jobs_[kBuffered]), modulo_);
}

/// What the next motion is like, seen from the target of the running one.
NextMotion AxisOrders::motion_after_target(const Job& job) noexcept {
  NextMotion next{.distance = 0.0, .endless = false, .dynamics = effective_dynamics(job)};
  switch (job.kind) {
    case JobKind::MC_MoveAbsolute:
      next.distance = absolute_distance(job.as<MoveAbsoluteJob>(), single_.target().value, modulo_);
      break;
    case JobKind::MC_MoveRelative:
      next.distance = job.as<DistanceJob>().distance;
      break;
    case JobKind::MC_MoveVelocity:
      next.distance =
          job.as<VelocityJob>().current ? single_.target_velocity() : job.velocity;  // its direction
      next.endless = true;
      break;
    default:  // MC_Halt: wherever the axis comes to rest, but in the direction in which it goes
      next.distance = rounded_difference(single_.target(), base_setpoint().position, modulo_);
      next.endless = true;
      next.dynamics.velocity = 0.0;
      break;
  }
  return next;
}

}  // namespace lockstep
