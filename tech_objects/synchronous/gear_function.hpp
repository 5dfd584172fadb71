/// The gear: a following position as an exact linear function of the leading position.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/double_double.hpp"

namespace lockstep {

/// F(L) = S0 + numerator / denominator · (L - L0), with turns on both sides.
///
/// The reference is rational arithmetic on the doubles given: a modulo following axis is right to less than
/// one ulp of its position (or of Modulo.Length, if that is larger), any other to less than one ulp of the
/// largest term, at any number of turns and without drift: the distance of whole leading turns is kept in
/// integers (fixed point of 2^-62, a remainder over the denominator, turns of the following axis), and only
/// the distance within a leading turn is computed in double-double.
/// @source S7-1500T synchronous operation V7, 6.1 (formula of the synchronous function)
class GearFunction {
 public:
  /// 1:1 between linear axes from 0 to 0.
  GearFunction() noexcept { set(1, 1, {}, {}, {}, {}); }

  /// Defines the gear. Numerator: any but 0; denominator: 1 … 2^31-1 (0 and less count as 1: refuse them
  /// before). Modulo.Length 0.001 … 1.0E12; positions normalised and below 2^63. The cycle's thread.
  void set(std::int32_t numerator, std::int32_t denominator, AxisPosition leading_start,
           AxisPosition following_start, const Modulo& leading, const Modulo& following) noexcept;

  /// Following position at a leading position (normalised, finite, below 2^63). Turns are counted exactly and
  /// wrap at 64 bits. Costs the same few operations for any step within a leading turn or to the next one; a
  /// bounded number more (below a microsecond) for a jump over several turns. The cycle's thread.
  AxisPosition value(AxisPosition leading) noexcept;

  /// Moves the function by whole turns of a modulo following axis.
  void add_turns(std::int64_t turns) noexcept;
  /// Counts the turns of a modulo leading axis anew, by so many more: at those the function is what it was.
  void add_leading_turns(std::int64_t turns) noexcept;

  /// [u/s], [u/s²] of the following axis: ratio times the leading quantity, within one ulp.
  double velocity(double leading_velocity) const noexcept { return geared(leading_velocity); }
  double acceleration(double leading_acceleration) const noexcept { return geared(leading_acceleration); }

  /// numerator / denominator, within 2^-103 of it.
  const DoubleDouble& ratio() const noexcept { return ratio_; }
  const Modulo& following() const noexcept { return following_; }
  const Modulo& leading() const noexcept { return leading_; }

 private:
  __extension__ using Units = unsigned __int128;  // fixed point: multiples of 2^-62

  /// A place on the following ring: turns · length + (units + fraction / denominator) · 2^-62, exactly;
  /// units < length, fraction < denominator. Turns wrap.
  struct RingPosition {
    Units units = 0;
    std::uint64_t fraction = 0;
    std::uint64_t turns = 0;
  };

  RingPosition sum(RingPosition a, const RingPosition& b) const noexcept;
  RingPosition negative(const RingPosition& a) const noexcept;
  RingPosition multiple(std::uint64_t times, RingPosition a) const noexcept;
  RingPosition geared(Units distance, bool negative_distance) const noexcept;
  double geared(double quantity) const noexcept { return ratio_.hi * quantity + ratio_.lo * quantity; }

  void turn_to(std::int64_t turn) noexcept;
  void anchor_at(double distance) noexcept;
  void rebase() noexcept;
  DoubleDouble geared(DoubleDouble distance) const noexcept;
  AxisPosition value_in_turn(AxisPosition leading, std::int64_t turn) noexcept;
  AxisPosition value_from_anchor(AxisPosition leading) noexcept;
  AxisPosition after(DoubleDouble distance) noexcept;
  AxisPosition beyond_window(DoubleDouble distance) noexcept;

  DoubleDouble ratio_;
  Halves ratio_halves_;
  double leading_value_ = 0.0;  // L0
  double anchor_ = 0.0;         // [leading u] the double-double part counts from L0 + anchor_
  double near_ = 0.0;           // [leading u] farthest distance from L0 that needs no look at the anchor
  DoubleDouble origin_;         // following position at the anchor, less the turns in wraps_
  double lowest_ = 0.0;         // window of positions that need no reduction
  double end_ = 0.0;
  std::int64_t leading_turns_ = 0;  // of L0
  std::int64_t turn_ = 0;           // leading turns from L0 that origin_ stands for
  std::int64_t turns_ = 0;          // following turns of the window
  // From here on only what a change of the turn needs.
  double reach_ = 0.0;           // [leading u] farthest distance from the anchor
  DoubleDouble base_;            // following position at the anchor on the ring
  std::int64_t wraps_ = 0;       // whole following lengths between base_ and origin_
  RingPosition place_;           // distance geared from L0 to the anchor in turn_
  RingPosition per_turn_;        // distance geared per leading turn
  RingPosition anchor_place_;    // distance geared from L0 to the anchor
  Units length_ = 0;             // of the following ring
  std::uint64_t numerator_ = 1;  // magnitude
  std::uint64_t denominator_ = 1;
  bool mirrored_ = false;  // negative numerator
  AxisPosition following_start_;
  Modulo leading_;
  Modulo following_;
};

}  // namespace lockstep
