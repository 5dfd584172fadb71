#include "tech_objects/axis/position_range.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/axis/rounding.hpp"
#include "tech_objects/axis/stopping_distance.hpp"
#include "tech_objects/axis/turning_back.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep {

void RangeOrders::watch() noexcept {
  // A setpoint that has just been taken up does not come out of the last one.
  const bool generated = power_state_ == PowerState::on && has_bit(data.StatusWord, StatusBit::Enable);
  if (generated && !modulo_.enabled && keep_in(1)) keep_in(-1);
  const double here = setpoint_.position.value;
  if (std::abs(here) <= kPositionRange * (1.0 + kRelativeRounding)) return;
  const int side = sign(here);
  if (side * setpoint_.velocity > 0.0 || side * (here - last_setpoint_.position.value) > 0.0) pass_end();
}

/// @return whether the setpoint made for this cycle stays; if not, another one has been made
bool RangeOrders::keep_in(int side) noexcept {
  const double here = side * setpoint_.position.value;
  const double margin = std::max(kEndOfRange - here, 0.0);
  const Dynamics dynamics = limits_.maximum();
  Setpoint from = setpoint_;  // as a stop begins
  from.acceleration = limits_.tolerable_acceleration(from.acceleration, limits_.margin(from));
  const Heading heading{from, side};
  if (maximum_stopping_distance(heading, dynamics) <= margin) return true;
  // A target may be the very end.
  if (turns_in_time(side, std::max(kPositionRange * (1.0 + kRelativeRounding) - here, 0.0), dynamics.jerk,
                    motion_, setpoint_, single_, superimposed_))
    return true;
  if (stopping_distance(heading, dynamics) <= margin) return true;
  constexpr auto kReaction = AlarmReaction::stop_maximum;
  const bool reacts =
      data.ErrorDetail.Reaction < static_cast<DINT>(kReaction) && !jobs_.stops_harder_than(kReaction);
  if (reacts) setpoint_ = last_setpoint_;
  reactions_.raise(
      alarm::kPositionRangeReached, kReaction,
      {.cause = side_of(side), .value = setpoint_.position.value, .limit = side * kPositionRange});
  if (reacts) single_.advance(setpoint_);
  return !reacts;
}

void RangeOrders::pass_end() noexcept {
  const bool reacts = power_state_ == PowerState::on &&
                      data.ErrorDetail.Reaction < static_cast<DINT>(AlarmReaction::remove_enable);
  if (reacts) setpoint_ = last_setpoint_;
  reactions_.raise(alarm::kPositionRangeExceeded,
                   {.cause = side_of(sign(setpoint_.position.value)),
                    .value = setpoint_.position.value,
                    .limit = std::copysign(kPositionRange, setpoint_.position.value)});
  if (!reacts) return;  // it brakes already
  if (motion_ == AxisMotion::single_axis)
    single_.advance(setpoint_);
  else  // the drive brakes; the setpoint is the actual value from the next tick on
    setpoint_.position = advanced(setpoint_.position, setpoint_.velocity * period_, modulo_);
}

}  // namespace lockstep
