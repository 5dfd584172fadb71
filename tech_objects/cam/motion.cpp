#include "tech_objects/cam/motion.hpp"

#include <cmath>

namespace lockstep {
namespace {

constexpr double kCloses = 1e-9;  // of the stroke: how far both ends of a cyclic cam may be apart
constexpr double kRests = 1e-9;   // of the stroke per pass: slope of a cam at rest
constexpr double kMaximumPasses = 0x1p62;
constexpr double kBeside = 0x1p-40;  // of a pass: how far beside a corner its slope is read

/// Whole numbers up to here are doubles.
constexpr std::int64_t kWhole = std::int64_t{1} << 53;

/// A whole number of times a value, as exactly as the value is known.
DoubleDouble times(std::int64_t number, DoubleDouble value) noexcept {
  if (number <= -kWhole || number >= kWhole) return to_double_double(number) * value;
  const auto factor = static_cast<double>(number);
  return two_product(value.hi, factor) + value.lo * factor;
}

/// Whole turns in a following value.
double turns_in(double value, const Modulo& modulo) noexcept {
  return std::floor(value / modulo.length + 0.5);
}

DoubleDouble gap_of(const CamFunction& function, double slave_scaling) noexcept {
  return two_difference(function.end_following_value(), function.start_following_value()) * slave_scaling;
}

}  // namespace

bool CamFollowing::closes(const CamFunction& function, double slave_scaling,
                          const Modulo& following) noexcept {
  const double stroke = function.highest_following_value() - function.lowest_following_value();
  DoubleDouble gap = gap_of(function, slave_scaling);
  if (following.enabled) gap = gap - two_product(turns_in(gap.hi, following), following.length);
  return std::abs(gap.hi) <= kCloses * stroke * std::abs(slave_scaling);
}

void CamFollowing::set(const CamFunction& function, const CamUse& use, AxisPosition place,
                       DoubleDouble from_start, const Modulo& leading, const Modulo& following) noexcept {
  set_start(function, use, place.turns, -from_start + place.value, leading, following);
  last_rest_ = enter_pass(place, 0).hi;
  ended_ = CamEnd::none;
}

void CamFollowing::set_start(const CamFunction& function, const CamUse& use, std::int64_t start_turns,
                             DoubleDouble start_value, const Modulo& leading,
                             const Modulo& following) noexcept {
  function_ = &function;
  use_ = use;
  start_ = start_value;
  start_turns_ = start_turns;
  leading_ = leading;
  following_ = following;
  backward_ = use.master_scaling < 0.0;
  scaling_ = std::abs(use.master_scaling);
  per_scaling_ = 1.0 / scaling_;
  first_ = function.start_leading_value();
  pass_ = two_difference(function.end_leading_value(), first_) * scaling_;
  slope_ = use.slave_scaling / use.master_scaling;
  curvature_ = slope_ / use.master_scaling;
  per_pass_ = DoubleDouble{};
  const DoubleDouble gap = gap_of(function, use.slave_scaling);
  if (use.mode == CamMode::appended) per_pass_ = gap;
  if (use.mode == CamMode::cyclic && following.enabled)
    per_pass_ = two_product(turns_in(gap.hi, following), following.length);
  lowest_ = following.enabled ? following.start : -std::numeric_limits<double>::infinity();
  highest_ = following.enabled ? following.end() : std::numeric_limits<double>::infinity();
  hint_ = CamHint{};
  added_turns_ = 0;
  pass_number_ = 0;
  turn_ = 0;
  base_ = base_of(0, 0);
  lift_ = lift_of(0);
  last_rest_ = 0.0;
  ended_ = CamEnd::none;
}

void CamFollowing::add_turns(std::int64_t turns) noexcept {
  added_turns_ += turns;
  lift_ = lift_of(pass_number_);
}

void CamFollowing::add_leading_turns(std::int64_t turns) noexcept {
  start_turns_ += turns;
}

/// What has to be added to the distance within a leading turn so that it counts from the start of a pass.
DoubleDouble CamFollowing::base_of(std::int64_t turn, std::int64_t pass) const noexcept {
  const DoubleDouble turns =
      leading_.enabled ? two_product(leading_.length, static_cast<double>(turn)) : DoubleDouble{};
  const DoubleDouble passes = times(pass, pass_);
  return backward_ ? turns + passes : turns - passes;
}

CamFollowing::Pass CamFollowing::pass_at(AxisPosition leading) const noexcept {
  const std::int64_t turn = wrapped(leading.turns, start_turns_);
  const DoubleDouble distance = from_start(leading.value);
  Pass pass{0, base_of(turn, 0), {}};
  pass.rest = rest_in(pass.base, distance);
  if (use_.mode == CamMode::once) return pass;
  const double count = std::floor(pass.rest.hi / pass_.hi);
  if (!(std::abs(count) < kMaximumPasses)) return pass;  // not finite, or beyond what is counted
  const auto move = [&](std::int64_t number) noexcept {
    pass.number = number;
    pass.base = base_of(turn, number);
    pass.rest = rest_in(pass.base, distance);
  };
  move(static_cast<std::int64_t>(count));
  if (std::abs(count) >= 0x1p50)  // the quotient is rounded, to several passes as the case may be
    move(pass.number + static_cast<std::int64_t>(std::floor(pass.rest.hi / pass_.hi)));
  if (pass.rest.hi < 0.0)
    move(pass.number - 1);
  else if (!(pass.rest < pass_))
    move(pass.number + 1);
  return pass;
}

DoubleDouble CamFollowing::enter_pass(AxisPosition leading, std::int64_t turn) noexcept {
  const Pass pass = pass_at(leading);
  const CamEnd end = end_between(pass.rest.hi, pass.number);
  if (end != CamEnd::none) ended_ = end;
  turn_ = turn;
  base_ = pass.base;
  if (pass.number != pass_number_) {
    pass_number_ = pass.number;
    lift_ = lift_of(pass.number);
  }
  return pass.rest;
}

CamEnd CamFollowing::end_between(double rest, std::int64_t pass) const noexcept {
  if (use_.mode != CamMode::once) {
    if (pass == pass_number_) return CamEnd::none;
    return pass > pass_number_ ? CamEnd::at_end : CamEnd::at_start;
  }
  if (rest > pass_.hi || (rest == pass_.hi && last_rest_ < rest)) return CamEnd::at_end;
  if (rest < 0.0 || (rest == 0.0 && last_rest_ > rest)) return CamEnd::at_start;
  return CamEnd::none;
}

CamEnd CamFollowing::end_before(AxisPosition leading) const noexcept {
  const Pass pass = pass_at(leading);
  return end_between(pass.rest.hi, pass.number);
}

/// What the passes before have added, on the ring of the following axis.
CamFollowing::Lift CamFollowing::lift_of(std::int64_t pass) const noexcept {
  Lift lift{added_turns_, times(pass, per_pass_)};
  if (!following_.enabled) return {0, lift.value};
  const double turns = std::floor(lift.value.hi / following_.length);
  if (!(std::abs(turns) < 0x1p52)) return lift;
  lift.value = lift.value - two_product(following_.length, turns);
  lift.turns += static_cast<std::int64_t>(turns);
  return lift;
}

AxisPosition CamFollowing::raised(double following_value, const Lift& lift) const noexcept {
  return normalised(lift.turns, two_product(following_value, use_.slave_scaling) + lift.value, following_);
}

CamFollowingValue CamFollowing::joined_at(AxisPosition leading, int direction) const noexcept {
  const Pass pass = pass_at(leading);
  const AxisPosition position =
      raised(function_->value(first_ + pass.rest.hi * per_scaling_).position, lift_of(pass.number));
  const bool along = (direction > 0) != backward_;
  double beside = pass.rest.hi + (along ? kBeside : -kBeside) * pass_.hi;
  if (use_.mode != CamMode::once) {
    if (beside < 0.0) beside += pass_.hi;
    if (beside >= pass_.hi) beside -= pass_.hi;
  }
  const CamValue value = function_->value(first_ + beside * per_scaling_);
  const double slope = steepness(value) <= kRests ? 0.0 : value.first_derivative;
  return {position, slope * slope_, value.second_derivative * curvature_};
}

CamFollowing::LeadingPosition CamFollowing::end_place(CamEnd end) const noexcept {
  // rest = ±(value - start + base) = pass or 0
  const DoubleDouble rest = end == CamEnd::at_end ? pass_ : DoubleDouble{};
  return {start_turns_ + turn_, start_ - base_ + (backward_ ? -rest : rest)};
}

AxisPosition CamFollowing::end_position(CamEnd end) const noexcept {
  return raised(end == CamEnd::at_end ? function_->end_following_value() : function_->start_following_value(),
                lift_);
}

bool CamFollowing::rests_at(CamEnd end) const noexcept {
  return steepness(function_->value(end == CamEnd::at_end ? function_->end_leading_value() : first_)) <=
         kRests;
}

double CamFollowing::steepness(const CamValue& value) const noexcept {
  if (use_.slave_scaling == 0.0) return 0.0;
  const double stroke = function_->highest_following_value() - function_->lowest_following_value();
  if (!(stroke > 0.0)) return 0.0;
  return std::abs(value.first_derivative) * (function_->end_leading_value() - first_) / stroke;
}

double CamFollowing::distance(AxisPosition leading) const noexcept {
  const std::int64_t turn = wrapped(leading.turns, start_turns_);
  return rest_in(base_of(turn, 0), from_start(leading.value)).hi;
}

}  // namespace lockstep
