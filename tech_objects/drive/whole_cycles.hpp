/// Delays in cycles of the servo.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lockstep {

/// A delay as whole cycles and a part of one.
struct Cycles {
  std::size_t whole;
  double part;  // 0 … 1
};

/// @param maximum cycles that can be kept; a longer delay counts as that
inline Cycles cycles_of(double delay, double servo_cycle, std::size_t maximum) noexcept {
  const double cycles = std::clamp(delay / servo_cycle, 0.0, static_cast<double>(maximum));
  const double nearest = std::floor(cycles + 0.5);
  if (std::abs(cycles - nearest) < 1e-9) return {static_cast<std::size_t>(nearest), 0.0};
  const double whole = std::floor(cycles);
  return {static_cast<std::size_t>(whole), cycles - whole};
}

}  // namespace lockstep
