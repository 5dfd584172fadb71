/// Times of the cycle as numbers.
#pragma once

#include <cmath>
#include <cstdint>

namespace lockstep {

/// [s] of [ns].
constexpr double seconds(std::int64_t nanoseconds) noexcept {
  return static_cast<double>(nanoseconds) * 1e-9;
}

/// [ns] of [s], to the nearest; what is no number, or negative, is 0, and more than a thousand days are
/// those.
inline std::int64_t nanoseconds(double time) noexcept {
  constexpr double kLongest = 8.64e16;
  if (!(time > 0.0)) return 0;
  return static_cast<std::int64_t>(std::nearbyint(std::fmin(time * 1e9, kLongest)));
}

}  // namespace lockstep
