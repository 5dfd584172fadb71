#include "tech_objects/synchronous/shift.hpp"

#include <cmath>

namespace lockstep {
namespace {

/// Most that a shift's own velocity, and its acceleration, may make of its distance over the leading
/// distance, as a multiple of that distance.
constexpr double kSteepestShift = 20.0;

}  // namespace

PlanResult Shift::begin(const ShiftRequest& request, double period) noexcept {
  const MotionState from{0.0, velocity_, acceleration_};
  const bool over_time = request.rule == ShiftRule::dynamics;
  const bool moving = moves();
  Profile profile;
  PlanResult result = PlanResult::ok;
  if (over_time) {
    result = plan_position(from, (request.target - value_).rounded(), 0.0, request.limits, profile);
  } else if (moving) {
    result = plan_stop(from, request.limits, PresentAcceleration::keep, profile);
  }
  if (result != PlanResult::ok) return result;
  request_ = request;
  profile_ = profile;
  settling_ = moving && !over_time;
  period_ = period;
  base_ = value_;
  ticks_ = 0;
  heading_ = 0.0;
  covered_ = 0.0;
  planned_ = false;
  in_use_ = true;
  phase_ = over_time ? Phase::running : Phase::waiting;
  return PlanResult::ok;
}

void Shift::settle_at(DoubleDouble value, const Shift& moving, const ProfileLimits& limits,
                      double period) noexcept {
  const MotionState from{0.0, moving.velocity_, moving.acceleration_};
  start_at(value);
  if (!moving.moves()) return;
  if (plan_stop(from, limits, PresentAcceleration::keep, profile_) != PlanResult::ok) return;
  velocity_ = from.velocity;
  acceleration_ = from.acceleration;
  base_ = value;
  period_ = period;
  ticks_ = -1;  // the next tick shows the value
  settling_ = true;
  in_use_ = true;
}

void Shift::halt() noexcept {
  phase_ = Phase::resting;
  settling_ = false;
  velocity_ = 0.0;
  acceleration_ = 0.0;
}

Shift::Event Shift::wait_or_follow_time(const LeadingStep& step) noexcept {
  if (phase_ == Phase::waiting && may_start(step)) {
    phase_ = Phase::running;
    if (can_lead_on(step)) settling_ = false;
  }
  if (settling_) {
    settling_ = follow_profile();
    return Event::none;
  }
  if (phase_ != Phase::running) return Event::none;
  return request_.rule == ShiftRule::dynamics ? follow_time() : follow_leading(step);
}

/// Whether the leading value can lead a moving shift on. One that stands, turns or creeps cannot: over its
/// distance the shift would have to shoot far beyond its target. Then it comes to rest first.
bool Shift::can_lead_on(const LeadingStep& step) const noexcept {
  if (!(step.distance() * step.last.velocity > 0.0)) return false;
  const SyncOffset start = remainder_at_start(step);
  const double distance = to_start_ + request_.distance;
  const double maximum = kSteepestShift * std::abs(start.position);
  return std::abs(start.slope) * distance <= maximum &&
         std::abs(start.curvature) * distance * distance <= maximum;
}

/// What is left of the shift at the last tick, over the distance of the leading value.
SyncOffset Shift::remainder_at_start(const LeadingStep& step) const noexcept {
  SyncOffset start{.position = (value_ - request_.target).rounded()};
  const double heading = std::copysign(1.0, step.distance());
  const double distance_velocity = heading * step.last.velocity;
  if (!(distance_velocity > 0.0)) return start;
  start.slope = velocity_ / distance_velocity;
  start.curvature = (acceleration_ - start.slope * heading * step.last.acceleration) /
                    (distance_velocity * distance_velocity);
  return start;
}

/// From here: starts where it is, if the leading value stands or moves in its direction; else at the last
/// tick before the start position is crossed.
bool Shift::may_start(const LeadingStep& step) noexcept {
  const double distance = step.distance();
  const int heading = distance > 0.0 ? 1 : distance < 0.0 ? -1 : 0;
  to_start_ = 0.0;
  if (heading == 0) return request_.rule == ShiftRule::from_here && request_.direction == 0;
  if (request_.direction * heading < 0) return false;
  if (request_.rule == ShiftRule::from_here) return true;
  const double from = step.last.position.value;
  const double target = normalised({0, request_.start_position}, step.modulo).value;
  if (!step.modulo.enabled) {
    to_start_ = heading * (target - from);
  } else if (target != from) {
    to_start_ = heading > 0 ? positive_distance(from, target, step.modulo)
                            : -negative_distance(from, target, step.modulo);
  }
  return to_start_ >= 0.0 && to_start_ <= std::abs(distance);
}

/// From the shift of the last tick, with its velocity and acceleration, to the target; once the leading value
/// moves. @return whether it does
[[gnu::noinline]] bool Shift::start_over_distance(const LeadingStep& step) noexcept {
  const double distance = step.distance();
  if (!(distance != 0.0)) return false;
  heading_ = std::copysign(1.0, distance);
  remainder_.set(remainder_at_start(step), to_start_ + request_.distance);
  covered_ = 0.0;
  planned_ = true;
  return true;
}

/// The leading value has turned back.
[[gnu::noinline]] Shift::Event Shift::reverse() noexcept {
  halt();
  return Event::reversed;
}

Shift::Event Shift::follow_time() noexcept {
  return follow_profile() ? Event::none : arrive();
}

/// One tick along the profile over time; false at its end.
bool Shift::follow_profile() noexcept {
  const double t = static_cast<double>(++ticks_) * period_;
  const MotionState state = profile_.at(t);
  value_ = base_ + state.position;
  velocity_ = state.velocity;
  acceleration_ = state.acceleration;
  return t < profile_.duration();
}

[[gnu::noinline]] Shift::Event Shift::arrive() noexcept {
  halt();
  value_ = request_.target;
  return Event::done;
}

}  // namespace lockstep
