// A job that waits for the end of the one before it, and motions that blend into each other.
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {
namespace {

/// Steps by which the highest blending velocity is looked for: to some 1e-5 of the one wanted.
constexpr int kSearchSteps = 16;

bool blends(const Job& job) noexcept {
  return job.buffer_mode >= BufferMode::mcBlendingLow;
}

bool positions(const Job& job) noexcept {
  return job.kind == JobKind::MC_MoveAbsolute || job.kind == JobKind::MC_MoveRelative;
}

}  // namespace

/// Whether the job waits, or has been refused; false: nothing runs that it could wait for, and it starts at
/// once.
bool Axis::buffer(Job& job) noexcept {
  const Job* base = running_[kBase];
  if (base == nullptr && !simulating()) return false;
  const bool own = base != nullptr && motion_ == Motion::single_axis && !leaves(base->kind);
  if (!own) {
    job.fail(ErrorId::mode);
    return true;
  }
  if (running_[kBuffered] != nullptr && running_[kBuffered] == job.replaces)
    end_job(kBuffered, JobPhase::aborted, ErrorId::none);
  if (running_[kBuffered] != nullptr) {
    job.fail(ErrorId::no_job_memory);
    return true;
  }
  running_[kBuffered] = &job;
  job.phase = JobPhase::waiting;
  junction_velocity_ = 0.0;
  if (blends(job)) plan_blending();
  return true;
}

/// Each tick in which a job waits: the one before it may have ended, or have passed its target on the way.
void Axis::watch_buffered() noexcept {
  Job* base = running_[kBase];
  if (base != nullptr) {
    const bool passed = single_.finished() && single_.aim() == SingleAxisMotion::Aim::position &&
                        single_.target_velocity() != 0.0;
    const bool released = base->kind == JobKind::MC_MoveVelocity && base->phase == JobPhase::reached;
    if (passed) end_job(kBase, JobPhase::done, ErrorId::none);
    if (released) end_job(kBase, JobPhase::aborted, ErrorId::none);
    if (!passed && !released) return speed_up_for_junction();
    if (passed) beyond_target_ = difference(base_setpoint().position, single_.target(), modulo_);
  }
  Job& job = *running_[kBuffered];
  running_[kBuffered] = nullptr;
  junction_velocity_ = 0.0;
  if (override_running(JobClass::motion, job))
    begin_base_motion(job);
  else
    begin_stop(maximum_dynamics(), false);
  beyond_target_ = {};
}

// ---- Blending
// ---------------------------------------------------------------------------------------------------

/// Plans the running positioning so that it passes its target with the velocity of both: the one that the
/// mode asks for, or the highest one that needs no turning back, neither here nor by the next motion.
void Axis::plan_blending() noexcept {
  const Job& base = *running_[kBase];
  const bool under_way =
      positions(base) && !single_.finished() && single_.aim() == SingleAxisMotion::Aim::position;
  if (!under_way || single_.dynamics().velocity <= 0.0) return;
  const Job& next = *running_[kBuffered];
  const Dynamics dynamics = single_.dynamics();
  const Blending blending = blending_into(next);
  const double way = rounded_difference(single_.target(), base_setpoint().position, modulo_);
  const double wanted =
      wanted_blending_velocity(next.buffer_mode, dynamics.velocity, blending.dynamics.velocity);
  junction_velocity_ = 0.0;
  if (way == 0.0 || wanted <= 0.0 || !(blending.way * way > 0.0)) return;
  const double own = std::min({wanted, dynamics.velocity, velocity_limit()});
  const double velocity = highest_junction_velocity(way, own, blending, dynamics);
  if (velocity <= 0.0) return;
  single_.move_to(base_setpoint(), single_.target(), way, dynamics, std::copysign(velocity, way));
  if (velocity == own && wanted > own) junction_velocity_ = std::min(wanted, velocity_limit());
  speed_up_for_junction();
}

/// Up to the wanted one, the highest velocity with which the target can be passed.
double Axis::highest_junction_velocity(double distance, double wanted, const Blending& blending,
                                       const Dynamics& dynamics) const noexcept {
  const auto possible = [&](double velocity) {
    return next_can_take_over(blending, velocity) &&
           single_.passes_ahead(base_setpoint(), distance, std::copysign(velocity, distance), dynamics);
  };
  if (possible(wanted)) return wanted;
  double velocity = 0.0;
  double too_high = wanted;
  for (int i = 0; i < kSearchSteps; ++i) {
    const double middle = 0.5 * (velocity + too_high);
    (possible(middle) ? velocity : too_high) = middle;
  }
  return velocity;
}

/// Where the next motion is faster and the junction is to have its velocity, the running one keeps its own as
/// long as it can, and speeds up where it just reaches the other at its target.
void Axis::speed_up_for_junction() noexcept {
  if (junction_velocity_ <= 0.0 || single_.aim() != SingleAxisMotion::Aim::position || single_.finished() ||
      single_.target_velocity() == 0.0)
    return;
  Dynamics dynamics = single_.dynamics();
  if (junction_velocity_ <= dynamics.velocity) return;
  dynamics.velocity = junction_velocity_;
  const double distance = rounded_difference(single_.target(), base_setpoint().position, modulo_);
  if (!due_to_speed_up(distance, dynamics)) return;
  const Blending blending = blending_into(*running_[kBuffered]);
  const double own = std::abs(single_.target_velocity());
  const double velocity = highest_junction_velocity(distance, junction_velocity_, blending, dynamics);
  junction_velocity_ = 0.0;
  if (velocity <= own) return;
  dynamics.velocity = velocity;
  single_.move_to(base_setpoint(), single_.target(), distance, dynamics, std::copysign(velocity, distance));
}

/// Whether in the next cycle it would be too late to reach the velocity of these dynamics in a distance.
bool Axis::due_to_speed_up(double distance, const Dynamics& dynamics) const noexcept {
  const Setpoint& now = base_setpoint();
  const double heading = distance < 0.0 ? -1.0 : 1.0;
  const double velocity = heading * now.velocity;
  const double most = std::max(dynamics.velocity, std::abs(velocity)) + 1.0;
  const ProfileLimits limits{.velocity_max = most,
                             .velocity_min = -most,
                             .acceleration = dynamics.acceleration,
                             .deceleration = dynamics.deceleration,
                             .jerk = dynamics.jerk};
  Profile rise;
  if (plan_velocity({0.0, velocity, heading * now.acceleration}, dynamics.velocity, limits, rise) !=
      PlanResult::ok)
    return false;
  return std::abs(distance) - std::abs(velocity) * period_ <= rise.target().position;
}

/// What the next motion is like, seen from the target of the running one.
Axis::Blending Axis::blending_into(const Job& next) noexcept {
  Blending blending{.way = 0.0, .endless = false, .dynamics = effective_dynamics(next)};
  switch (next.kind) {
    case JobKind::MC_MoveAbsolute:
      blending.way = absolute_distance(next, single_.target().value);
      break;
    case JobKind::MC_MoveRelative:
      blending.way = next.position;
      break;
    case JobKind::MC_MoveVelocity:
      blending.way = next.current ? single_.target_velocity() : next.velocity;  // its direction
      blending.endless = true;
      break;
    default:  // MC_Halt: wherever the axis comes to rest, but in the direction in which it goes
      blending.way = rounded_difference(single_.target(), base_setpoint().position, modulo_);
      blending.endless = true;
      blending.dynamics.velocity = 0.0;
      break;
  }
  return blending;
}

double Axis::wanted_blending_velocity(BufferMode mode, double previous, double next) const noexcept {
  switch (mode) {
    case BufferMode::mcBlendingLow:
      return std::min(previous, next);
    case BufferMode::mcBlendingPrevious:
      return previous;
    case BufferMode::mcBlendingNext:
      return next;
    default:
      return std::max(previous, next);
  }
}

/// Whether the next motion, begun up to a cycle behind the target, comes to rest in front of its own.
bool Axis::next_can_take_over(const Blending& next, double velocity) const noexcept {
  if (next.endless) return true;
  const double most = std::max(velocity, next.dynamics.velocity) + 1.0;
  const ProfileLimits limits{.velocity_max = most,
                             .velocity_min = -most,
                             .acceleration = next.dynamics.acceleration,
                             .deceleration = next.dynamics.deceleration,
                             .jerk = next.dynamics.jerk};
  Profile stop;
  if (plan_stop({0.0, velocity, 0.0}, limits, PresentAcceleration::keep, stop) != PlanResult::ok)
    return false;
  return stop.target().position + velocity * period_ <= std::abs(next.way);
}

}  // namespace lockstep
