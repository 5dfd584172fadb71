/// A segment of a cam as it is evaluated: its polynomial and its sine seen from where the segment begins.
#pragma once

#include <cstddef>
#include <span>

namespace lockstep {

/// A following value and its derivatives with respect to the leading value.
struct CamValue {
  double position = 0.0;           ///< [following u]
  double first_derivative = 0.0;   ///< [following u / leading u]
  double second_derivative = 0.0;  ///< [following u / leading u²]
};

/// A following value and its derivatives with respect to the leading value, up to the third.
struct CamDerivatives {
  double position = 0.0;
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;  ///< [following u / leading u³]
};

/// Segments of which a cam may be made.
inline constexpr std::size_t kCurveSegments = 50;

/// A polynomial of degree 6 plus a sine, both in the distance from `origin`.
struct CamSegment {
  double origin = 0.0;  ///< leading value
  double coefficient[7] = {};
  double amplitude = 0.0;
  double frequency = 0.0;  ///< [rad / leading u]; 0 without a sine
  double phase = 0.0;      ///< [rad] at the origin; -π … π once `shifted`

  /// Value and two derivatives at a distance from the origin. The cycle's thread or any other.
  CamValue value(double distance) const noexcept;

  /// Derivative of any order from 0 to 7.
  double derivative(int order, double distance) const noexcept;
};

/// Shifts a segment to an origin, in twice the precision of a double: the coefficients of a segment far from
/// 0 cancel in their sum. Finite values. Any thread.
CamSegment shifted(const CamSegment& segment, double origin) noexcept;

/// The distances within 0 … length at which the following value turns, ascending: zeros of the first
/// derivative with a change of its sign. Returns how many were written, at most as many as fit. Not for the
/// cycle: the cost grows with the periods of the sine. Any thread.
int turning_points(const CamSegment& segment, double length, std::span<double> turns) noexcept;

}  // namespace lockstep
