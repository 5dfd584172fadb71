/// The actual value of a leading axis as a leading value: filtered, and led on by the time that passes until
/// the following axis acts on it.
///
///   actual velocity → PT2 filter → tolerance band → velocity
///   actual position → PT2 filter → + velocity · extrapolation time → hysteresis → position
///   actual position → PT2 filter → + velocity · (extrapolation time + time ahead) → hysteresis → ahead
///
/// @source S7-1500T synchronous operation V7, 5.2.3, 5.2.4, 13.1 (Extrapolation, StatusExtrapolation)
#pragma once

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/filters/first_order_lag.hpp"

namespace lockstep {

/// What counts in one interpolator cycle. What is negative or no number counts as 0.
struct ExtrapolationSettings {
  bool makes_up_for_leading_axis = true;  ///< the leading-axis part of the extrapolation time counts
  bool velocity_of_positions = false;     ///< the velocity is the difference of extrapolated positions
  double further_time = 0.0;              ///< [s] that is extrapolated besides
  double position_lags[2]{};              ///< [s] time constants of the PT2 filter of the position
  double velocity_lags[2]{};              ///< [s] … of the velocity
  double velocity_tolerance = 0.0;        ///< [u/s] width of the tolerance band
  double hysteresis = 0.0;                ///< [u]
  double time_ahead = 0.0;                ///< [s] by which `ahead` is extrapolated further
};

/// The values on the way to the leading value, positions with their turns.
struct ExtrapolatedValues {
  AxisPosition filtered_position;  ///< behind the position filter
  double filtered_velocity = 0.0;  ///< [u/s] behind velocity filter and tolerance band
  AxisPosition position;           ///< extrapolated, behind the hysteresis: the leading value
  double velocity = 0.0;           ///< [u/s] of the leading value
  AxisPosition ahead;              ///< the same further on, for whoever sees it behind a delay
  double velocity_ahead = 0.0;     ///< [u/s] of that
};

/// Extrapolation of one leading axis, run once per interpolator cycle. Thread: the cycle.
///
/// At constant velocity the extrapolated position is the actual position after the extrapolation time, with
/// no error but rounding, if Range and Hysteresis are 0. With them it stays within
/// Range / 2 · extrapolation time + Hysteresis of that.
class Extrapolation {
 public:
  /// @param period of the interpolator [s] > 0  @param acquisition [s] ≥ 0, age of an actual value when it is
  /// handed to `step`
  void configure(const Modulo& modulo, double period, double acquisition) noexcept;

  /// Begins anew with an axis that stands.
  void reset(AxisPosition actual) noexcept;

  /// One interpolator cycle. All of `settings` counts at once.
  /// Changed time constants do not make the extrapolated position step; the position filter may even be
  /// switched off. (A velocity filter that is switched off, and a position filter whose lag is not made up
  /// for, give up what they were behind.) A change of
  /// `further_time` makes it step by velocity · change.
  /// @param velocity [u/s] actual
  const ExtrapolatedValues& step(AxisPosition actual, double velocity,
                                 const ExtrapolationSettings& settings) noexcept;

  /// The positions have been shifted by homing [u]; the filters do not notice.
  void shift(double by) noexcept;

  const ExtrapolatedValues& values() const noexcept { return values_; }

  /// [s] Leading-axis part of the extrapolation time: acquisition + interpolator cycle + T1 + T2 of the
  /// position filter, also where it is not made up for.
  double leading_axis_time(const ExtrapolationSettings& settings) const noexcept;

 private:
  void tune(const ExtrapolationSettings& settings) noexcept;
  void tune_position(FirstOrderLag& lag, double time_constant, bool compensated) noexcept;
  /// A position that is held back while it comes back by no more than the hysteresis.
  struct Play {
    int direction = 0;  // in which it moves without being held back: 1, -1; 0: not known yet
    double held = 0.0;  // by how much it is held back [u] ≥ 0
  };
  void pass_tolerance_band(double velocity, double range) noexcept;
  void pass_hysteresis(AxisPosition position, double hysteresis, Play& play,
                       AxisPosition& output) const noexcept;

  Modulo modulo_;
  double period_ = 0.001;      // [s]
  double acquisition_ = 0.0;   // [s]
  AxisPosition actual_;        // of the last tick
  double velocity_ = 0.0;      // of the last tick [u/s]
  Pt2Filter position_filter_;  // [u]
  Pt2Filter velocity_filter_;  // [u/s]
  ExtrapolatedValues values_;
  Play play_;        // of `position`
  Play play_ahead_;  // of `ahead`
};

}  // namespace lockstep
