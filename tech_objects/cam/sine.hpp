/// Sine and cosine whose bits do not depend on the processor: the C library picks other code where fused
/// multiply-add exists. Plain additions and multiplications; the error is below two ulp of 1.
#pragma once

#include <cstdint>

namespace lockstep {

/// Sine and cosine of one angle.
struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Sine and cosine of an angle [rad], magnitude up to 1.0E5 (beyond it the result loses digits, below 1.0E15
/// it stays defined). Any thread.
constexpr SineCosine sine_cosine(double angle) noexcept {
  // π/2 in three parts of 33 bits: their products with a whole number of quarters below 2^20 are exact.
  const double quarters = angle * 0.63661977236758134308;
  const auto quarter = static_cast<std::int64_t>(quarters + (quarters < 0.0 ? -0.5 : 0.5));
  const auto n = static_cast<double>(quarter);
  const double r = ((angle - n * 1.57079632673412561417) - n * 6.07710050630396597660e-11) -
                   n * 2.02226624871116645580e-21;
  const double q = r * r;  // Taylor series on |r| ≤ π/4: the terms left out are below 1.0E-19
  const double odd =
      q * (-1.0 / 6.0 +
           q * (1.0 / 120.0 + q * (-1.0 / 5040.0 +
                                   q * (1.0 / 362880.0 + q * (-1.0 / 39916800.0 +
                                                              q * (1.0 / 6227020800.0 +
                                                                   q * (-1.0 / 1307674368000.0 +
                                                                        q * (1.0 / 355687428096000.0))))))));
  const double even =
      q * q *
      (1.0 / 24.0 +
       q * (-1.0 / 720.0 + q * (1.0 / 40320.0 +
                                q * (-1.0 / 3628800.0 + q * (1.0 / 479001600.0 +
                                                             q * (-1.0 / 87178291200.0 +
                                                                  q * (1.0 / 20922789888000.0 +
                                                                       q * (-1.0 / 6402373705728000.0))))))));
  const double sine = r + r * odd;
  const double cosine = (1.0 - 0.5 * q) + even;
  switch (quarter & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace lockstep
