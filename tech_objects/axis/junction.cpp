#include "tech_objects/axis/junction.hpp"

#include "tech_objects/axis/target_distance.hpp"

namespace lockstep {
namespace {

bool positions(const Job& job) noexcept {
  return job.kind == JobKind::MC_MoveAbsolute || job.kind == JobKind::MC_MoveRelative;
}

}  // namespace

void JunctionOrders::plan() noexcept {
  const Job& base = *jobs_[kBase];
  const bool in_progress =
      positions(base) && !single_.finished() && single_.aim() == SingleAxisMotion::Aim::position;
  if (!in_progress || single_.dynamics().velocity <= 0.0) return;
  const Job& next = *jobs_[kBuffered];
  if (blending_.plan(single_, superimposed_.base_of(setpoint_), motion_after_target(next), next.buffer_mode,
                     limits_.velocity(), modulo_))
    speed_up();
}

void JunctionOrders::speed_up() noexcept {
  if (!blending_.due_to_speed_up(single_, superimposed_.base_of(setpoint_), modulo_)) return;
  blending_.speed_up(single_, superimposed_.base_of(setpoint_), motion_after_target(*jobs_[kBuffered]),
                     modulo_);
}

/// What the next motion is like, seen from the target of the running one.
NextMotion JunctionOrders::motion_after_target(const Job& job) noexcept {
  NextMotion next{.distance = 0.0, .endless = false, .dynamics = dynamics_.effective(job)};
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
      next.distance =
          rounded_difference(single_.target(), superimposed_.base_of(setpoint_).position, modulo_);
      next.endless = true;
      next.dynamics.velocity = 0.0;
      break;
  }
  return next;
}

}  // namespace lockstep
