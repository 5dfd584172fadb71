#include "tech_objects/arithmetic/axis_position.hpp"

#include <cmath>

namespace lockstep {
namespace {

/// `turns` more or less; wraps at 64 bits.
std::int64_t add_turns(std::int64_t turns, std::int64_t more) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(turns) + static_cast<std::uint64_t>(more));
}

struct Reduced {
  std::int64_t turns;
  DoubleDouble rest;  // in [0, length), or a hair outside where the 106 bits end
};

/// A distance along the line as whole turns and the rest.
Reduced reduced(DoubleDouble distance, double length) noexcept {
  double count = std::floor(distance.hi / length);
  DoubleDouble rest = distance - two_product(count, length);
  // The quotient is rounded: it may be one off, either way.
  if (rest.hi < 0.0) {
    count -= 1.0;
    rest = distance - two_product(count, length);
  } else if (!(rest < to_double_double(length))) {
    count += 1.0;
    rest = distance - two_product(count, length);
  }
  return {static_cast<std::int64_t>(count), rest};
}

/// Positive distance from `from` to `target` on the ring, unrounded.
DoubleDouble distance_on_ring(double from, double target, const Modulo& modulo) noexcept {
  const DoubleDouble distance = two_difference(target, from);
  if (!(std::abs(distance.hi) <= 0x1p52 * modulo.length)) return distance;
  return reduced(distance, modulo.length).rest;
}

}  // namespace

AxisPosition normalised(std::int64_t turns, DoubleDouble value, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return {0, value.rounded()};
  if (!(std::abs(value.hi) <= 0x1p52 * modulo.length)) return {turns, value.rounded()};
  const Reduced result = reduced(value - modulo.start, modulo.length);
  const double position = (result.rest + modulo.start).rounded();
  turns = add_turns(turns, result.turns);
  if (position < modulo.end()) return {turns, position < modulo.start ? modulo.start : position};
  return {add_turns(turns, 1), modulo.start};
}

double positive_distance(double from, double target, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return target - from;
  return distance_on_ring(from, target, modulo).rounded();
}

double negative_distance(double from, double target, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return target - from;
  return -distance_on_ring(target, from, modulo).rounded();
}

double shortest_distance(double from, double target, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return target - from;
  const double forward = positive_distance(from, target, modulo);
  const double backward = negative_distance(from, target, modulo);
  return forward <= -backward ? forward : backward;
}

}  // namespace lockstep
