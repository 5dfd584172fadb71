/// Polynomials from conditions at both ends.
#pragma once

#include <optional>

namespace lockstep {

/// Conditions at one end of 0 … 1: value and first to third derivative, where given.
struct EndConditions {
  std::optional<double> derivative[4];
};

/// Coefficients of the polynomial over 0 … 1 of the lowest degree that can meet the conditions, at most 7.
/// FALSE if there is none or no single one. Any thread.
bool polynomial_between(const EndConditions& start, const EndConditions& end, double (&c)[8]) noexcept;

/// Derivative of any order of a polynomial of degree 7.
double polynomial_derivative(const double (&c)[8], int order, double z) noexcept;

}  // namespace lockstep
