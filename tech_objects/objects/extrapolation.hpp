/// The actual value of a leading axis as a leading value: filtered, and led on by the time that passes until
/// the following axis acts on it.
///
///   actual velocity → PT2 filter → tolerance band → velocity
///   actual position → PT2 filter → + velocity · extrapolation time → hysteresis → position
///
/// @source S7-1500T synchronous operation V7, 5.2.3, 5.2.4, 13.1 (Extrapolation, StatusExtrapolation)
#pragma once

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// A first-order lag in the ticks of one period, exact for an input that runs straight from tick to tick: so
/// behind a ramp it is late by its time constant, not by about that. It keeps by how much its output is
/// behind its input, never the values themselves: nothing is lost where they are large. Thread: the cycle.
class FirstOrderLag {
 public:
  /// @param time_constant [s] ≥ 0; 0: none  @param period [s] > 0
  void tune(double time_constant, double period) noexcept;
  double time_constant() const noexcept { return time_constant_; }

  /// One tick in which the input has changed by `change`. Returns by how much the output has changed.
  double step(double change) noexcept {
    const double before = behind_;
    behind_ += gain_ * change - decay_ * before;
    if (change == 0.0 && behind_ < kNothing && behind_ > -kNothing) behind_ = 0.0;
    return change - (behind_ - before);
  }

  /// By how much the output is behind the input.
  double behind() const noexcept { return behind_; }
  void set_behind(double behind) noexcept { behind_ = behind; }

 private:
  /// What is left of an input that stands and is less than this is nothing: a lag that only ever halves what
  /// is left would never come to rest.
  static constexpr double kNothing = 1e-18;

  double behind_ = 0.0;
  double decay_ = 1.0;  // 1 - exp(-period / time constant)
  double gain_ = 0.0;   // time constant / period · decay
  double time_constant_ = 0.0;
};

/// PT2 filter: two first-order lags in series. Behind a ramp it is late by T1 + T2 exactly.
class Pt2Filter {
 public:
  FirstOrderLag first;
  FirstOrderLag second;

  void step(double change) noexcept { second.step(first.step(change)); }
  double behind() const noexcept { return first.behind() + second.behind(); }
};

/// What StatusExtrapolation shows, positions with their turns.
struct ExtrapolatedValues {
  AxisPosition filtered_position;  ///< behind the position filter
  double filtered_velocity = 0.0;  ///< [u/s] behind velocity filter and tolerance band
  AxisPosition position;           ///< extrapolated, behind the hysteresis: the leading value
  double velocity = 0.0;           ///< [u/s] of the leading value
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

  /// One interpolator cycle. All of `settings` counts at once; what is negative or no number counts as 0.
  /// Changed time constants do not make the extrapolated position step; the position filter may even be
  /// switched off. (A velocity filter that is switched off, and a position filter whose lag is not made up
  /// for because SystemDefinedExtrapolation = 0, give up what they were behind.) A change of
  /// FollowingAxisDependentTime makes it step by velocity · change.
  /// @param velocity [u/s] actual
  const ExtrapolatedValues& step(AxisPosition actual, double velocity,
                                 const TO_Struct_Extrapolation& settings) noexcept;

  /// The positions have been shifted by homing [u]; the filters do not notice.
  void shift(double by) noexcept;

  const ExtrapolatedValues& values() const noexcept { return values_; }

  /// [s] Leading-axis part of the extrapolation time: acquisition + interpolator cycle + T1 + T2 of the
  /// position filter. Shown also where Settings.SystemDefinedExtrapolation = 0 takes it out of effect.
  double leading_axis_time(const TO_Struct_Extrapolation& settings) const noexcept;

 private:
  void tune(const TO_Struct_Extrapolation& settings) noexcept;
  void tune_position(FirstOrderLag& lag, double time_constant, bool compensated) noexcept;
  void pass_tolerance_band(double velocity, double range) noexcept;
  void pass_hysteresis(AxisPosition position, double hysteresis) noexcept;

  Modulo modulo_;
  double period_ = 0.001;      // [s]
  double acquisition_ = 0.0;   // [s]
  AxisPosition actual_;        // of the last tick
  double velocity_ = 0.0;      // of the last tick [u/s]
  Pt2Filter position_filter_;  // [u]
  Pt2Filter velocity_filter_;  // [u/s]
  ExtrapolatedValues values_;
  int direction_ = 0;  // in which the leading value moves without being held back: 1, -1; 0: not known yet
  double held_ = 0.0;  // by how much the hysteresis holds the leading value back [u] ≥ 0
};

}  // namespace lockstep
