// What an axis watches over: range of positions, software limit switches.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/stopping_distance.hpp"

namespace lockstep {
namespace {

/// What positions and ways may be apart by rounding, relative to their size.
constexpr double kRounding = 1e-12;

/// Where an axis comes to rest at the latest that nears the end of its range [u]: before the end by more than
/// the stop may be rounded.
constexpr double kEndOfRange = kPositionRange * (1.0 - kRounding);

}  // namespace

// ---- Software limit switches
// --------------------------------------------------------------------------------------

/// Each cycle in which the limits are active, after the setpoint has been made: where the next one could no
/// longer stop in front of a limit, the axis has to brake from the last one on.
void AxisOrders::watch_position_limits() noexcept {
  const SoftwareLimits::Range range = SoftwareLimits::in_effect(data.PositionLimits_SW, modulo_);
  if (range.contradictory()) raise(alarm::kSoftwareLimits);
  if (!homed_ || range.contradictory()) return software_limits_.release();
  const bool controlled = power_state_ == PowerState::on || power_state_ == PowerState::braking;
  const bool moves = software_limits_.hold(range, setpoint_, last_setpoint_, controlled);
  if (moves && keep_within(1, software_limits_.limit(1))) keep_within(-1, software_limits_.limit(-1));
  const bool arriving = motion_ == Motion::single_axis && !single_.finished() &&
                        single_.aim() == SingleAxisMotion::Aim::position && jobs_.empty(kBase);
  software_limits_.show(range, setpoint_.position.value, arriving);
}

/// @param side 1 for the positive limit, -1 for the negative one  @param limit [u] on the present turn
/// @return whether the setpoint made for this cycle stays; if not, another one has been made
bool AxisOrders::keep_within(int side, double limit) noexcept {
  if (!std::isfinite(limit)) return true;
  const AxisPosition border{last_setpoint_.position.turns, limit};
  const double room = side * rounded_difference(border, setpoint_.position, modulo_);
  const Dynamics dynamics = limit_dynamics();
  const Heading heading{setpoint_, side};
  if (maximum_stopping_distance(heading, dynamics) <= room) return true;
  const double slack = kRounding * (1.0 + std::abs(limit));
  if (turns_in_time(side, room + slack, dynamics.jerk)) return true;
  if (stopping_distance(heading, dynamics) <= room + slack) return true;
  stop_at_limit(side, border, dynamics);
  return false;
}

/// Whether the axis comes to rest or turns back in front of the limit by what it does anyway.
bool AxisOrders::turns_in_time(int side, double room, double jerk) const noexcept {
  if (motion_ == Motion::single_axis) {
    const double added = superimposed_.in_use() ? superimposed_.distance_left(side) : 0.0;
    return single_.way_left(side) + added <= room;
  }
  return Heading{setpoint_, side}.turning_back_within(room, jerk);
}

/// What the axis brakes with in front of a limit: the values of its job only if it moves on its own.
Dynamics AxisOrders::limit_dynamics() const noexcept {
  const bool current = data.PositionLimits_SW.LimitReachedBehavior == 1 && motion_ == Motion::single_axis;
  return current ? single_.dynamics() : limits_.maximum();
}

/// From the last setpoint to rest at the limit. When that is too near, the axis stops behind it, by the
/// reactions of the alarms.
void AxisOrders::stop_at_limit(int side, AxisPosition limit, Dynamics dynamics) noexcept {
  const AlarmReaction reaction = reaction_at_limit();
  const bool reacts = power_state_ == PowerState::on &&
                      data.ErrorDetail.Reaction < static_cast<DINT>(reaction) &&
                      !jobs_.stops_harder_than(reaction);
  const Setpoint made = setpoint_;
  setpoint_ = last_setpoint_;
  cut_acceleration();
  const double room = side * rounded_difference(limit, setpoint_.position, modulo_);
  const Heading heading{setpoint_, side};
  const bool possible = find_braking(heading, room, limits_.maximum(), dynamics);
  raise(alarm::kSoftwareLimitReached, reaction);
  absorb_superimposed();
  set_bit(data.WarningWord, side > 0 ? WarningBit::SWLimitMax : WarningBit::SWLimitMin, true);
  software_limits_.approach(side);
  if (possible) {
    const double reached =
        std::max(Heading{setpoint_, side}.velocity_reached(dynamics.jerk), side * made.velocity);
    // Led by another axis it may be faster than its own limit.
    const double most = std::max(limits_.velocity(), std::abs(setpoint_.velocity));
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

AlarmReaction AxisOrders::reaction_at_limit() const noexcept {
  const bool current = data.PositionLimits_SW.LimitReachedBehavior == 1 && !led();
  return current ? AlarmReaction::stop_current : AlarmReaction::stop_maximum;
}

/// With no higher velocity than it reaches anyway, though there may be room for that.
void AxisOrders::approach_limit(double way, AxisPosition limit, const Dynamics& dynamics) noexcept {
  leave_synchronous();
  motion_ = Motion::single_axis;
  if (single_.move_to(setpoint_, limit, way, dynamics) != PlanResult::ok)
    return begin_stop(limits_.maximum(), false);
  single_.advance(setpoint_);
}

// ---- Range of positions
// --------------------------------------------------------------------------------------

/// Whether the axis, stopped with maximum dynamics, comes to rest far inside of the range of positions, from
/// few operations and without a division: `maximum_stopping_distance` ≤ margin, times 4 · deceleration ·
/// jerk². Else, or without such limits, `watch_range` looks closely.
bool AxisOrders::far_from_end_of_range() const noexcept {
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
void AxisOrders::watch_range() noexcept {
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
bool AxisOrders::keep_in_range(int side) noexcept {
  const double here = side * setpoint_.position.value;
  const double room = std::max(kEndOfRange - here, 0.0);
  const Dynamics dynamics = limits_.maximum();
  Setpoint from = setpoint_;  // as a stop begins
  from.acceleration = limits_.tolerable_acceleration(from.acceleration, limits_.margin(from));
  const Heading heading{from, side};
  if (maximum_stopping_distance(heading, dynamics) <= room) return true;
  // A target may be the very end.
  if (turns_in_time(side, std::max(kPositionRange * (1.0 + kRounding) - here, 0.0), dynamics.jerk))
    return true;
  if (stopping_distance(heading, dynamics) <= room) return true;
  constexpr auto kReaction = AlarmReaction::stop_maximum;
  const bool reacts =
      data.ErrorDetail.Reaction < static_cast<DINT>(kReaction) && !jobs_.stops_harder_than(kReaction);
  if (reacts) setpoint_ = last_setpoint_;
  raise(alarm::kPositionRangeReached, kReaction);
  if (reacts) single_.advance(setpoint_);
  return !reacts;
}

void AxisOrders::pass_end_of_range() noexcept {
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
