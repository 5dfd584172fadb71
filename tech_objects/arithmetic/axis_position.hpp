/// Where an axis is: its position on the modulo ring and the turns it has made, or its position on a line.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"

namespace lockstep {

/// The modulo setting of an axis.
/// @source S7-1500T synchronous operation V7, 13.2 (Modulo)
struct Modulo {
  bool enabled = false;   ///< false: linear axis, the other two do not matter
  double length = 360.0;  ///< [u] 0.001 … 1.0E12
  double start = 0.0;     ///< [u] -1.0E12 … 1.0E12, lowest position

  /// [u] The first double that is no position any more: start + length rounded.
  constexpr double end() const noexcept { return start + length; }
  constexpr bool contains(double value) const noexcept {
    return !enabled || (value >= start && value < end());
  }
};

/// Largest magnitude of a position [u]; beyond it a setpoint is not followed.
/// @source S7-1500T synchronous operation V7, 13.1 (ranges); alarm 308
inline constexpr double kPositionRange = 1e12;

/// Position of an axis. Modulo axis: `value` in [start, start + length), position on the line is
/// turns · length + value. Linear axis: `turns` is 0. Turns wrap around at 64 bits without a step.
struct AxisPosition {
  std::int64_t turns = 0;
  double value = 0.0;  ///< [u]

  friend constexpr bool operator==(const AxisPosition&, const AxisPosition&) noexcept = default;
};

/// A value of any size brought onto the ring; the turns it held are counted. The reduction is exact and the
/// result rounded once; a value that would round to the end of the ring is its start, one turn on. Linear
/// axis: the value rounded. `value` is finite with |value| ≤ 2^52 · length, or it is returned as it is. Any
/// thread.
AxisPosition normalised(std::int64_t turns, DoubleDouble value, const Modulo& modulo) noexcept;

inline AxisPosition normalised(AxisPosition position, const Modulo& modulo) noexcept {
  if (modulo.contains(position.value)) return position;
  return normalised(position.turns, to_double_double(position.value), modulo);
}

/// Where 0 lies on a turn of a ring, whose names may begin behind it.
inline AxisPosition zero_on_turn(std::int64_t turns, const Modulo& modulo) noexcept {
  return {turns, normalised({0, 0.0}, modulo).value};
}

/// The position after a distance of `increment` [u] of either sign: exact, then rounded once.
/// Whoever adds up many increments keeps the sum as a DoubleDouble and adds it to where he began. Any thread.
inline AxisPosition advanced(AxisPosition position, DoubleDouble increment, const Modulo& modulo) noexcept {
  const double value = rounded_sum(increment, position.value);
  if (modulo.contains(value)) return {position.turns, value};
  return normalised(position.turns, increment + position.value, modulo);
}

inline AxisPosition advanced(AxisPosition position, double increment, const Modulo& modulo) noexcept {
  return advanced(position, to_double_double(increment), modulo);
}

/// An origin that distances are counted from. It turns along with the positions asked for, a whole turn at a
/// time, so that a motion has to be brought onto the ring only where it passes the ring's end. Thread: the
/// cycle.
class DistanceOrigin {
 public:
  void set(AxisPosition place) noexcept {
    turns_ = place.turns;
    value_ = to_double_double(place.value);
  }

  void shift(double by) noexcept { value_ = value_ + by; }

  /// The position after a distance [u] from the origin: exact, then rounded once.
  AxisPosition after(double distance, const Modulo& modulo) noexcept {
    const double value = rounded_sum(value_, distance);
    if (modulo.contains(value)) return {turns_, value};
    return beyond_turn(value_ + distance, modulo);
  }

 private:
  /// Goes on to the turn on which a distance ends.
  [[gnu::noinline]] AxisPosition beyond_turn(DoubleDouble value, const Modulo& modulo) noexcept {
    const AxisPosition position = normalised(turns_, value, modulo);
    const auto passed = static_cast<std::int64_t>(static_cast<std::uint64_t>(position.turns) -
                                                  static_cast<std::uint64_t>(turns_));
    value_ = value_ - to_double_double(passed) * modulo.length;
    turns_ = position.turns;
    return position;
  }

  std::int64_t turns_ = 0;
  DoubleDouble value_;  // the origin, seen from the ring of these turns [u]
};

/// So many whole turns as a distance [u], within 2^-103 of it.
inline DoubleDouble turns_distance(std::int64_t turns, double length) noexcept {
  constexpr std::int64_t kWholeDoubles = 1LL << 53;
  const bool is_double = -kWholeDoubles <= turns && turns <= kWholeDoubles;
  return is_double ? two_product(static_cast<double>(turns), length) : to_double_double(turns) * length;
}

/// Distance from `from` to `to` [u] with the turns (the shorter way round where these wrap), within 2^-103 of
/// it. Any thread.
inline DoubleDouble difference(AxisPosition to, AxisPosition from, const Modulo& modulo) noexcept {
  const DoubleDouble values = two_difference(to.value, from.value);
  if (!modulo.enabled || to.turns == from.turns) return values;
  const auto turns = static_cast<std::int64_t>(static_cast<std::uint64_t>(to.turns) -
                                               static_cast<std::uint64_t>(from.turns));
  return turns_distance(turns, modulo.length) + values;
}

/// `difference`, rounded to a double.
inline double rounded_difference(AxisPosition to, AxisPosition from, const Modulo& modulo) noexcept {
  return to.turns == from.turns ? to.value - from.value : difference(to, from, modulo).rounded();
}

/// Distance [u] from a position to a target on the ring in one direction: positive in [0, length], negative
/// in
/// [-length, 0]; length itself only where less than half an ulp is missing to a whole turn. The target may
/// lie outside the ring and is brought onto it. Linear axis: target - from, whatever its sign. Any thread.
double positive_distance(double from, double target, const Modulo& modulo) noexcept;
double negative_distance(double from, double target, const Modulo& modulo) noexcept;

/// The shorter of the two distances; the positive one when they are equal. Linear axis: target - from. Any
/// thread.
double shortest_distance(double from, double target, const Modulo& modulo) noexcept;

}  // namespace lockstep
