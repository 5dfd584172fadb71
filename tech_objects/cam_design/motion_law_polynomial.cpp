#include "tech_objects/cam_design/motion_law_polynomial.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace lockstep {
namespace {

/// k (k-1) … (k-order+1): what a derivative makes of z^k.
double falling_factorial(int k, int order) noexcept {
  double product = 1.0;
  for (int j = 0; j < order; ++j) product *= k - j;
  return product;
}

}  // namespace

double polynomial_derivative(const double (&c)[8], int order, double z) noexcept {
  double sum = 0.0;
  for (int k = 7; k >= order; --k) sum = sum * z + c[k] * falling_factorial(k, order);
  return sum;
}

bool polynomial_between(const EndConditions& start, const EndConditions& end, double (&c)[8]) noexcept {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
  const auto given = [](const auto& derivative) { return derivative.has_value(); };
  const auto ends = std::ranges::count_if(end.derivative, given);
  const auto count = ends + std::ranges::count_if(start.derivative, given);
  std::ranges::fill(c, 0.0);
  // Each condition at the start is a coefficient; those at the end are equations for the others.
  int unknown[8] = {};
  int unknowns = 0;
  for (int k = 0; k < 8; ++k) {
    const bool known = k < 4 && start.derivative[k];
    if (known && k >= count) return false;  // the degree is too low to have this derivative
    if (known) c[k] = *start.derivative[k] / falling_factorial(k, k);
    if (!known && k < count) unknown[unknowns++] = k;
  }
  Rows rows(ends, ends);
  Column right_hand(ends);
  int row = 0;
  for (int order = 0; order < 4; ++order) {
    if (!end.derivative[order]) continue;
    for (int j = 0; j < unknowns; ++j) rows(row, j) = falling_factorial(unknown[j], order);
    right_hand(row++) = *end.derivative[order] - polynomial_derivative(c, order, 1.0);
  }
  if (ends == 0) return true;
  const Eigen::FullPivLU<Rows> factors(rows);
  if (!factors.isInvertible()) return false;
  const Column solution = factors.solve(right_hand);
  for (int j = 0; j < unknowns; ++j) c[unknown[j]] = solution(j);
  return true;
}

}  // namespace lockstep
