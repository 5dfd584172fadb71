/// The interpolated cam: following value and derivatives as a function of the leading value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "tech_objects/cam/segment.hpp"

namespace lockstep {

/// Where a user of a cam was last: with it, the value at a moving leading value costs no search. One per
/// user, so that several axes share one cam. Any hint is right, even one of another cam; a good one is fast.
struct CamHint {
  std::uint32_t piece = 0;
};

/// y = f(x) from the start to the end leading value, both included. Immutable except through CamBuilder; any
/// number of threads may read it while nobody builds it. Every function here is free of allocation.
///
/// Where the curve has a corner, the derivatives are those to the right of it; at the end, those to the left.
/// @source S7-1500T synchronous operation V7, 8.3
class CamFunction {
 public:
  /// Storage for a cam of so many points and 50 segments; not for the cycle.
  explicit CamFunction(std::size_t points);

  /// Whether there is a curve; before the first interpolation and after a failed one there is none.
  bool interpolated() const noexcept { return count_ > 0; }

  /// Range of definition [leading u]; start < end for a curve, 0 and 0 without one.
  double start_leading_value() const noexcept { return start_; }
  double end_leading_value() const noexcept { return end_; }
  bool defined_at(double leading_value) const noexcept {
    return interpolated() && leading_value >= start_ && leading_value <= end_;
  }

  /// Minimum and maximum following value [following u].
  double lowest_following_value() const noexcept { return lowest_; }
  double highest_following_value() const noexcept { return highest_; }

  /// Following values at start and end, exactly those that `value` gives there.
  double start_following_value() const noexcept { return pieces_[0].c[0]; }
  double end_following_value() const noexcept { return pieces_[count_].c[0]; }

  /// Value at a leading value. Outside the range of definition: that at the nearer end (NaN: at the start);
  /// zero without a curve. The cycle's thread, with a hint of its own.
  CamValue value(double leading_value, CamHint& hint) const noexcept {
    const double x = clamped(leading_value);
    std::uint32_t i = hint.piece;
    if (!(i <= count_ && x >= pieces_[i].start && x < pieces_[i + 1].start)) hint.piece = i = find(x, i);
    const Piece& piece = pieces_[i];
    if (piece.shape != Shape::polynomial) return curved_value(piece, x);
    const double d = x - piece.start;
    const double* c = piece.c;
    return {c[0] + d * (c[1] + d * (c[2] + d * c[3])), c[1] + d * (2.0 * c[2] + d * (3.0 * c[3])),
            2.0 * c[2] + 6.0 * c[3] * d};
  }

  /// Value at a leading value, without a hint.
  CamValue value(double leading_value) const noexcept {
    CamHint hint{count_ + 1};
    return value(leading_value, hint);
  }

  /// The leading value nearest to `approach` that has a following value: of all the cam's solutions, at equal
  /// distance the lower. A following value up to 1.0E-12 of the largest beyond an extremum counts as that
  /// extremum. None if the cam does not take the value, has no curve, or an argument is not finite. An
  /// approach outside the range of definition counts as the nearer end.
  ///
  /// Bounded: blocks of pieces that cannot hold the value are passed over in one comparison. The cycle's
  /// thread or any other.
  std::optional<double> leading_value(double following_value, double approach) const noexcept;

  /// Pieces that the curve is made of, each given by one formula.
  std::size_t piece_count() const noexcept { return count_; }
  /// Leading value at which a piece starts; for piece_count() that at the end.
  double piece_start(std::size_t piece) const noexcept { return pieces_[piece].start; }
  /// Value and derivatives by the formula of one piece, within it or at its ends: at a joint this tells what
  /// is to the left from what is to the right.
  CamDerivatives piece_value(std::size_t piece, double leading_value) const noexcept;

 private:
  friend class CamBuilder;

  enum class Shape : std::uint32_t { polynomial, bezier, segment };

  /// One stretch of the curve. polynomial: cubic in the distance from start; bezier: cubic in a parameter
  /// 0 … 1, which Inverse gives for a leading value; segment: as segments_ says.
  struct Piece {
    double start;
    double c[4];
    Shape shape;
    std::uint32_t index;  // into inverses_ or segments_
  };

  /// The leading value of a Bézier piece as a cubic of its parameter, less the start, and a cubic of
  /// distance / length that is near the inverse.
  struct Inverse {
    double b[3];
    double guess[3];
    double per_length;
  };

  /// Minimum and maximum following value of a piece or of a block of pieces.
  struct Extent {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();

    void include(double value) noexcept {
      if (value < lowest) lowest = value;
      if (value > highest) highest = value;
    }
    bool holds(double value, double tolerance) const noexcept {
      return value >= lowest - tolerance && value <= highest + tolerance;
    }
  };

  static constexpr std::uint32_t kBlock = 64;  // pieces that share one extent

  double clamped(double x) const noexcept {
    if (!(x > start_)) return start_;
    return x < end_ ? x : end_;
  }
  std::uint32_t bucket_of(double x) const noexcept;
  std::uint32_t find(double x, std::uint32_t near) const noexcept;
  CamValue curved_value(const Piece& piece, double x) const noexcept;
  double parameter(const Piece& piece, double x) const noexcept;
  CamValue bezier_value(const Piece& piece, double t) const noexcept;

  int turns_of(std::uint32_t piece, double (&turns)[2]) const noexcept;
  double local_value(const Piece& piece, double local) const noexcept;
  double leading_of(std::uint32_t piece, double local) const noexcept;
  double local_end(std::uint32_t piece) const noexcept;
  std::optional<double> solve(std::uint32_t piece, double following_value, double approach) const noexcept;
  std::optional<double> solve_below(std::uint32_t piece, double following_value,
                                    double approach) const noexcept;
  std::optional<double> solve_above(std::uint32_t piece, double following_value,
                                    double approach) const noexcept;

  std::vector<Piece> pieces_;           // count_ of them, one for the end, one at infinity
  std::vector<Inverse> inverses_;       // of the Bézier pieces
  std::vector<CamSegment> segments_;    // of the segment pieces
  std::vector<std::uint32_t> buckets_;  // last piece that begins in a bucket of the leading range or before
  std::vector<Extent> extents_;         // per piece
  std::vector<Extent> blocks_;          // per kBlock pieces
  std::uint32_t count_ = 0;
  std::uint32_t bucket_count_ = 0;
  double start_ = 0.0;
  double end_ = 0.0;
  double buckets_per_unit_ = 0.0;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  double tolerance_ = 0.0;  // [following u] of leading_value
};

/// The curve in use and a second one to interpolate into. The thread that interpolates writes `spare`; the
/// cycle, once it has been told that this is done (an acquiring read of what that thread released), swaps:
/// from the same tick on every user of the cam sees the new curve.
class CamFunctionPair {
 public:
  explicit CamFunctionPair(std::size_t points) : functions_{CamFunction(points), CamFunction(points)} {}

  const CamFunction& active() const noexcept { return functions_[active_]; }  ///< the cycle's thread
  CamFunction& spare() noexcept { return functions_[1 - active_]; }  ///< one thread between two swaps
  void swap() noexcept { active_ = 1 - active_; }                    ///< the cycle's thread

 private:
  CamFunction functions_[2];
  int active_ = 0;
};

}  // namespace lockstep
