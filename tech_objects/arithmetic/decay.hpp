/// The exponential of first-order lags, from nothing but what every processor computes alike.
#pragma once

namespace lockstep {

/// 1 - exp(-x) for x ≥ 0, within a few ulp; 1 where x is no number: series of a small argument, then
/// 1 - exp(-2y) = g (2 - g) with g = 1 - exp(-y). Some 30 operations: for settings, not for every tick.
/// Any thread.
inline double decay_within(double x) noexcept {
  if (!(x < 64.0)) return 1.0;
  int doublings = 0;
  for (; x > 0.125; x *= 0.5) ++doublings;
  double sum = 0.0;
  for (int order = 16; order >= 1; --order) sum = x / order * (1.0 - sum);
  for (; doublings > 0; --doublings) sum *= 2.0 - sum;
  return sum;
}

}  // namespace lockstep
