/// What a cam is designed from, and what comes of it. For the desk, not for the cycle: everything here
/// allocates.
/// @source S7-1500T synchronous operation V7, 8.1.3, 8.3; VDI 2143 part 1
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tech_objects/cam/function.hpp"
#include "tech_objects/cam_design/motion_law.hpp"
#include "tech_objects/data_blocks/cam_data.hpp"

namespace lockstep {

/// A point that the curve runs through (Bézier: that guides it). Derivatives count at transitions by a law
/// alone; one that is not given counts as 0 there.
struct CamPointElement {
  double x = 0.0;  ///< leading value
  double y = 0.0;  ///< following value
  std::optional<double> velocity;
  std::optional<double> acceleration;
  std::optional<double> jerk;
};

/// Points with an interpolation of their own.
struct CamPointGroup {
  /// Ascending, two at least. Relative: 0 … 1 of `start` … `end`, and of `lowest` … `highest`.
  std::vector<TO_Cam_Struct_PointData> points;
  bool relative_x = false;
  bool relative_y = false;
  std::optional<double> start, end, lowest, highest;  ///< for what is relative, and only then
  bool bezier = false;                                ///< else cubic splines
  bool as_segments = false;                           ///< mapped to segments, else to points
  /// Interpolation points of the mapping: the points of the group themselves if it has as many, else evenly
  /// spaced.
  std::size_t count = 32;
  std::optional<double> tolerance;  ///< of the mapping [following u]; a larger deviation is warned of
};

/// Constant velocity; two of the three.
struct CamLine {
  double start = 0.0, end = 0.0;
  std::optional<double> start_value, end_value, slope;
};

/// The sine of an element; two of the four, but not period and frequency.
struct CamWave {
  double amplitude = 0.0;
  std::optional<double> start_phase, end_phase;  ///< [°]
  std::optional<double> period;                  ///< [leading u], > 0
  std::optional<double> frequency;               ///< [1 / leading u], > 0
};

/// A sine about a constant (`offset`) or about a line (two of the other three).
struct CamSine {
  double start = 0.0, end = 0.0;
  CamWave wave;
  std::optional<double> offset;
  std::optional<double> start_offset, end_offset, inclination;
};

/// A polynomial by its coefficients (x being the leading value itself) or by its values at both ends; with a
/// sine on top of the coefficients, or within the values.
struct CamPolynomial {
  double start = 0.0, end = 0.0;
  std::optional<std::array<double, 7>> coefficients;
  std::optional<double> start_value, start_velocity, start_acceleration, start_jerk;
  std::optional<double> end_value, end_velocity, end_acceleration, end_jerk;
  std::optional<double> lambda;     ///< position of the inflection point, 0 … 1 of the element
  std::optional<double> lambda_at;  ///< that position as a leading value
  std::optional<CamWave> wave;
};

/// The arcsine over a part of -1 … 1, as points.
struct CamInverseSine {
  double start = 0.0, end = 0.0;
  double lowest = 0.0, highest = 0.0;  ///< following values
  bool mirrored = false;               ///< falls from highest to lowest
  double from = -1.0, to = 1.0;        ///< part of the domain of the arcsine
  std::size_t count = 32;              ///< points
  std::optional<double> tolerance;     ///< as of a point group
};

using CamShape =
    std::variant<CamPointElement, CamPointGroup, CamLine, CamSine, CamPolynomial, CamInverseSine>;
/// Such as "point group".
std::string_view cam_shape_name(const CamShape& shape) noexcept;

/// What a law is chosen by, if none is named: the minimum normalised peak.
enum class CamGoal : std::uint8_t { none, velocity, acceleration, jerk, torque };

/// A transition after a motion law. Without one, the interpolation of the cam closes the gap.
struct CamTransition {
  std::optional<MotionLawKind> law;  ///< none: by the goal; without a goal the polynomial
  std::optional<CamGoal> goal;       ///< none: that of the design
  /// Up to which derivative the curve is to be continuous. None: as the design says; if that says nothing, as
  /// much as the law named keeps, at most the acceleration. Jerk at one end only.
  std::optional<Continuity> start_continuity, end_continuity;
  std::optional<double> lambda;     ///< position of the inflection point, 0 … 1 of the transition
  std::optional<double> lambda_at;  ///< that position as a leading value
  std::optional<double> ca, ca_star;
  std::size_t count = MotionLaw::kDefaultPoints;  ///< points of a law that becomes points
  std::optional<double> tolerance;
  std::string comment;
};

struct CamElement {
  CamShape shape;
  std::string comment;
  std::optional<CamTransition> transition;  ///< to the next element
  std::string gap_comment{};                ///< of a transition that is left to the interpolation of the cam
};

struct CamDesign {
  std::vector<CamElement> elements;  ///< ascending
  TO_Cam_Struct_InterpolationSettings interpolation{1, 0};
  std::optional<Continuity> continuity;  ///< of transitions by a law
  CamGoal goal = CamGoal::none;
};

/// Something wrong with a design, or worth a look.
struct CamFinding {
  static constexpr std::size_t kWhole = ~std::size_t{0};

  std::size_t element = kWhole;  ///< index; kWhole: the cam as a whole
  bool transition = false;       ///< the transition behind that element
  std::string_view field;        ///< name of the member that is meant, empty if it is not one alone
  std::string text;
};

/// An element or a transition by a law in the finished cam.
struct CamStretch {
  std::size_t element = 0;
  bool transition = false;
  double from = 0.0;
  double to = 0.0;
  std::size_t points = 0;    ///< of the data block, that it takes
  std::size_t segments = 0;  ///< of the data block, that it takes
  /// The curve before its mapping to points and segments; empty for a point.
  std::function<MotionValue(double)> curve;
  /// Of a transition: its law, what it connects and what it keeps.
  std::optional<MotionLaw> law;
  MotionLawKind kind = MotionLawKind::polynomial;
  MotionTask start_task = MotionTask::rest, end_task = MotionTask::rest;
  Continuity start_continuity = Continuity::position, end_continuity = Continuity::position;
  MotionBoundary at_start, at_end;  ///< of an element: its own; of a transition: those beside it
  std::optional<double> tolerance;
  double deviation = 0.0;  ///< maximum, of the finished cam from `curve` [following u]
};

/// The outcome of a design, or of points and segments that are given as such.
struct DesignedCam {
  std::vector<TO_Cam_Struct_PointData> points;
  std::vector<TO_Cam_Struct_SegmentData> segments;
  TO_Cam_Struct_InterpolationSettings interpolation;
  std::vector<CamStretch> stretches;  ///< ascending; none for points and segments given as such
  std::vector<CamFinding> problems;
  std::vector<CamFinding> warnings;
  std::shared_ptr<const CamFunction> function;  ///< the interpolated cam; none with problems
};

/// Findings by element: the index of a point in the data block, or, with `transition`, that of a segment.
struct CamFindings {
  std::vector<CamFinding> problems;  ///< why there is no curve
  std::vector<CamFinding> warnings;  ///< what is legal and looks like a mistake
};

}  // namespace lockstep
