#include "tech_objects/cam/function.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// The better of two solutions for an approach: the nearer, at equal distance the lower.
void keep_nearer(std::optional<double>& best, double candidate, double approach) noexcept {
  if (!best) {
    best = candidate;
    return;
  }
  const double distance = std::abs(candidate - approach);
  const double best_distance = std::abs(*best - approach);
  if (distance < best_distance || (distance == best_distance && candidate < *best)) best = candidate;
}

}  // namespace

std::uint32_t CamFunction::bucket_of(double x) const noexcept {
  const double bucket = (x - start_) * buckets_per_unit_;
  const auto last = bucket_count_ - 1;
  return bucket < static_cast<double>(last) ? static_cast<std::uint32_t>(bucket) : last;
}

std::uint32_t CamFunction::find(double x, std::uint32_t near) const noexcept {
  // There are as many buckets as pieces: where these are spread evenly, the bucket's number is the piece's.
  const std::uint32_t bucket = bucket_of(x);
  if (x >= pieces_[bucket].start && x < pieces_[bucket + 1].start) return bucket;
  // Else mostly the next piece or the one before.
  if (near < count_ && x >= pieces_[near + 1].start && x < pieces_[near + 2].start) return near + 1;
  if (near > 0 && near <= count_ && x >= pieces_[near - 1].start && x < pieces_[near].start) return near - 1;
  std::uint32_t low = bucket > 0 ? buckets_[bucket - 1] : 0;  // begins at x or before
  std::uint32_t high = buckets_[bucket] + 1;                  // begins after x
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (pieces_[middle].start <= x ? low : high) = middle;
  }
  return low;
}

double CamFunction::parameter(const Piece& piece, double x) const noexcept {
  const Inverse& inverse = inverses_[piece.index];
  const double* b = inverse.b;
  const double distance = x - piece.start;
  const double s = distance * inverse.per_length;
  double t = s * (inverse.guess[0] + s * (inverse.guess[1] + s * inverse.guess[2]));
  double low = 0.0;
  double high = 1.0;
  // Newton's method within a bracket that only shrinks; two or three steps are usual, and where a step leaves
  // the bracket it is halved instead, so that the number of steps has a bound.
  for (int step = 0; step < 64; ++step) {
    t = std::clamp(t, low, high);
    const double rest = t * (b[0] + t * (b[1] + t * b[2])) - distance;
    if (rest == 0.0) return t;
    (rest < 0.0 ? low : high) = t;
    const double slope = b[0] + t * (2.0 * b[1] + t * (3.0 * b[2]));
    double next = t - rest / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - t) <= 4.0e-16) return next;
    t = next;
  }
  return t;
}

CamValue CamFunction::curved_value(const Piece& piece, double x) const noexcept {
  if (piece.shape == Shape::segment) {
    const CamSegment& segment = segments_[piece.index];
    return segment.value(x - segment.origin);
  }
  return bezier_value(piece, parameter(piece, x));
}

CamValue CamFunction::bezier_value(const Piece& piece, double t) const noexcept {
  const double* b = inverses_[piece.index].b;
  const double* c = piece.c;
  const double x1 = b[0] + t * (2.0 * b[1] + t * (3.0 * b[2]));
  const double x2 = 2.0 * b[1] + 6.0 * b[2] * t;
  const double y1 = c[1] + t * (2.0 * c[2] + t * (3.0 * c[3]));
  const double y2 = 2.0 * c[2] + 6.0 * c[3] * t;
  const double slope = y1 / x1;
  return {c[0] + t * (c[1] + t * (c[2] + t * c[3])), slope, (y2 - slope * x2) / (x1 * x1)};
}

CamDerivatives CamFunction::piece_value(std::size_t i, double x) const noexcept {
  const Piece& piece = pieces_[i];
  const double* c = piece.c;
  if (piece.shape == Shape::segment) {
    const CamSegment& segment = segments_[piece.index];
    const double d = x - segment.origin;
    const CamValue value = segment.value(d);
    return {value.position, value.first_derivative, value.second_derivative, segment.derivative(3, d)};
  }
  if (piece.shape == Shape::polynomial) {
    const double d = x - piece.start;
    return {c[0] + d * (c[1] + d * (c[2] + d * c[3])), c[1] + d * (2.0 * c[2] + d * (3.0 * c[3])),
            2.0 * c[2] + 6.0 * c[3] * d, 6.0 * c[3]};
  }
  const double t = parameter(piece, x);
  const CamValue value = bezier_value(piece, t);
  const double* b = inverses_[piece.index].b;
  const double x1 = b[0] + t * (2.0 * b[1] + t * (3.0 * b[2]));
  const double x2 = 2.0 * b[1] + 6.0 * b[2] * t;
  const double rest =
      6.0 * c[3] - 3.0 * value.second_derivative * x1 * x2 - value.first_derivative * 6.0 * b[2];
  return {value.position, value.first_derivative, value.second_derivative, rest / (x1 * x1 * x1)};
}

// A piece's own variable is its distance from its start (of a segment: from the segment's origin), or the
// parameter of a Bézier piece.

double CamFunction::local_value(const Piece& piece, double local) const noexcept {
  if (piece.shape == Shape::segment) return segments_[piece.index].value(local).position;
  return piece.c[0] + local * (piece.c[1] + local * (piece.c[2] + local * piece.c[3]));
}

double CamFunction::local_end(std::uint32_t i) const noexcept {
  const Piece& piece = pieces_[i];
  if (piece.shape == Shape::bezier) return 1.0;
  return pieces_[i + 1].start - (piece.shape == Shape::segment ? segments_[piece.index].origin : piece.start);
}

double CamFunction::leading_of(std::uint32_t i, double local) const noexcept {
  const Piece& piece = pieces_[i];
  double x = piece.start + local;
  if (piece.shape == Shape::segment) x = segments_[piece.index].origin + local;
  if (piece.shape == Shape::bezier) {
    const double* b = inverses_[piece.index].b;
    x = piece.start + local * (b[0] + local * (b[1] + local * b[2]));
  }
  return std::clamp(x, piece.start, pieces_[i + 1].start);
}

/// Where a piece turns inside, ascending in its own variable. Segments are parted where they turn.
int CamFunction::turns_of(std::uint32_t i, double (&turns)[2]) const noexcept {
  const Piece& piece = pieces_[i];
  if (piece.shape == Shape::segment) return 0;
  const double a = 3.0 * piece.c[3];
  const double b = piece.c[2];
  const double root = b * b - a * piece.c[1];
  if (!(root >= 0.0)) return 0;
  const double q = -(b + std::copysign(std::sqrt(root), b));
  const double end = local_end(i);
  int count = 0;
  if (const double first = q / a; first > 0.0 && first < end) turns[count++] = first;
  if (const double second = piece.c[1] / q; second > 0.0 && second < end) turns[count++] = second;
  if (count == 2 && turns[0] > turns[1]) std::swap(turns[0], turns[1]);
  return count;
}

std::optional<double> CamFunction::solve(std::uint32_t i, double y, double approach) const noexcept {
  const Piece& piece = pieces_[i];
  // A stretch that stands at the value has a solution everywhere.
  if (extents_[i].highest - extents_[i].lowest <= tolerance_)
    return std::clamp(approach, piece.start, pieces_[i + 1].start);
  double turns[2];
  const int turn_count = turns_of(i, turns);
  double low = piece.shape == Shape::segment ? piece.start - segments_[piece.index].origin : 0.0;
  double low_value = local_value(piece, low) - y;
  std::optional<double> best;
  for (int k = 0; k <= turn_count; ++k) {  // between two turns the piece is monotone
    const double high = k < turn_count ? turns[k] : local_end(i);
    const double high_value = local_value(piece, high) - y;
    if (std::abs(low_value) <= tolerance_) keep_nearer(best, leading_of(i, low), approach);
    if (std::abs(high_value) <= tolerance_) keep_nearer(best, leading_of(i, high), approach);
    if ((low_value < 0.0) != (high_value < 0.0)) {
      double from = low;
      double to = high;
      const bool rising = low_value < 0.0;
      for (int step = 0; step < 80; ++step) {
        const double middle = 0.5 * (from + to);
        if (!(from < middle && middle < to)) break;
        ((local_value(piece, middle) - y < 0.0) == rising ? from : to) = middle;
      }
      keep_nearer(best, leading_of(i, 0.5 * (from + to)), approach);
    }
    low = high;
    low_value = high_value;
  }
  return best;
}

std::optional<double> CamFunction::solve_below(std::uint32_t i, double y, double approach) const noexcept {
  while (i > 0) {
    if (i % kBlock == 0 && !blocks_[i / kBlock - 1].holds(y, tolerance_)) {
      i -= kBlock;
      continue;
    }
    --i;
    if (!extents_[i].holds(y, tolerance_)) continue;
    if (const auto found = solve(i, y, approach)) return found;
  }
  return std::nullopt;
}

std::optional<double> CamFunction::solve_above(std::uint32_t i, double y, double approach) const noexcept {
  for (++i; i < count_;) {
    if (i % kBlock == 0 && !blocks_[i / kBlock].holds(y, tolerance_)) {
      i += kBlock;
      continue;
    }
    if (extents_[i].holds(y, tolerance_))
      if (const auto found = solve(i, y, approach)) return found;
    ++i;
  }
  return std::nullopt;
}

std::optional<double> CamFunction::leading_value(double following_value, double approach) const noexcept {
  if (!interpolated() || !std::isfinite(following_value) || !std::isfinite(approach)) return std::nullopt;
  const double near = clamped(approach);
  const std::uint32_t i = std::min(find(near, count_ + 1), count_ - 1);
  std::optional<double> best;
  if (extents_[i].holds(following_value, tolerance_)) best = solve(i, following_value, near);
  if (const auto below = solve_below(i, following_value, near)) keep_nearer(best, *below, near);
  if (const auto above = solve_above(i, following_value, near)) keep_nearer(best, *above, near);
  return best;
}

}  // namespace lockstep
