/// Puts an interpolated cam together, piece by piece from its start to its end.
#pragma once

#include "tech_objects/cam/function.hpp"

namespace lockstep {

/// A point of the plane of leading and following values.
struct CamPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Four control points of a cubic Bézier curve; their x ascend.
struct CamBezier {
  CamPoint control[4];
};

/// Writes one CamFunction. Begins with an empty curve; each piece reaches to the start of the next one, the
/// last one to the end. Not for the cycle; does not allocate.
class CamBuilder {
 public:
  /// Periods that all sines of a cam may have together.
  static constexpr double kMaxPeriods = 1024.0;

  explicit CamBuilder(CamFunction& function) noexcept;

  /// c[0] + c[1]·d + c[2]·d² + c[3]·d³ with d counted from `start`.
  void add_cubic(double start, double c0, double c1, double c2, double c3) noexcept;
  void add_bezier(const CamBezier& curve) noexcept;
  /// A segment shifted to its start, of a length; parted where the following value turns.
  void add_segment(const CamSegment& segment, double length) noexcept;

  /// Ends the curve at a leading value with a following value. FALSE, and an empty curve, if it is not a
  /// curve: pieces that do not ascend, are too many or not finite.
  bool finish(double end, double following_value) noexcept;
  /// If it is not a curve: the leading value of the first piece that is none.
  double failed_at() const noexcept { return failed_at_; }

 private:
  CamFunction::Piece* add(double start, CamFunction::Shape shape, std::size_t index) noexcept;
  void clear() noexcept;
  void fail(double leading_value) noexcept;
  bool fails(std::uint32_t piece) const noexcept;
  void index() noexcept;
  void measure() noexcept;

  CamFunction& f_;
  std::size_t beziers_ = 0;
  std::size_t segments_ = 0;
  bool failed_ = false;
  double failed_at_ = 0.0;
};

}  // namespace lockstep
