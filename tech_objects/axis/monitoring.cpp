#include "tech_objects/axis/monitoring.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/axis/rounding.hpp"
#include "tech_objects/axis/stopping_distance.hpp"
#include "tech_objects/axis/turning_back.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
// ---- Software limit switches

void LimitOrders::watch() noexcept {
  const SoftwareLimits::Range range = SoftwareLimits::in_effect(data.PositionLimits_SW, modulo_);
  if (range.contradictory())
    reactions_.raise(alarm::kSoftwareLimits, {.value = data.PositionLimits_SW.MinPosition,
                                              .limit = data.PositionLimits_SW.MaxPosition});
  if (!homed_ || range.contradictory()) return software_limits_.release();
  const bool controlled = power_state_ == PowerState::on || power_state_ == PowerState::braking;
  const bool moves = software_limits_.hold(range, setpoint_, last_setpoint_, controlled);
  if (moves && keep_within(1, software_limits_.limit(1))) keep_within(-1, software_limits_.limit(-1));
  const bool arriving = motion_ == AxisMotion::single_axis && !single_.finished() &&
                        single_.aim() == SingleAxisMotion::Aim::position && jobs_.empty(kBase);
  software_limits_.show(range, setpoint_.position.value, arriving);
}

/// @param side 1 for the positive limit, -1 for the negative one  @param limit [u] on the present turn
/// @return whether the setpoint made for this cycle stays; if not, another one has been made
bool LimitOrders::keep_within(int side, double limit) noexcept {
  if (!std::isfinite(limit)) return true;
  const AxisPosition border{last_setpoint_.position.turns, limit};
  const double margin = side * rounded_difference(border, setpoint_.position, modulo_);
  const Dynamics dynamics = limit_dynamics();
  const Heading heading{setpoint_, side};
  if (maximum_stopping_distance(heading, dynamics) <= margin) return true;
  const double slack = kRelativeRounding * (1.0 + std::abs(limit));
  if (turns_in_time(side, margin + slack, dynamics.jerk, motion_, setpoint_, single_, superimposed_))
    return true;
  if (stopping_distance(heading, dynamics) <= margin + slack) return true;
  stop_at_limit(side, border, dynamics);
  return false;
}

/// What the axis brakes with in front of a limit: the values of its job only if it moves on its own.
Dynamics LimitOrders::limit_dynamics() const noexcept {
  const bool current =
      data.PositionLimits_SW.LimitReachedBehavior == LimitReachedBehavior::current_dynamics &&
      motion_ == AxisMotion::single_axis;
  return current ? single_.dynamics() : limits_.maximum();
}

/// From the last setpoint to rest at the limit. When that is too near, the axis stops behind it, by the
/// reactions of the alarms.
void LimitOrders::stop_at_limit(int side, AxisPosition limit, Dynamics dynamics) noexcept {
  const AlarmReaction reaction = reaction_at_limit();
  const bool reacts = power_state_ == PowerState::on &&
                      data.ErrorDetail.Reaction < static_cast<DINT>(reaction) &&
                      !jobs_.stops_harder_than(reaction);
  const Setpoint made = setpoint_;
  setpoint_ = last_setpoint_;
  stops_.cut_acceleration();
  const double margin = side * rounded_difference(limit, setpoint_.position, modulo_);
  const Heading heading{setpoint_, side};
  const bool possible = find_braking(heading, margin, limits_.maximum(), dynamics);
  const AlarmDetail detail{.cause = side_of(side), .value = setpoint_.position.value, .limit = limit.value};
  reactions_.raise(alarm::kSoftwareLimitReached, reaction, detail);
  stops_.absorb_superimposed();
  set_bit(data.WarningWord, side > 0 ? WarningBit::SWLimitMax : WarningBit::SWLimitMin, true);
  software_limits_.approach(side);
  if (possible) {
    const double reached =
        std::max(Heading{setpoint_, side}.velocity_reached(dynamics.jerk), side * made.velocity);
    // Led by another axis it may be faster than its own limit.
    const double maximum = std::max(limits_.velocity(), std::abs(setpoint_.velocity));
    dynamics.velocity = reached > 0.0 ? std::min(reached, maximum) : maximum;
    return approach_limit(side * margin, limit, dynamics);
  }
  if (reacts) {
    single_.advance(setpoint_);
  } else {
    setpoint_ = made;  // it brakes already
  }
  if (side * rounded_difference(setpoint_.position, limit, modulo_) > 0.0)
    reactions_.raise(alarm::kSoftwareLimitPassed,
                     data.PositionLimits_SW.LimitExceededBehavior == LimitExceededBehavior::emergency_stop
                         ? AlarmReaction::stop_emergency
                         : AlarmReaction::remove_enable,
                     {.cause = side_of(side), .value = setpoint_.position.value, .limit = limit.value});
}

AlarmReaction LimitOrders::reaction_at_limit() const noexcept {
  const bool current =
      data.PositionLimits_SW.LimitReachedBehavior == LimitReachedBehavior::current_dynamics && !led(motion_);
  return current ? AlarmReaction::stop_current : AlarmReaction::stop_maximum;
}

/// With no higher velocity than it reaches anyway, though its limits may permit one.
void LimitOrders::approach_limit(double distance, AxisPosition limit, const Dynamics& dynamics) noexcept {
  coupling_.leave();
  motion_ = AxisMotion::single_axis;
  if (single_.move_to(setpoint_, limit, distance, dynamics) != PlanResult::ok)
    return stops_.begin(limits_.maximum(), false);
  single_.advance(setpoint_);
}

// ---- Hardware limit switches

void LimitOrders::hold_limit_switches() noexcept {
  if (power_state_ != PowerState::on && power_state_ != PowerState::braking) return;
  if (switches_.homing_reverses() || data.ErrorDetail.Number == alarm::kMarkNotFound) return;
  if (!limit_switches_.forbid(setpoint_.velocity)) return;
  const AlarmReaction reaction = limit_switches_.reaction(data.PositionLimits_HW);
  if (data.ErrorDetail.Reaction >= static_cast<DINT>(reaction)) return;  // it brakes already
  const Setpoint made = setpoint_;
  setpoint_ = last_setpoint_;
  reactions_.raise(alarm::kHardwareLimitSwitch, reaction,
                   {.cause = side_of(limit_switches_.beyond(1) ? 1 : -1), .value = setpoint_.position.value});
  if (power_state_ == PowerState::on) single_.advance(setpoint_);
  if (power_state_ == PowerState::braking) setpoint_ = made;
}

}  // namespace lockstep
