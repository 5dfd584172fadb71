/// A cam applied to a pair of axes: the following position as a function of the leading position, with
/// scaling, passes without drift, and both ends.
/// @source S7-1500T synchronous operation V7, 8.4, 8.5
#pragma once

#include <cstdint>
#include <limits>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/cam/function.hpp"

namespace lockstep {

/// How a cam is passed (pin ApplicationMode).
enum class CamMode : std::uint8_t {
  once = 0,     ///< from end to end
  cyclic = 1,   ///< again and again, over the same following values
  appended = 2  ///< again and again, each pass begins where the one before has ended
};

/// Scaling and mode of one use of a cam.
struct CamUse {
  double master_scaling = 1.0;  ///< of the cam's leading values, not 0; negative: the cam runs the other way
  double slave_scaling = 1.0;   ///< of its following values; 0: they are all 0
  CamMode mode = CamMode::once;
};

/// Following position at a leading position, and its derivatives with respect to the leading position.
struct CamFollowingValue {
  AxisPosition position;
  double slope = 0.0;      ///< [u / leading u]
  double curvature = 0.0;  ///< [u / leading u²]
};

/// An end of a pass.
enum class CamEnd : std::uint8_t { none, at_end, at_start };

/// F(L) = f(S + rest / MasterScaling) · SlaveScaling + pass · H, where rest is the distance of the leading
/// axis from the start of the cam, reduced to one pass of MasterScaling · (E - S) without rounding that adds
/// up: the number of passes is an integer, and each place is computed from it anew, in double-double. H is
/// what a pass adds on the following side: 0 unless passes are appended. (A cyclic cam on a modulo following
/// axis whose ends lie whole turns apart goes on turning.)
///
/// Below 2^53 turns of the leading axis and 2^62 passes. Thread: the cycle.
class CamFollowing {
 public:
  /// Applies a curve, which stays as it is meanwhile. The leading position `place` is where the distance from
  /// the start of the cam is `from_start` [leading u]. Following positions have `turns` turns more than the
  /// cam itself says.
  void set(const CamFunction& function, const CamUse& use, AxisPosition place, DoubleDouble from_start,
           const Modulo& leading, const Modulo& following) noexcept;

  /// Applies a curve, with the start of the cam at a leading position that need not be on the ring.
  void set_start(const CamFunction& function, const CamUse& use, std::int64_t start_turns,
                 DoubleDouble start_value, const Modulo& leading, const Modulo& following) noexcept;

  /// Whether the following values of both ends agree as CamMode::cyclic needs it: within 1.0E-9 of the
  /// stroke, for a modulo following axis but for whole turns.
  static bool closes(const CamFunction& function, double slave_scaling, const Modulo& following) noexcept;

  /// Moves the function by whole turns of the following axis.
  void add_turns(std::int64_t turns) noexcept;
  /// Counts the turns of the leading axis anew, by so many more.
  void add_leading_turns(std::int64_t turns) noexcept;

  /// Place at a leading position (normalised, finite). Outside a cam that is passed once: that at the nearer
  /// end. The number of passes and `ended` count from here on.
  CamFollowingValue value(AxisPosition leading) noexcept {
    const std::int64_t turn = wrapped(leading.turns, start_turns_);
    DoubleDouble rest = rest_in(base_, from_start(leading.value));
    if (turn != turn_ || !(rest.hi > 0.0 && rest.hi < pass_.hi)) rest = enter_pass(leading, turn);
    last_rest_ = rest.hi;
    return place_of(function_->value(first_ + rest.hi * per_scaling_, hint_));
  }

  /// The following value seen from the side from which a leading axis comes that moves in `direction` (1, -1)
  /// beyond the place: derivatives at a corner are those ahead. Does not count.
  CamFollowingValue joined_at(AxisPosition leading, int direction) const noexcept;

  /// Which end a leading axis at that position would have reached since the last value.
  CamEnd end_before(AxisPosition leading) const noexcept;
  /// After `value`: the end that it has reached.
  CamEnd ended() const noexcept { return ended_; }
  void clear_end() noexcept { ended_ = CamEnd::none; }

  /// Leading position of an end of the present pass, in turns and a value that need not be on the ring.
  struct LeadingPosition {
    std::int64_t turns = 0;
    DoubleDouble value;
  };
  LeadingPosition end_place(CamEnd end) const noexcept;
  /// Following position there.
  AxisPosition end_position(CamEnd end) const noexcept;
  /// Whether the cam has no slope there, but for rounding.
  bool rests_at(CamEnd end) const noexcept;

  /// Distance from the start of the cam at a leading position, of all passes [leading u].
  double distance(AxisPosition leading) const noexcept;
  /// One pass [leading u] > 0.
  double pass_length() const noexcept { return pass_.hi; }

  const CamFunction* function() const noexcept { return function_; }

 private:
  /// Slope times one pass, as a share of the stroke.
  double steepness(const CamValue& value) const noexcept;

  static std::int64_t wrapped(std::int64_t a, std::int64_t b) noexcept {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
  }
  /// Distance in the cam's direction from the start of a pass.
  DoubleDouble rest_in(DoubleDouble base, DoubleDouble distance_from_start) const noexcept {
    const DoubleDouble sum = two_sum(distance_from_start.hi, base.hi);
    const DoubleDouble rest = quick_two_sum(sum.hi, sum.lo + (distance_from_start.lo + base.lo));
    return backward_ ? -rest : rest;
  }
  DoubleDouble from_start(double leading_value) const noexcept {
    DoubleDouble distance = two_difference(leading_value, start_.hi);
    distance.lo -= start_.lo;
    return distance;
  }
  struct Pass {
    std::int64_t number = 0;
    DoubleDouble base;
    DoubleDouble rest;
  };
  Pass pass_at(AxisPosition leading) const noexcept;
  DoubleDouble base_of(std::int64_t turn, std::int64_t pass) const noexcept;
  DoubleDouble enter_pass(AxisPosition leading, std::int64_t turn) noexcept;
  CamEnd end_between(double rest, std::int64_t pass) const noexcept;
  struct Lift {
    std::int64_t turns = 0;
    DoubleDouble value;
  };
  Lift lift_of(std::int64_t pass) const noexcept;
  AxisPosition raised(double following_value, const Lift& lift) const noexcept;
  CamFollowingValue place_of(const CamValue& value) const noexcept {
    const DoubleDouble position = two_product(value.position, use_.slave_scaling) + lift_.value;
    const bool inside = position.hi >= lowest_ && position.hi < highest_;
    return {inside ? AxisPosition{lift_.turns, position.hi} : normalised(lift_.turns, position, following_),
            value.first_derivative * slope_, value.second_derivative * curvature_};
  }

  const CamFunction* function_ = nullptr;
  DoubleDouble start_;  // leading position of the start of the cam, less its turns
  std::int64_t start_turns_ = 0;
  std::int64_t turn_ = 0;     // leading turns from there for which base_ counts
  DoubleDouble base_;         // distance from the start of the pass to the start of the cam in that turn
  DoubleDouble pass_;         // one pass [leading u] > 0
  double scaling_ = 1.0;      // magnitude of MasterScaling
  double per_scaling_ = 1.0;  // 1 / scaling_
  double first_ = 0.0;        // leading value at which the curve begins
  double last_rest_ = 0.0;    // to tell arrival at an end from departure
  CamHint hint_;
  bool backward_ = false;  // negative MasterScaling
  CamEnd ended_ = CamEnd::none;
  CamUse use_;
  Lift lift_;            // what the passes have added
  double lowest_ = 0.0;  // window of positions that need no reduction
  double highest_ = 0.0;
  double slope_ = 1.0;      // SlaveScaling / MasterScaling
  double curvature_ = 1.0;  // SlaveScaling / MasterScaling²
  // From here on only what a change of the pass needs.
  std::int64_t pass_number_ = 0;
  std::int64_t added_turns_ = 0;
  DoubleDouble per_pass_;  // H
  Modulo leading_;
  Modulo following_;
};

}  // namespace lockstep
