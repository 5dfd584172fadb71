/// Interpolation: from the points and segments of a cam to its function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/cam/builder.hpp"
#include "tech_objects/cam/function.hpp"
#include "tech_objects/cam/spline.hpp"
#include "tech_objects/cam_object/segment_data.hpp"
#include "tech_objects/data_blocks/cam_data.hpp"

namespace lockstep {

/// Why elements make no curve, which element it is, and the values that do not fit.
struct CamFault {
  enum class Reason : std::uint8_t {
    none,
    no_element,         ///< no valid one
    settings,           ///< InterpolationMode or BoundaryConditions is unknown
    number,             ///< `value` is not finite or beyond 1.0E12
    order,              ///< xmax, `value`, is not above xmin, `other`
    one_leading_value,  ///< `value` is the only one
    periods,            ///< of all sines together: `value`; the element has the most, `other`
    end_slopes,         ///< with BoundaryConditions 1: the last segment ends with `value`, the first begins
                        ///< with `other`
    too_many_points,    ///< more than the interpolator is for
    too_many_segments,  ///< more than a cam has
    not_held            ///< a double cannot hold the curve at leading value `value`
  };

  Reason reason = Reason::none;
  bool segment = false;     ///< the element is a segment, not a point
  std::size_t element = 0;  ///< index in the data block, from 0
  double value = 0.0;
  double other = 0.0;

  ErrorId error() const noexcept;
};

/// Interpolates cams of up to a number of points, in storage of its own: one per thread that interpolates,
/// not in the cycle (some milliseconds for 10,000 points).
///
/// Rules, for valid elements in any order:
/// - Of points with equal leading value the one with the highest index counts.
/// - Segments: where several overlap, the one that begins last counts up to its end (of those that begin
///   together, the one with the highest index), then the one it cut off again.
/// - Gaps up to 1.0E-4 between segments are closed: the earlier one goes on to the start of the later.
/// - A point within a segment, or within 1.0E-4 of it, does not count; the first and the last point of a cam
///   still bound its range of definition, and the segment goes on to them.
/// - What is left between the elements is closed as InterpolationMode says:
///   linear: lines (BoundaryConditions has no effect);
///   cubic: splines through the points that take the slope of a segment beside them; without
///   BoundaryConditions natural at a free end, with them equal first and second derivative at both ends of
///   the cam; Bézier: clamped uniform cubic B-splines controlled by the points. Beside a segment a control
///   point on its tangent, a third of the distance to the next element, makes the slope continuous. With
///   BoundaryConditions the second and the last-but-one point of a cam of points move so that both end legs
///   have their mean slope (a third point between both: onto the line between the ends); free ends beside
///   segments get a control point.
/// - BoundaryConditions and one end in a segment: the free end takes its slope; both ends in segments: they
///   must agree within 1.0E-6 of the slopes and of the mean slope of the cam.
/// @source S7-1500T synchronous operation V7, 8.1.3.11; 8.3.2; 12.2.1
class CamInterpolator {
 public:
  /// For cams of at most so many points; allocates.
  explicit CamInterpolator(std::size_t points);

  /// Interpolates `elements` into `function`, whose capacity is for as many points. 16#80AA without a valid
  /// element; 16#80AC: a value that is not finite or beyond 1.0E12, xmin not below xmax, all in one leading
  /// value, unknown settings, more than 1024 periods of sines, slopes at both ends that disagree, more points
  /// than there is space for, or a curve whose coefficients a double cannot hold. After an error the function
  /// is empty. Any one thread; does not allocate.
  ErrorId interpolate(const CamElements& elements, CamFunction& function) noexcept;

  /// A point of the data block.
  struct Point {
    CamPoint at;
    std::uint32_t index = 0;
  };
  /// A stretch of the leading range that a segment fills.
  struct Part {
    double from = 0.0;
    double to = 0.0;
    std::size_t index = 0;
    CamSegment segment;
    CamValue at_from;
    CamValue at_to;
  };

  // Of the last interpolation, for those who tell what became of the elements. The thread that interpolates.

  const CamFault& fault() const noexcept { return fault_; }
  /// The points that count, and the stretches in which segments count; both ascending.
  std::span<const Point> points() const noexcept { return points_; }
  std::span<const Part> parts() const noexcept { return parts_; }

 private:
  bool fail(const CamFault& fault) noexcept;
  bool fail_at(double leading_value) noexcept;
  bool make(const CamElements& elements, CamFunction& function) noexcept;
  bool collect_points(const CamElements& elements) noexcept;
  bool collect_parts(const CamElements& elements) noexcept;
  void close_small_gaps() noexcept;
  void drop_points_in_parts() noexcept;
  bool shift_parts(const CamElements& elements) noexcept;

  bool build(const TO_Cam_Struct_InterpolationSettings& settings, CamFunction& function) noexcept;
  bool find_end_slopes() noexcept;
  void fill_run(std::size_t gap) noexcept;
  void close_gap(CamBuilder& cam, std::size_t gap, DINT mode) noexcept;
  void close_cubic(CamBuilder& cam, std::size_t gap) noexcept;
  void close_bezier(CamBuilder& cam, std::size_t gap) noexcept;
  void level_end_legs() noexcept;

  std::optional<double> left_slope(std::size_t gap) const noexcept;
  std::optional<double> right_slope(std::size_t gap) const noexcept;
  bool head() const noexcept;  // points before the first segment
  bool tail() const noexcept;  // points behind the last one

  std::size_t capacity_;  // points
  CamSpline spline_;
  std::vector<Point> points_;
  std::vector<Part> parts_;
  CamFault fault_;
  std::vector<CamPoint> run_;  // what closes one gap: its points and the ends of the segments beside
  std::vector<CamPoint> other_run_;
  bool closed_ = false;                   // the ends of the cam are to agree
  std::optional<double> free_end_slope_;  // if so, and known before the gap is closed
};

/// What StatusCam shows after an interpolation: the range of definition of the function and the numbers of
/// elements with ValidPoint or ValidSegment. Walks all elements: not for the cycle.
TO_Cam_Struct_StatusCam status_of(const CamElements& elements, const CamFunction& function) noexcept;

}  // namespace lockstep
