/// The root of a function between two points where its signs differ, without derivatives.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {

/// Chandrupatla's method: inverse quadratic interpolation where it is safe, bisection elsewhere.
/// @param low, high ends of the bracket, f(low) ≤ 0 ≤ f(high); an end that is a root is returned
/// @param tolerance amount of f that counts as 0
template <class Function>
double find_root(Function f, double low, double f_low, double high, double f_high,
                 double tolerance) noexcept {
  constexpr int kMaximumSteps = 200;
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  if (f_high <= tolerance) return high;
  if (f_low >= -tolerance) return low;
  double a = high, fa = f_high, b = low, fb = f_low, c = a, fc = fa, t = 0.5;
  for (int step = 0; step < kMaximumSteps; ++step) {
    const double x = a + t * (b - a);
    const double fx = f(x);
    if ((fx > 0.0) == (fa > 0.0)) {
      c = a;
      fc = fa;
    } else {
      c = b;
      fc = fb;
      b = a;
      fb = fa;
    }
    a = x;
    fa = fx;
    const double width = std::abs(b - a);
    const double minimum =
        std::max(kEpsilon * std::min(std::abs(a), std::abs(b)), std::numeric_limits<double>::min());
    if (std::abs(fa) <= tolerance || width <= minimum) break;
    const double xi = (a - b) / (c - b);
    const double phi = (fa - fb) / (fc - fb);
    t = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
      t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    const double edge = 0.5 * minimum / width;
    t = std::min(std::max(t, edge), 1.0 - edge);
  }
  return std::abs(fa) <= std::abs(fb) ? a : b;
}

}  // namespace lockstep
