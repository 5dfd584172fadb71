/// A bound that a value hardly ever meets.
#pragma once

#include <algorithm>
#include <cmath>

namespace lockstep {

namespace detail {
[[gnu::noinline, gnu::cold]] inline double cut(double value, double bound) noexcept {
  return std::clamp(value, -bound, bound);
}
}  // namespace detail

/// `std::clamp(value, -bound, bound)`, to the bit. What is computed with the result does not wait
/// for the bounds, as it has to for a minimum and a maximum: the processor goes on with the value, and begins
/// again where it is beyond them. Where that is so in every other step `std::clamp` is quicker.
/// @param bound ≥ 0
[[gnu::always_inline]] inline double seldom_cut(double value, double bound) noexcept {
  if (std::abs(value) <= bound) [[likely]]
    return value;
  return detail::cut(value, bound);
}

}  // namespace lockstep
