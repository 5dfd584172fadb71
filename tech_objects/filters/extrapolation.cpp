#include "tech_objects/filters/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// Longest time of the settings [s].
constexpr double kLongestTime = 1e12;

/// A setting as it counts. The order of the arguments makes 0 of what is no number.
double not_negative(double value) noexcept {
  return std::max(0.0, value);
}
double time_of(double value) noexcept {
  return std::min(not_negative(value), kLongestTime);
}

}  // namespace

void Extrapolation::configure(const Modulo& modulo, double period, double acquisition) noexcept {
  modulo_ = modulo;
  period_ = period;
  acquisition_ = acquisition;
  for (Pt2Filter* filter : {&position_filter_, &velocity_filter_}) {
    filter->first.tune(filter->first.time_constant(), period_);
    filter->second.tune(filter->second.time_constant(), period_);
  }
}

void Extrapolation::reset(AxisPosition actual) noexcept {
  actual_ = actual;
  velocity_ = 0.0;
  for (Pt2Filter* filter : {&position_filter_, &velocity_filter_}) {
    filter->first.set_behind(0.0);
    filter->second.set_behind(0.0);
  }
  values_ = {actual, 0.0, actual, 0.0, actual, 0.0};
  play_ = play_ahead_ = {};
}

void Extrapolation::shift(double by) noexcept {
  actual_ = advanced(actual_, by, modulo_);
  values_.filtered_position = advanced(values_.filtered_position, by, modulo_);
  values_.position = advanced(values_.position, by, modulo_);
  values_.ahead = advanced(values_.ahead, by, modulo_);
}

double Extrapolation::leading_axis_time(const ExtrapolationSettings& settings) const noexcept {
  return acquisition_ + period_ + time_of(settings.position_lags[0]) + time_of(settings.position_lags[1]);
}

const ExtrapolatedValues& Extrapolation::step(AxisPosition actual, double velocity,
                                              const ExtrapolationSettings& settings) noexcept {
  tune(settings);
  position_filter_.step(rounded_difference(actual, actual_, modulo_));
  velocity_filter_.step(velocity - velocity_);
  actual_ = actual;
  velocity_ = velocity;

  pass_tolerance_band(velocity - velocity_filter_.behind(), not_negative(settings.velocity_tolerance));
  const double leading_part = settings.makes_up_for_leading_axis ? leading_axis_time(settings) : 0.0;
  const double time = leading_part + time_of(settings.further_time);
  const double behind = position_filter_.behind();
  values_.filtered_position = advanced(actual, -behind, modulo_);
  const double hysteresis = not_negative(settings.hysteresis);
  const AxisPosition last = values_.position;
  pass_hysteresis(advanced(actual, values_.filtered_velocity * time - behind, modulo_), hysteresis, play_,
                  values_.position);
  values_.velocity = settings.velocity_of_positions
                         ? rounded_difference(values_.position, last, modulo_) / period_
                         : values_.filtered_velocity;
  const double further = time_of(settings.time_ahead);
  if (further == 0.0) {
    values_.ahead = values_.position;
    values_.velocity_ahead = values_.velocity;
    play_ahead_ = play_;
    return values_;
  }
  const AxisPosition last_ahead = values_.ahead;
  pass_hysteresis(advanced(actual, values_.filtered_velocity * (time + further) - behind, modulo_),
                  hysteresis, play_ahead_, values_.ahead);
  values_.velocity_ahead = settings.velocity_of_positions
                               ? rounded_difference(values_.ahead, last_ahead, modulo_) / period_
                               : values_.filtered_velocity;
  return values_;
}

/// Takes changed time constants over; without a change four comparisons.
void Extrapolation::tune(const ExtrapolationSettings& settings) noexcept {
  const bool compensated = settings.makes_up_for_leading_axis;
  tune_position(position_filter_.first, time_of(settings.position_lags[0]), compensated);
  tune_position(position_filter_.second, time_of(settings.position_lags[1]), compensated);
  const double t1 = time_of(settings.velocity_lags[0]);
  const double t2 = time_of(settings.velocity_lags[1]);
  if (t1 != velocity_filter_.first.time_constant()) velocity_filter_.first.tune(t1, period_);
  if (t2 != velocity_filter_.second.time_constant()) velocity_filter_.second.tune(t2, period_);
}

/// The extrapolation time changes together with the lag that it makes up for: the lag goes at once to where
/// it will be at the velocity at hand, so that the sum of both, which the following axes see, does not step.
/// Where the lag is not made up for, its output goes on from where it is.
void Extrapolation::tune_position(FirstOrderLag& lag, double time_constant, bool compensated) noexcept {
  const double change = time_constant - lag.time_constant();
  if (change == 0.0) return;
  lag.tune(time_constant, period_);
  if (compensated) lag.set_behind(lag.behind() + change * values_.filtered_velocity);
}

/// The output moves once the velocity is further from it than half the band, and then stays half a band
/// behind.
void Extrapolation::pass_tolerance_band(double velocity, double range) noexcept {
  const double change = velocity - values_.filtered_velocity;
  if (std::abs(change) <= 0.5 * range) return;
  values_.filtered_velocity = velocity - std::copysign(0.5 * range, change);
}

/// A play: in the direction in which the leading value moves it is the extrapolated position; in the other it
/// stands until that has come back by the hysteresis, and then follows at this distance. So it never steps. A
/// hysteresis that becomes smaller counts when the distance has been used up.
void Extrapolation::pass_hysteresis(AxisPosition position, double hysteresis, Play& play,
                                    AxisPosition& output) const noexcept {
  const double distance = rounded_difference(position, output, modulo_);
  const double width = std::max(hysteresis, play.held);
  if (play.direction == 0 || width == 0.0)
    play.direction = distance > 0.0 ? 1 : distance < 0.0 ? -1 : play.direction;
  const double back = -play.direction * distance;
  if (back <= 0.0) {
    output = position;
    play.held = 0.0;
  } else if (back > width) {
    output = advanced(position, play.direction * width, modulo_);
    play.held = width;
  } else {
    play.held = back;
  }
}

}  // namespace lockstep
