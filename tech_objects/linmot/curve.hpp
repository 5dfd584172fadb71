/// Motion curves over time: formulas and points, as the curve creator makes them.
/// @source LinMot release 1.3 addendum, 1.4, 1.5, 7.4
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tech_objects/cam/builder.hpp"
#include "tech_objects/cam/function.hpp"

namespace lockstep::linmot {

inline constexpr int kCurves = 64;  ///< numbers 0 to 63; 0 is the empty one

enum class CurveType : std::uint8_t { sine, point_to_point, minimal_jerk, limited_jerk, manual };
/// Of Minimal Jerk: of the smallest maximum of the jerk, or of the smallest sum of its squares.
enum class JerkLaw : std::uint8_t { peak, quintic };

/// A curve, or one of several in a row.
struct CurvePart {
  CurveType type = CurveType::minimal_jerk;
  JerkLaw law = JerkLaw::peak;
  double start = 0.0, end = 0.0;  ///< [mm]
  double time = 0.0;              ///< [s] of Sine and Minimal Jerk
  double speed = 0.0;             ///< [m/s] of the others but Manual
  double acceleration = 0.0;      ///< [m/s²]
  double jerk = 0.0;              ///< [m/s³] of Limited Jerk; 0: acceleration²/speed
  std::vector<CamPoint> points;   ///< [s, mm] of Manual
};

/// Velocities [m/s], accelerations [m/s²] and jerks [m/s³] that a curve has at most.
struct CurvePeaks {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;
};

/// Position [mm] over time [s]. Immutable once made.
class Curve {
 public:
  /// While loading. @return whether it is a curve: times above 0, points that ascend, all finite
  bool make(std::span<const CurvePart> parts);

  bool exists() const noexcept { return function_.has_value(); }
  // Of a curve that exists:
  double duration() const noexcept { return function_->end_leading_value(); }   ///< [s]
  double start() const noexcept { return function_->start_following_value(); }  ///< [mm]
  double end() const noexcept { return function_->end_following_value(); }      ///< [mm]
  const CamFunction& function() const noexcept { return *function_; }
  /// Not in the cycle.
  CurvePeaks peaks() const;

 private:
  std::optional<CamFunction> function_;  // most numbers have none, and it is large
};

}  // namespace lockstep::linmot
