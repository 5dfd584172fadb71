#include "tech_objects/cam/builder.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr std::size_t kSegmentParts = 2 * kCurveSegments;  // each segment may be cut in two by another
/// Parts of segments between turns: two turns a period of a sine, and what a polynomial adds.
constexpr std::size_t kTurns = 2 * static_cast<std::size_t>(CamBuilder::kMaxPeriods) + 10 * kSegmentParts;
/// Pieces that close a gap beside segments: up to two control points more than points.
constexpr std::size_t kClosings = 4 * kSegmentParts;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

CamFunction::CamFunction(std::size_t points)
    : pieces_(points + kClosings + kTurns + 2),
      inverses_(points + kClosings),
      segments_(kSegmentParts),
      buckets_(points + kClosings + kTurns),
      extents_(points + kClosings + kTurns),
      blocks_((points + kClosings + kTurns) / kBlock + 1) {
  CamBuilder{*this};
}

CamBuilder::CamBuilder(CamFunction& function) noexcept : f_(function) {
  clear();
}

void CamBuilder::clear() noexcept {
  f_.count_ = 0;
  f_.bucket_count_ = 1;
  f_.buckets_[0] = 0;
  f_.start_ = f_.end_ = f_.lowest_ = f_.highest_ = f_.tolerance_ = f_.buckets_per_unit_ = 0.0;
  f_.pieces_[0] = {0.0, {}, CamFunction::Shape::polynomial, 0};
  f_.pieces_[1] = {kInfinity, {}, CamFunction::Shape::polynomial, 0};
}

void CamBuilder::fail(double leading_value) noexcept {
  if (!failed_) failed_at_ = leading_value;
  failed_ = true;
}

CamFunction::Piece* CamBuilder::add(double start, CamFunction::Shape shape, std::size_t index) noexcept {
  if (f_.count_ + 2 >= f_.pieces_.size()) fail(start);
  if (f_.count_ > 0 && !(start > f_.pieces_[f_.count_ - 1].start)) fail(start);
  if (failed_) return nullptr;
  CamFunction::Piece& piece = f_.pieces_[f_.count_++];
  piece = {start, {}, shape, static_cast<std::uint32_t>(index)};
  return &piece;
}

void CamBuilder::add_cubic(double start, double c0, double c1, double c2, double c3) noexcept {
  CamFunction::Piece* const piece = add(start, CamFunction::Shape::polynomial, 0);
  if (piece == nullptr) return;
  piece->c[0] = c0;
  piece->c[1] = c1;
  piece->c[2] = c2;
  piece->c[3] = c3;
}

void CamBuilder::add_bezier(const CamBezier& curve) noexcept {
  if (beziers_ >= f_.inverses_.size()) fail(curve.control[0].x);
  CamFunction::Piece* const piece = add(curve.control[0].x, CamFunction::Shape::bezier, beziers_);
  if (piece == nullptr) return;
  const auto& p = curve.control;
  piece->c[0] = p[0].y;
  piece->c[1] = 3.0 * (p[1].y - p[0].y);
  piece->c[2] = 3.0 * ((p[2].y - p[1].y) - (p[1].y - p[0].y));
  piece->c[3] = (p[3].y - p[0].y) - 3.0 * (p[2].y - p[1].y);
  CamFunction::Inverse& inverse = f_.inverses_[beziers_++];
  const double length = p[3].x - p[0].x;
  inverse.b[0] = 3.0 * (p[1].x - p[0].x);
  inverse.b[1] = 3.0 * ((p[2].x - p[1].x) - (p[1].x - p[0].x));
  inverse.b[2] = length - 3.0 * (p[2].x - p[1].x);
  inverse.per_length = 1.0 / length;
  // The guess has the inverse's ends and, up to three times the mean slope (so that it stays monotone), its
  // end slopes.
  const double left = std::min(3.0, length / inverse.b[0]);
  const double right = std::min(3.0, length / (3.0 * (p[3].x - p[2].x)));
  inverse.guess[0] = left;
  inverse.guess[1] = 3.0 - 2.0 * left - right;
  inverse.guess[2] = left + right - 2.0;
}

void CamBuilder::add_segment(const CamSegment& segment, double length) noexcept {
  if (segments_ >= f_.segments_.size()) fail(segment.origin);
  if (failed_) return;
  f_.segments_[segments_] = segment;
  double turns[kTurns];
  const int count = turning_points(segment, length, turns);
  add(segment.origin, CamFunction::Shape::segment, segments_);
  for (int k = 0; k < count; ++k) {
    const double start = segment.origin + turns[k];
    const double before = f_.count_ > 0 ? f_.pieces_[f_.count_ - 1].start : segment.origin;
    if (start > before && start < segment.origin + length) add(start, CamFunction::Shape::segment, segments_);
  }
  ++segments_;
}

bool CamBuilder::finish(double end, double following_value) noexcept {
  if (f_.count_ == 0 || !(end > f_.pieces_[f_.count_ - 1].start) || !std::isfinite(end) ||
      !std::isfinite(following_value))
    fail(end);
  if (failed_) {
    clear();
    return false;
  }
  f_.start_ = f_.pieces_[0].start;
  // What start_following_value() reads, whatever the shape.
  if (f_.pieces_[0].shape == CamFunction::Shape::segment)
    f_.pieces_[0].c[0] = f_.curved_value(f_.pieces_[0], f_.start_).position;
  f_.end_ = end;
  f_.pieces_[f_.count_] = {kInfinity, {}, CamFunction::Shape::polynomial, 0};
  // The end is a piece of its own, so that the value there is the defined one to the last bit. Until it is
  // known what the last piece gives there, that one reaches beyond.
  const CamFunction::Piece& last = f_.pieces_[f_.count_ - 1];
  CamValue at_end;
  if (last.shape == CamFunction::Shape::polynomial) {
    const double d = end - last.start;
    at_end.first_derivative = last.c[1] + d * (2.0 * last.c[2] + d * (3.0 * last.c[3]));
    at_end.second_derivative = 2.0 * last.c[2] + 6.0 * last.c[3] * d;
  } else {
    at_end = f_.curved_value(last, end);
  }
  f_.pieces_[f_.count_] = {end,
                           {following_value, at_end.first_derivative, 0.5 * at_end.second_derivative, 0.0},
                           CamFunction::Shape::polynomial,
                           0};
  f_.pieces_[f_.count_ + 1] = {kInfinity, {}, CamFunction::Shape::polynomial, 0};
  index();
  measure();
  if (!std::isfinite(f_.buckets_per_unit_)) fail(f_.start_);
  for (std::uint32_t i = 0; i <= f_.count_ && !failed_; ++i)
    if (fails(i)) fail(f_.pieces_[i].start);
  if (failed_) clear();
  return !failed_;
}

/// Buckets of equal width over the leading range, as many as pieces: where the pieces are spread evenly, a
/// search begins at its end.
void CamBuilder::index() noexcept {
  f_.bucket_count_ = f_.count_;
  f_.buckets_per_unit_ = static_cast<double>(f_.bucket_count_) / (f_.end_ - f_.start_);
  std::uint32_t bucket = 0;
  for (std::uint32_t i = 0; i <= f_.count_; ++i) {
    const std::uint32_t of_piece = f_.bucket_of(f_.pieces_[i].start);
    for (; bucket < of_piece; ++bucket) f_.buckets_[bucket] = i - 1;
    f_.buckets_[bucket] = i;
  }
  for (; bucket < f_.bucket_count_; ++bucket) f_.buckets_[bucket] = f_.count_;
}

void CamBuilder::measure() noexcept {
  CamFunction::Extent whole;
  for (std::uint32_t i = 0; i < f_.count_; ++i) {
    const CamFunction::Piece& piece = f_.pieces_[i];
    CamFunction::Extent extent;
    const bool segment = piece.shape == CamFunction::Shape::segment;
    extent.include(f_.local_value(piece, segment ? piece.start - f_.segments_[piece.index].origin : 0.0));
    extent.include(f_.local_value(piece, f_.local_end(i)));
    double turns[2];
    const int count = f_.turns_of(i, turns);
    for (int k = 0; k < count; ++k) extent.include(f_.local_value(piece, turns[k]));
    f_.extents_[i] = extent;
    if (i % CamFunction::kBlock == 0) f_.blocks_[i / CamFunction::kBlock] = {};
    CamFunction::Extent& block = f_.blocks_[i / CamFunction::kBlock];
    block.include(extent.lowest);
    block.include(extent.highest);
    whole.include(extent.lowest);
    whole.include(extent.highest);
  }
  f_.lowest_ = whole.lowest;
  f_.highest_ = whole.highest;
  f_.tolerance_ = 1.0e-12 * std::max(std::abs(whole.lowest), std::abs(whole.highest));
}

/// Whether something in a piece, or in the end of the curve, is not finite.
bool CamBuilder::fails(std::uint32_t i) const noexcept {
  const CamFunction::Piece& piece = f_.pieces_[i];
  double sum = 0.0;  // NaN as soon as one value is not finite
  for (const double c : piece.c) sum += c * 0.0;
  if (piece.shape == CamFunction::Shape::bezier) {
    const CamFunction::Inverse& inverse = f_.inverses_[piece.index];
    // Derivatives are largest where the curve is steepest: at an end, or where x(t) is slowest inside.
    const double slowest = std::clamp(-inverse.b[1] / (3.0 * inverse.b[2]), 0.0, 1.0);
    for (const double t : {0.0, slowest == slowest ? slowest : 0.5, 1.0}) {
      const CamValue value = f_.bezier_value(piece, t);
      sum += (value.position + value.first_derivative + value.second_derivative) * 0.0;
    }
  }
  if (piece.shape == CamFunction::Shape::segment)
    for (const double c : f_.segments_[piece.index].coefficient) sum += c * 0.0;
  if (i < f_.count_) sum += (f_.extents_[i].lowest + f_.extents_[i].highest) * 0.0;
  return sum != 0.0;  // TRUE for NaN
}

}  // namespace lockstep
