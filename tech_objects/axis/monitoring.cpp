// What an axis watches over: range of positions, software limit switches.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {
namespace {

/// What positions and ways may be apart by rounding, relative to their size.
constexpr double kRounding = 1e-12;

/// Where an axis comes to rest at the latest that nears the end of its range [u]: before the end by more than
/// the stop may be rounded.
constexpr double kEndOfRange = kPositionRange * (1.0 - kRounding);

/// The state of motion as seen in one direction.
struct Heading {
  double velocity;
  double acceleration;

  Heading(const Setpoint& setpoint, int side) noexcept
      : velocity{side * setpoint.velocity}, acceleration{side * setpoint.acceleration} {}
};

/// A way that a stop does not exceed, from few operations: the present acceleration is run down, then the
/// velocity; the time of the latter is at most v/d + d/j.
double most_stopping_way(const Heading& from, const Dynamics& dynamics) noexcept {
  const double a = std::max(from.acceleration, 0.0);
  if (dynamics.jerk <= 0.0) {
    const double v = std::max(from.velocity, 0.0);
    return v * v / (2.0 * dynamics.deceleration);
  }
  const double run_down = a / dynamics.jerk;
  const double v = from.velocity + 0.5 * a * run_down;
  if (v <= 0.0) return 0.0;
  return v * (run_down + 0.5 * (v / dynamics.deceleration + dynamics.deceleration / dynamics.jerk));
}

/// The velocity from which the axis brakes, once its acceleration is run down.
double velocity_reached(const Heading& from, double jerk) noexcept {
  const double a = std::max(from.acceleration, 0.0);
  return from.velocity + (jerk > 0.0 ? a * a / (2.0 * jerk) : 0.0);
}

/// Whether the axis brakes so hard that it turns back before the deceleration can be run down.
bool turning_back(const Heading& heading, double jerk) noexcept {
  const double a = heading.acceleration;
  return heading.velocity > 0.0 && a < 0.0 && jerk > 0.0 && a * a >= 2.0 * jerk * heading.velocity;
}

/// The way that the axis still makes in a direction if it stops at once [u] ≥ 0.
double stopping_way(const Setpoint& from, int side, const Dynamics& dynamics) noexcept {
  const Heading heading{from, side};
  const double v = heading.velocity;
  const double a = heading.acceleration;
  if (v <= 0.0 && (a <= 0.0 || dynamics.jerk <= 0.0)) return 0.0;
  if (turning_back(heading, dynamics.jerk)) {
    const double t = (-a - std::sqrt(a * a - 2.0 * dynamics.jerk * v)) / dynamics.jerk;
    return t * (v + t * (0.5 * a + t * dynamics.jerk * (1.0 / 6.0)));
  }
  const double velocity = std::max(dynamics.velocity, v) + 1.0;  // no limit to a stop; the planner wants one
  const ProfileLimits limits{.velocity_max = velocity,
                             .velocity_min = -velocity,
                             .acceleration = dynamics.acceleration,
                             .deceleration = dynamics.deceleration,
                             .jerk = dynamics.jerk};
  Profile profile;
  if (plan_stop({0.0, v, a}, limits, PresentAcceleration::keep, profile) != PlanResult::ok)
    return std::numeric_limits<double>::infinity();
  return std::max(profile.target().position, 0.0);
}

}  // namespace

// ---- Software limit switches
// --------------------------------------------------------------------------------------

/// The software limit switches in effect. On a ring they count when they lie on it; one that does not is put
/// at the border of the ring, and two have no effect.
/// @source S7-1500T axis functions, traversing range limitation
Axis::PositionLimits Axis::position_limits() const noexcept {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double least = data.PositionLimits_SW.MinPosition;
  double greatest = data.PositionLimits_SW.MaxPosition;
  if (modulo_.enabled) {
    const bool least_counts = modulo_.contains(least);
    const bool greatest_counts = modulo_.contains(greatest);
    if (!least_counts && !greatest_counts) return {-kNone, kNone};
    if (!least_counts) least = modulo_.start;
    if (!greatest_counts) greatest = std::nextafter(modulo_.end(), modulo_.start);
  }
  return {least, greatest};
}

/// Each cycle in which the limits are active, after the setpoint has been made: where the next one could no
/// longer stop in front of a limit, the axis has to brake from the last one on.
void Axis::watch_position_limits() noexcept {
  const PositionLimits limits = position_limits();
  const bool contradict = limits.least > limits.greatest;  // a program may have written them
  if (contradict) raise(alarm::kSoftwareLimits);
  if (!homed_ || contradict) {
    limit_side_ = 0;
    return;
  }
  // A setpoint that has just been taken up does not come out of the last one.
  const bool controlled = power_state_ == PowerState::on || power_state_ == PowerState::braking;
  const bool generated = controlled && was_controlled_;
  was_controlled_ = controlled;
  const bool rests = setpoint_.standing() && setpoint_.position == last_setpoint_.position;
  const bool moves = generated && !rests;
  hold_limits(limits, !moves);
  if (moves && keep_within(1, held_limits_.greatest)) keep_within(-1, held_limits_.least);
  show_limit(limits);
}

/// An axis outside has its limit where it stands; in motion, where it has been furthest outside since. (A
/// limit that came along with every cycle could not be kept by an axis that turns around.)
void Axis::hold_limits(const PositionLimits& limits, bool rests) noexcept {
  const double here = rests ? setpoint_.position.value : last_setpoint_.position.value;
  const double highest = !rests && limit_side_ > 0 ? std::max(held_limits_.greatest, here) : here;
  const double lowest = !rests && limit_side_ < 0 ? std::min(held_limits_.least, here) : here;
  held_limits_.greatest = here > limits.greatest ? highest : limits.greatest;
  held_limits_.least = here < limits.least ? lowest : limits.least;
}

void Axis::show_limit(const PositionLimits& limits) noexcept {
  const double position = setpoint_.position.value;
  limit_side_ = 0;
  if (position >= limits.greatest) limit_side_ = 1;
  if (position <= limits.least) limit_side_ = -1;
  if (approached_side_ == 0) return;
  const bool arriving = motion_ == Motion::single_axis && !single_.finished() &&
                        single_.aim() == SingleAxisMotion::Aim::position && running_[kBase] == nullptr;
  if (!arriving) approached_side_ = 0;
  if (limit_side_ == 0) limit_side_ = approached_side_;
}

/// @param side 1 for the positive limit, -1 for the negative one  @param limit [u] on the present turn
/// @return whether the setpoint made for this cycle stays; if not, another one has been made
bool Axis::keep_within(int side, double limit) noexcept {
  if (!std::isfinite(limit)) return true;
  const AxisPosition border{last_setpoint_.position.turns, limit};
  const double room = side * rounded_difference(border, setpoint_.position, modulo_);
  const Dynamics dynamics = limit_dynamics();
  if (most_stopping_way({setpoint_, side}, dynamics) <= room) return true;
  const double slack = kRounding * (1.0 + std::abs(limit));
  if (turns_in_time(side, room + slack, dynamics.jerk)) return true;
  if (stopping_way(setpoint_, side, dynamics) <= room + slack) return true;
  stop_at_limit(side, border, dynamics);
  return false;
}

/// Whether the axis comes to rest or turns back in front of the limit by what it does anyway.
bool Axis::turns_in_time(int side, double room, double jerk) const noexcept {
  if (motion_ == Motion::single_axis) {
    const double added = superimposed_.in_use() ? superimposed_.way_left(side) : 0.0;
    return single_.way_left(side) + added <= room;
  }
  const Heading heading{setpoint_, side};
  const double v = heading.velocity;
  return turning_back(heading, jerk) && v * v <= -2.0 * heading.acceleration * room;
}

/// What the axis brakes with in front of a limit: the values of its job only if it moves on its own.
Dynamics Axis::limit_dynamics() const noexcept {
  const bool current = data.PositionLimits_SW.LimitReachedBehavior == 1 && motion_ == Motion::single_axis;
  return current ? single_.dynamics() : maximum_dynamics();
}

/// Dynamic values with which the axis comes to rest within a way: those given, or else the highest, or else
/// these without jerk limit. False: it cannot be done.
bool Axis::find_braking(int side, double room, Dynamics& dynamics) const noexcept {
  const double most = room + kRounding * (1.0 + room);
  if (stopping_way(setpoint_, side, dynamics) <= most) return true;
  dynamics = maximum_dynamics();
  if (stopping_way(setpoint_, side, dynamics) <= most) return true;
  dynamics.jerk = 0.0;
  return stopping_way(setpoint_, side, dynamics) <= most;
}

/// From the last setpoint to rest at the limit. When that is too near, the axis stops behind it, by the
/// reactions of the alarms.
void Axis::stop_at_limit(int side, AxisPosition limit, Dynamics dynamics) noexcept {
  const AlarmReaction reaction = reaction_at_limit();
  const bool reacts = power_state_ == PowerState::on &&
                      data.ErrorDetail.Reaction < static_cast<DINT>(reaction) && !outranked_by_stop(reaction);
  const Setpoint made = setpoint_;
  setpoint_ = last_setpoint_;
  cut_acceleration();
  const double room = side * rounded_difference(limit, setpoint_.position, modulo_);
  const bool possible = find_braking(side, room, dynamics);
  raise(alarm::kSoftwareLimitReached, reaction);
  absorb_superimposed();
  set_bit(data.WarningWord, side > 0 ? WarningBit::SWLimitMax : WarningBit::SWLimitMin, true);
  approached_side_ = static_cast<std::int8_t>(side);
  if (possible) {
    const double reached = std::max(velocity_reached({setpoint_, side}, dynamics.jerk), side * made.velocity);
    // Led by another axis it may be faster than its own limit.
    const double most = std::max(velocity_limit(), std::abs(setpoint_.velocity));
    dynamics.velocity = reached > 0.0 ? std::min(reached, most) : most;
    return approach_limit(side * room, limit, dynamics);
  }
  if (reacts) {
    single_.advance(setpoint_);
  } else {
    setpoint_ = made;  // it brakes already
  }
  if (side * rounded_difference(setpoint_.position, limit, modulo_) > 0.0)
    raise(alarm::kSoftwareLimitPassed, data.PositionLimits_SW.LimitExceededBehavior == 1
                                           ? AlarmReaction::stop_emergency
                                           : AlarmReaction::remove_enable);
}

AlarmReaction Axis::reaction_at_limit() const noexcept {
  const bool current = data.PositionLimits_SW.LimitReachedBehavior == 1 && !led();
  return current ? AlarmReaction::stop_current : AlarmReaction::stop_maximum;
}

/// With no higher velocity than it reaches anyway, though there may be room for that.
void Axis::approach_limit(double way, AxisPosition limit, const Dynamics& dynamics) noexcept {
  leave_synchronous();
  motion_ = Motion::single_axis;
  if (single_.move_to(setpoint_, limit, way, dynamics) != PlanResult::ok)
    return begin_stop(maximum_dynamics(), false);
  single_.advance(setpoint_);
}

// ---- Range of positions
// --------------------------------------------------------------------------------------

/// Whether the axis, stopped with maximum dynamics, comes to rest far inside of the range of positions, from
/// few operations and without a division: `most_stopping_way` ≤ room, times 4 · deceleration · jerk². Else,
/// or without such limits, `watch_range` looks closely.
bool Axis::far_from_end_of_range() const noexcept {
  const double room = kEndOfRange - std::abs(setpoint_.position.value);
  if (modulo_.enabled) return room > 0.0;
  const double d = data.DynamicLimits.MaxDeceleration;
  const double j = data.DynamicLimits.MaxJerk;
  const double v = std::abs(setpoint_.velocity);
  const double a = std::abs(setpoint_.acceleration);
  const double reached = 2.0 * j * v + a * a;  // velocity once the acceleration is run down, times 2 · jerk
  return reached * (d * (2.0 * a + d) + 0.5 * reached) < 4.0 * room * d * j * j;
}

/// Near the end of what it can represent, the axis stops with maximum dynamics while it still comes to rest
/// inside (307). One that passes the end all the same, because it is too fast already or its setpoint is
/// given, loses its enable (308) and brakes from the last setpoint on, beyond the end. Acknowledged there, it
/// may come back.
/// @source S7-1500/S7-1500T alarms and error IDs, 307, 308
void Axis::watch_range() noexcept {
  // A setpoint that has just been taken up does not come out of the last one.
  const bool generated = power_state_ == PowerState::on && has_bit(data.StatusWord, StatusBit::Enable);
  if (generated && !modulo_.enabled && keep_in_range(1)) keep_in_range(-1);
  const double here = setpoint_.position.value;
  if (std::abs(here) <= kPositionRange * (1.0 + kRounding)) return;
  const int side = sign(here);
  if (side * setpoint_.velocity > 0.0 || side * (here - last_setpoint_.position.value) > 0.0)
    pass_end_of_range();
}

/// @return whether the setpoint made for this cycle stays; if not, another one has been made
bool Axis::keep_in_range(int side) noexcept {
  const double here = side * setpoint_.position.value;
  const double room = std::max(kEndOfRange - here, 0.0);
  const Dynamics dynamics = maximum_dynamics();
  Setpoint from = setpoint_;  // as a stop begins
  from.acceleration = tolerable_acceleration(from.acceleration, room_to_limit(from));
  if (most_stopping_way({from, side}, dynamics) <= room) return true;
  // A target may be the very end.
  if (turns_in_time(side, std::max(kPositionRange * (1.0 + kRounding) - here, 0.0), dynamics.jerk))
    return true;
  if (stopping_way(from, side, dynamics) <= room) return true;
  constexpr auto kReaction = AlarmReaction::stop_maximum;
  const bool reacts =
      data.ErrorDetail.Reaction < static_cast<DINT>(kReaction) && !outranked_by_stop(kReaction);
  if (reacts) setpoint_ = last_setpoint_;
  raise(alarm::kPositionRangeReached, kReaction);
  if (reacts) single_.advance(setpoint_);
  return !reacts;
}

void Axis::pass_end_of_range() noexcept {
  const bool reacts = power_state_ == PowerState::on &&
                      data.ErrorDetail.Reaction < static_cast<DINT>(AlarmReaction::remove_enable);
  if (reacts) setpoint_ = last_setpoint_;
  raise(alarm::kPositionRangeExceeded);
  if (!reacts) return;  // it brakes already
  if (motion_ == Motion::single_axis)
    single_.advance(setpoint_);
  else  // the drive brakes; the setpoint is the actual value from the next tick on
    setpoint_.position = advanced(setpoint_.position, setpoint_.velocity * period_, modulo_);
}

}  // namespace lockstep
