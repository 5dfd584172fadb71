#include "tech_objects/cam/spline.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace lockstep {
namespace {

CamPoint between(CamPoint a, CamPoint b, double part) noexcept {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

/// One value of the blossom of a span: the control point of the Bézier form that belongs to three parameters.
/// @source de Boor's algorithm with a parameter of its own per level
CamPoint blossom(std::span<const CamPoint> controls, std::size_t span,
                 const double (&parameter)[3]) noexcept {
  const auto spans = static_cast<double>(controls.size() - 3);
  const auto knot = [&](std::size_t i) {  // 0 0 0 0 1 2 … spans spans spans spans
    return std::clamp(static_cast<double>(i) - 3.0, 0.0, spans);
  };
  CamPoint d[4] = {controls[span], controls[span + 1], controls[span + 2], controls[span + 3]};
  for (std::size_t level = 1; level <= 3; ++level)
    for (std::size_t j = 3; j >= level; --j) {
      const std::size_t i = span + j;
      const double low = knot(i);
      const double high = knot(i + 4 - level);
      d[j] = between(d[j - 1], d[j], (parameter[level - 1] - low) / (high - low));
    }
  return d[3];
}

// Coordinates of points that lie one behind the other, and numbers of them.
using Coordinates = Eigen::Map<const Eigen::ArrayXd, Eigen::Unaligned, Eigen::InnerStride<2>>;
using Numbers = Eigen::Map<Eigen::ArrayXd>;
// The right-hand sides of a row.
using Sides = Eigen::Map<Eigen::Vector2d>;

Coordinates coordinates(const double& first, std::size_t count) noexcept {
  static_assert(sizeof(CamPoint) == 2 * sizeof(double));
  return {&first, static_cast<Eigen::Index>(count)};
}

}  // namespace

CamSpline::CamSpline(std::size_t points)
    : width_(points), slope_(points), pivot_(points), sides_(points), moment_(points) {}

void CamSpline::measure(std::span<const CamPoint> points, std::size_t first) noexcept {
  const std::size_t count = points.size() - 1;
  const auto differences = [&](const double& begin, const double& next) {
    return coordinates(next, count) - coordinates(begin, count);
  };
  Numbers width(&width_[first], static_cast<Eigen::Index>(count));
  Numbers slope(&slope_[first], static_cast<Eigen::Index>(count));
  width = differences(points[0].x, points[1].x);
  slope = differences(points[0].y, points[1].y) / width;
}

/// The rows of the points between the ends, of which `last` is the second one.
void CamSpline::join(std::size_t last) noexcept {
  for (std::size_t i = 1; i < last; ++i) {
    pivot_[i] = 2.0 * (width_[i - 1] + width_[i]);
    sides_[i] = {6.0 * (slope_[i] - slope_[i - 1]), 0.0};
  }
}

/// Elimination of the tridiagonal rows first … last, of both right-hand sides at once; row i is
/// w[i-1]·m[i-1] + pivot·m[i] + w[i]·m[i+1] = side[i]. The rows are diagonally dominant, so no pivoting. The
/// unknowns beside them count as 0.
void CamSpline::solve(std::size_t first, std::size_t last) noexcept {
  const auto sides = [&](std::size_t i) { return Sides(sides_[i].data()); };
  for (std::size_t i = first + 1; i <= last; ++i) {
    const double factor = width_[i - 1] / pivot_[i - 1];
    pivot_[i] -= factor * width_[i - 1];
    sides(i) -= factor * sides(i - 1);
  }
  sides(last) /= pivot_[last];
  for (std::size_t i = last; i-- > first;) sides(i) = (sides(i) - width_[i] * sides(i + 1)) / pivot_[i];
}

std::span<const double> CamSpline::through(std::span<const CamPoint> points, std::optional<double> left_slope,
                                           std::optional<double> right_slope) noexcept {
  measure(points);
  return clamped(points.size(), left_slope, right_slope);
}

std::span<const double> CamSpline::through(std::span<const CamPoint> points, std::span<const CamPoint> next,
                                           double left_slope, double right_slope) noexcept {
  measure(points);
  measure(next, points.size() - 1);
  return clamped(points.size() + next.size() - 1, left_slope, right_slope);
}

std::span<const double> CamSpline::clamped(std::size_t count, std::optional<double> left_slope,
                                           std::optional<double> right_slope) noexcept {
  const std::size_t last = count - 1;
  join(last);
  sides_[0] = sides_[last] = {};
  if (left_slope) {
    pivot_[0] = 2.0 * width_[0];
    sides_[0][0] = 6.0 * (slope_[0] - *left_slope);
  }
  if (right_slope) {
    pivot_[last] = 2.0 * width_[last - 1];
    sides_[last][0] = 6.0 * (*right_slope - slope_[last - 1]);
  }
  const std::size_t first_row = left_slope ? 0 : 1;
  const std::size_t last_row = right_slope ? last : last - 1;
  if (first_row <= last_row) solve(first_row, last_row);
  for (std::size_t i = 0; i <= last; ++i) moment_[i] = sides_[i][0];
  return {moment_.data(), count};
}

std::span<const double> CamSpline::closed_through(std::span<const CamPoint> points) noexcept {
  const std::size_t last = points.size() - 1;
  measure(points);
  moment_[0] = moment_[last] = 0.0;
  if (last == 1) return {moment_.data(), points.size()};  // a line is its own continuation
  // The inner rows are solved for an end moment of 0 and for what an end moment of 1 adds; the row of the
  // joined ends then gives that moment.
  join(last);
  sides_[1][1] -= width_[0];
  sides_[last - 1][1] -= width_[last - 1];
  solve(1, last - 1);
  const auto& [first_moment, first_unit] = sides_[1];
  const auto& [last_moment, last_unit] = sides_[last - 1];
  const double right_hand = 6.0 * (slope_[0] - slope_[last - 1]);
  const double rest = right_hand - width_[0] * first_moment - width_[last - 1] * last_moment;
  const double pivot =
      2.0 * (width_[0] + width_[last - 1]) + width_[0] * first_unit + width_[last - 1] * last_unit;
  const double end = rest / pivot;
  for (std::size_t i = 1; i < last; ++i) moment_[i] = sides_[i][0] + end * sides_[i][1];
  moment_[0] = moment_[last] = end;
  return {moment_.data(), points.size()};
}

void add_spline(CamBuilder& cam, std::span<const CamPoint> points, std::span<const double> moments) noexcept {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double width = points[i + 1].x - points[i].x;
    const double slope = (points[i + 1].y - points[i].y) / width;
    cam.add_cubic(points[i].x, points[i].y, slope - width * (2.0 * moments[i] + moments[i + 1]) / 6.0,
                  0.5 * moments[i], (moments[i + 1] - moments[i]) / (6.0 * width));
  }
}

CamBezier span_of_b_spline(std::span<const CamPoint> controls, std::size_t span) noexcept {
  const std::size_t spans = controls.size() - 3;
  if (span >= 2 && span + 3 <= spans) {  // the knots around are uniform
    const CamPoint* p = &controls[span];
    const CamPoint inner_left = between(p[1], p[2], 1.0 / 3.0);
    const CamPoint inner_right = between(p[1], p[2], 2.0 / 3.0);
    return {between(between(p[0], p[1], 2.0 / 3.0), inner_left, 0.5), inner_left, inner_right,
            between(inner_right, between(p[2], p[3], 1.0 / 3.0), 0.5)};
  }
  const auto u = static_cast<double>(span);
  return {blossom(controls, span, {u, u, u}), blossom(controls, span, {u, u, u + 1.0}),
          blossom(controls, span, {u, u + 1.0, u + 1.0}),
          blossom(controls, span, {u + 1.0, u + 1.0, u + 1.0})};
}

void add_b_spline(CamBuilder& cam, std::span<const CamPoint> controls) noexcept {
  if (controls.size() == 2) {
    const CamPoint a = controls[0];
    const CamPoint b = controls[1];
    cam.add_cubic(a.x, a.y, (b.y - a.y) / (b.x - a.x), 0.0, 0.0);
    return;
  }
  if (controls.size() == 3) {  // a parabola, raised to degree 3
    cam.add_bezier({controls[0], between(controls[0], controls[1], 2.0 / 3.0),
                    between(controls[2], controls[1], 2.0 / 3.0), controls[2]});
    return;
  }
  for (std::size_t span = 0; span + 3 < controls.size(); ++span)
    cam.add_bezier(span_of_b_spline(controls, span));
}

}  // namespace lockstep
