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

}  // namespace lockstep
