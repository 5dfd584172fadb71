#include "tech_objects/cam_design/motion_law_segment.hpp"

#include <algorithm>

#include "tech_objects/cam_design/motion_law_polynomial.hpp"

namespace lockstep {

TO_Cam_Struct_SegmentData segment_of(const MotionPiece& piece) noexcept {
  const double* c = piece.coefficient;
  const MotionPiece::Sine& sine = piece.sine[0];
  return {piece.start,    piece.start + piece.length,
          c[0],           c[1],
          c[2],           c[3],
          c[4],           c[5],
          c[6],           sine.amplitude,
          sine.frequency, sine.phase,
          piece.start};
}

TO_Cam_Struct_SegmentData segment_between(const MotionValue& left, int left_order, const MotionValue& right,
                                          int right_order, double start, double length) noexcept {
  const auto conditions = [&](const MotionValue& value, int orders) {
    const double all[] = {value.position, value.velocity * length, value.acceleration * length * length,
                          value.jerk * length * length * length};
    EndConditions result;
    for (int k = 0; k <= orders; ++k) result.derivative[k] = all[k];
    return result;
  };
  double c[8];
  polynomial_between(conditions(left, left_order), conditions(right, right_order), c);  // 7 of them: exists
  MotionPiece piece;
  piece.start = start;
  piece.length = length;
  double scale = 1.0;
  for (int k = 0; k < 8; ++k) {
    piece.coefficient[k] = c[k] * scale;
    scale /= length;
  }
  return segment_of(piece);
}

std::size_t MotionLaw::segments(std::span<TO_Cam_Struct_SegmentData> segments) const noexcept {
  if (becomes_points()) return 0;
  std::size_t written = 0;
  for (const MotionPiece& p : pieces()) {
    const bool degree_7 = p.coefficient[7] != 0.0;
    if (written + (degree_7 ? 2 : 1) > segments.size()) return 0;
    if (!degree_7) {
      segments[written++] = segment_of(p);
      continue;
    }
    const double half = 0.5 * p.length;
    const MotionValue middle = p.value(half);
    segments[written++] = segment_between(p.value(0.0), 3, middle, 2, p.start, half);
    segments[written++] = segment_between(middle, 2, p.value(p.length), 3, p.start + half, half);
  }
  // Pieces meet, and the last one ends, where the transition says, to the last bit.
  for (std::size_t i = 0; i + 1 < written; ++i) segments[i].xmax = segments[i + 1].xmin;
  if (written > 0) segments[written - 1].xmax = end_;
  return written;
}

}  // namespace lockstep
