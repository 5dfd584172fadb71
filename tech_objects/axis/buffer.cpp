#include "tech_objects/axis/buffer.hpp"

namespace lockstep {
namespace {

bool blends(const Job& job) noexcept {
  return job.buffer_mode >= BufferMode::mcBlendingLow;
}

}  // namespace

bool BufferOrders::take(Job& job) noexcept {
  const Job* base = jobs_[kBase];
  if (base == nullptr && simulated_ == nullptr) return false;
  const bool own = base != nullptr && motion_ == AxisMotion::single_axis && !leaves(base->kind);
  if (!own) {
    job.fail(ErrorId::mode);
    return true;
  }
  if (jobs_[kBuffered] != nullptr && jobs_[kBuffered] == job.replaces)
    ends_.end(kBuffered, JobPhase::aborted, ErrorId::none);
  if (jobs_[kBuffered] != nullptr) {
    job.fail(ErrorId::no_job_memory);
    return true;
  }
  jobs_.put(kBuffered, job, JobPhase::waiting);
  blending_.release();
  if (blends(job)) junction_.plan();
  return true;
}

void BufferOrders::watch() noexcept {
  Job* base = jobs_[kBase];
  if (base != nullptr) {
    const bool passed = single_.finished() && single_.aim() == SingleAxisMotion::Aim::position &&
                        single_.target_velocity() != 0.0;
    const bool released = base->kind == JobKind::MC_MoveVelocity && base->phase == JobPhase::reached;
    if (passed) ends_.end(kBase, JobPhase::done, ErrorId::none);
    if (released) ends_.end(kBase, JobPhase::aborted, ErrorId::none);
    if (!passed && !released) return junction_.speed_up();
    if (passed)
      motion_orders_.count_from_before(
          difference(superimposed_.base_of(setpoint_).position, single_.target(), modulo_));
  }
  Job& job = *jobs_[kBuffered];
  jobs_.take(kBuffered);
  blending_.release();
  if (ends_.override_running(JobClass::motion, job))
    motion_orders_.begin(job);
  else
    stops_.begin(limits_.maximum(), false);
  motion_orders_.count_from_before({});
}

}  // namespace lockstep
