/// The second derivatives of cubic splines, and the control points of cubic B-splines span by span.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tech_objects/cam/builder.hpp"

namespace lockstep {

/// Solves the tridiagonal systems of cubic splines in storage of its own. Not for the cycle; any one thread.
class CamSpline {
 public:
  /// For splines through so many points.
  explicit CamSpline(std::size_t points);

  /// Second derivatives at the points of the cubic spline through them; x ascends, at least two points.
  /// An end with a slope has that first derivative, one without has the second derivative 0 (natural).
  /// The result stays valid until the next call.
  std::span<const double> through(std::span<const CamPoint> points, std::optional<double> left_slope,
                                  std::optional<double> right_slope) noexcept;

  /// Second derivatives of the spline through `points` that goes on through `next`, whose first point is the
  /// last of `points` seen from elsewhere (the start of a cam, seen as its end). The moments of `next` begin
  /// with that of the common point, at points.size() - 1.
  std::span<const double> through(std::span<const CamPoint> points, std::span<const CamPoint> next,
                                  double left_slope, double right_slope) noexcept;

  /// Second derivatives of the spline whose first and second derivative at the end equal those at the start.
  std::span<const double> closed_through(std::span<const CamPoint> points) noexcept;

 private:
  void measure(std::span<const CamPoint> points, std::size_t first = 0) noexcept;
  std::span<const double> clamped(std::size_t count, std::optional<double> left_slope,
                                  std::optional<double> right_slope) noexcept;
  void join(std::size_t last) noexcept;
  void solve(std::size_t first, std::size_t last) noexcept;

  std::vector<double> width_;  // of an interval
  std::vector<double> slope_;  // of its chord
  std::vector<double> pivot_;  // of the eliminated row
  // Of a row: its right-hand side, and what a second derivative of 1 at both ends adds; then the solutions.
  std::vector<std::array<double, 2>> sides_;
  std::vector<double> moment_;  // the second derivative
};

/// Adds the spline with these second derivatives to a cam, without its last point.
void add_spline(CamBuilder& cam, std::span<const CamPoint> points, std::span<const double> moments) noexcept;

/// The Bézier form of one span of the clamped uniform cubic B-spline over at least four control points, of
/// which there are `controls.size() - 3`. Any thread.
CamBezier span_of_b_spline(std::span<const CamPoint> controls, std::size_t span) noexcept;

/// Adds the clamped cubic B-spline over control points with ascending x to a cam; with two or three points,
/// the line or the parabola that they control.
void add_b_spline(CamBuilder& cam, std::span<const CamPoint> controls) noexcept;

}  // namespace lockstep
