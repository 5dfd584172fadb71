#include "tech_objects/cam_design/motion_law_polynomial.hpp"

#include <algorithm>
#include <cmath>

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
  double rows[8][9] = {};
  int count = 0;
  for (const EndConditions* side : {&start, &end})
    for (const auto& derivative : side->derivative) count += derivative ? 1 : 0;
  int row = 0;
  for (int order = 0; order < 4; ++order) {
    if (start.derivative[order]) {
      if (order >= count) return false;  // the degree is too low to have this derivative
      rows[row][order] = falling_factorial(order, order);
      rows[row++][count] = *start.derivative[order];
    }
    if (end.derivative[order]) {
      for (int k = order; k < count; ++k) rows[row][k] = falling_factorial(k, order);
      rows[row++][count] = *end.derivative[order];
    }
  }
  for (int k = 0; k < count; ++k) {  // elimination with the largest pivot; the entries are whole numbers
    int pivot = k;
    for (int r = k + 1; r < count; ++r)
      if (std::abs(rows[r][k]) > std::abs(rows[pivot][k])) pivot = r;
    if (std::abs(rows[pivot][k]) < 1.0e-9) return false;
    std::swap(rows[k], rows[pivot]);
    for (int r = 0; r < count; ++r) {
      if (r == k) continue;
      const double factor = rows[r][k] / rows[k][k];
      for (int j = k; j <= count; ++j) rows[r][j] -= factor * rows[k][j];
    }
  }
  std::fill(c, c + 8, 0.0);
  for (int k = 0; k < count; ++k) c[k] = rows[k][count] / rows[k][k];
  return true;
}

}  // namespace lockstep
