#include "tech_objects/synchronous/gear_function.hpp"

#include <cmath>
#include <limits>

namespace lockstep {
namespace {

constexpr double kUnitsPerOne = 0x1p62;  // Modulo.Length ≥ 0.001 > 2^-10 has no bit below 2^-62

std::int64_t wrapping_sum(std::int64_t a, std::int64_t b) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

std::int64_t wrapping_difference(std::int64_t a, std::int64_t b) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

/// Sum whose error counts against the larger term: all that is needed where nothing cancels exactly.
DoubleDouble fast_sum(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b.hi);
  return quick_two_sum(high.hi, high.lo + (a.lo + b.lo));
}

}  // namespace

GearFunction::RingPosition GearFunction::sum(RingPosition a, const RingPosition& b) const noexcept {
  a.fraction += b.fraction;
  a.units += b.units;
  a.turns += b.turns;
  if (a.fraction >= denominator_) {
    a.fraction -= denominator_;
    ++a.units;
  }
  if (a.units >= length_) {
    a.units -= length_;
    ++a.turns;
  }
  return a;
}

GearFunction::RingPosition GearFunction::negative(const RingPosition& a) const noexcept {
  RingPosition result;
  result.turns = std::uint64_t{0} - a.turns;
  Units whole = a.units;
  if (a.fraction != 0) {
    result.fraction = denominator_ - a.fraction;
    ++whole;  // at most length_
  }
  if (whole != 0) {
    result.units = length_ - whole;
    --result.turns;
  }
  return result;
}

GearFunction::RingPosition GearFunction::multiple(std::uint64_t times, RingPosition a) const noexcept {
  RingPosition result;
  for (; times != 0; times >>= 1) {
    if ((times & 1u) != 0) result = sum(result, a);
    a = sum(a, a);
  }
  return result;
}

/// distance · numerator / denominator: distance = whole · denominator + rest, so that nothing exceeds 128
/// bits.
GearFunction::RingPosition GearFunction::geared(Units distance, bool negative_distance) const noexcept {
  const Units whole = distance / denominator_;
  const std::uint64_t rest = static_cast<std::uint64_t>(distance % denominator_) * numerator_;  // < 2^62
  RingPosition result;
  result.units = whole % length_;
  result.turns = static_cast<std::uint64_t>(whole / length_);
  result = multiple(numerator_, result);
  const RingPosition remainder{rest / denominator_, rest % denominator_, 0};  // < 2^31 units, length_ ≥ 2^52
  result = sum(result, remainder);
  return negative_distance != mirrored_ ? negative(result) : result;
}

void GearFunction::set(std::int32_t numerator, std::int32_t denominator, AxisPosition leading_start,
                       AxisPosition following_start, const Modulo& leading,
                       const Modulo& following) noexcept {
  const std::int64_t signed_numerator = numerator;
  mirrored_ = numerator < 0;
  numerator_ = static_cast<std::uint64_t>(mirrored_ ? -signed_numerator : signed_numerator);
  denominator_ = denominator > 0 ? static_cast<std::uint64_t>(denominator) : 1;
  ratio_ = to_double_double(static_cast<double>(numerator)) / static_cast<double>(denominator_);
  ratio_halves_ = halves(ratio_.hi);
  leading_ = leading;
  following_ = following;
  leading_value_ = leading_start.value;
  leading_turns_ = leading_start.turns;
  following_start_ = following_start;
  anchor_ = 0.0;
  turn_ = 0;
  place_ = per_turn_ = anchor_place_ = RingPosition{};
  if (following.enabled) {
    length_ = static_cast<Units>(following.length * kUnitsPerOne);
    // Within this reach 104 bits leave 2^-60 of the length and less.
    reach_ = numerator_ == 0 ? std::numeric_limits<double>::infinity()
                             : 0x1p40 * following.length / std::abs(ratio_.hi);
    lowest_ = following.start;
    end_ = following.end();
    if (leading.enabled) per_turn_ = geared(static_cast<Units>(leading.length * kUnitsPerOne), false);
  } else {
    reach_ = end_ = std::numeric_limits<double>::infinity();
    lowest_ = -end_;
  }
  rebase();
}

/// Leads the integer part to another leading turn: one addition to the next one, else by the bits of the
/// jump.
void GearFunction::turn_to(std::int64_t turn) noexcept {
  if (following_.enabled) {
    const std::int64_t jump = wrapping_difference(turn, turn_);
    const std::uint64_t size =
        jump < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(jump) : static_cast<std::uint64_t>(jump);
    const RingPosition distance = size == 1 ? per_turn_ : multiple(size, per_turn_);
    place_ = sum(place_, jump < 0 ? negative(distance) : distance);
  }
  turn_ = turn;
  rebase();
}

/// Moves the anchor along, so that what is left to double-double stays within its reach: for extreme ratios
/// of distances only.
void GearFunction::anchor_at(double distance) noexcept {
  const double size = std::abs(distance);
  if (!(size < 0x1p64)) return;
  RingPosition place;
  if (size >= 0x1p-10) {  // then it has no bit below 2^-62
    place = geared(static_cast<Units>(size * kUnitsPerOne), distance < 0.0);
  } else {
    distance = 0.0;
  }
  place_ = sum(sum(place_, negative(anchor_place_)), place);
  anchor_place_ = place;
  anchor_ = distance;
  rebase();
}

/// Takes the double-double origin from the integer part.
void GearFunction::rebase() noexcept {
  near_ = anchor_ == 0.0 ? reach_ : -1.0;
  if (following_.enabled) {
    const double high = static_cast<double>(static_cast<std::uint64_t>(place_.units >> 64)) * 0x1p64;
    const auto low_word = static_cast<std::uint64_t>(place_.units);
    const DoubleDouble low = {static_cast<double>(low_word >> 32) * 0x1p32,
                              static_cast<double>(low_word & 0xFFFFFFFFu)};
    const double fraction = static_cast<double>(place_.fraction) / static_cast<double>(denominator_);
    DoubleDouble distance = two_sum(high, low.hi) + low.lo + fraction;
    distance = {distance.hi / kUnitsPerOne, distance.lo / kUnitsPerOne};
    base_ = distance + following_start_.value;
    wraps_ = 0;
    origin_ = base_;
    turns_ = wrapping_sum(following_start_.turns, static_cast<std::int64_t>(place_.turns));
  } else {
    base_ = ratio_ * (to_double_double(turn_) * (leading_.enabled ? leading_.length : 0.0));
    base_ = base_ + following_start_.value;
    origin_ = base_;
    turns_ = 0;
  }
}

void GearFunction::add_turns(std::int64_t turns) noexcept {
  following_start_.turns = wrapping_sum(following_start_.turns, turns);
  turns_ = wrapping_sum(turns_, turns);
}

void GearFunction::add_leading_turns(std::int64_t turns) noexcept {
  leading_turns_ = wrapping_sum(leading_turns_, turns);
}

AxisPosition GearFunction::value(AxisPosition leading) noexcept {
  const std::int64_t turn = wrapping_difference(leading.turns, leading_turns_);
  if (turn != turn_) return value_in_turn(leading, turn);
  const DoubleDouble distance = two_difference(leading.value, leading_value_);
  if (!(std::abs(distance.hi) <= near_)) return value_from_anchor(leading);
  return after(geared(distance));
}

/// Of another turn of the leading axis. Seldom, as what follows: kept apart, so that `value` calls nothing.
[[gnu::noinline]] AxisPosition GearFunction::value_in_turn(AxisPosition leading, std::int64_t turn) noexcept {
  turn_to(turn);
  return value(leading);
}

[[gnu::noinline]] AxisPosition GearFunction::value_from_anchor(AxisPosition leading) noexcept {
  DoubleDouble distance = two_difference(leading.value, leading_value_);
  if (anchor_ != 0.0) distance = distance - anchor_;
  if (std::abs(distance.hi) > reach_) {
    distance = two_difference(leading.value, leading_value_);
    anchor_at(distance.hi);
    distance = distance - anchor_;
  }
  return after(geared(distance));
}

inline DoubleDouble GearFunction::geared(DoubleDouble distance) const noexcept {
  const DoubleDouble product = two_product(distance.hi, ratio_.hi, ratio_halves_);
  return {product.hi, product.lo + (distance.hi * ratio_.lo + distance.lo * ratio_.hi)};
}

/// The position a following distance behind the origin.
inline AxisPosition GearFunction::after(DoubleDouble distance) noexcept {
  const DoubleDouble position = fast_sum(origin_, distance);
  if (position.hi >= lowest_ && position.hi < end_) return {turns_, position.hi};
  return beyond_window(distance);
}

/// Moves the window to the following turn in which origin + distance lies.
[[gnu::noinline]] AxisPosition GearFunction::beyond_window(DoubleDouble distance) noexcept {
  if (!following_.enabled) return {0, fast_sum(origin_, distance).hi};
  const double length = following_.length;
  const double start = following_.start;
  const DoubleDouble whole = base_ + distance;
  const double count = std::floor((whole - start).hi / length);
  if (!(std::abs(count) < 0x1p52)) return {turns_, whole.hi};  // not finite
  const auto move_window = [&](std::int64_t wraps) noexcept {
    turns_ = wrapping_sum(turns_, wrapping_difference(wraps, wraps_));
    wraps_ = wraps;
    origin_ = base_ - two_product(static_cast<double>(wraps), length);
    return fast_sum(origin_, distance);
  };
  DoubleDouble position = move_window(static_cast<std::int64_t>(count));
  if ((position - start).hi < 0.0)
    position = move_window(wraps_ - 1);
  else if (!((position - start) < to_double_double(length)))
    position = move_window(wraps_ + 1);
  if (position.hi >= end_) return {wrapping_sum(turns_, 1), start};
  return {turns_, position.hi < start ? start : position.hi};
}

}  // namespace lockstep
