#include "tech_objects/objects/leading_object.hpp"

#include <algorithm>

#include "tech_objects/jobs/override.hpp"
#include "tech_objects/leading_values/seconds.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Age of an actual value when the interpolator takes it [s]: the drive is read at the beginning of the very
/// tick.
constexpr double kAcquisitionTime = 0.0;

/// The variables Extrapolation of the data block, as the kernel takes them.
ExtrapolationSettings settings_of(const TO_Struct_Extrapolation& from, double time_ahead = 0.0) noexcept {
  return {.makes_up_for_leading_axis = from.Settings.SystemDefinedExtrapolation != 0,
          .velocity_of_positions =
              from.Settings.ExtrapolatedVelocityMode == ExtrapolatedVelocityMode::by_differentiation,
          .further_time = from.FollowingAxisDependentTime,
          .position_lags = {from.PositionFilter.T1, from.PositionFilter.T2},
          .velocity_lags = {from.VelocityFilter.T1, from.VelocityFilter.T2},
          .velocity_tolerance = from.VelocityTolerance.Range,
          .hysteresis = from.Hysteresis.Value,
          .time_ahead = time_ahead};
}

}  // namespace

void LeadingObject::configure_leading(double period, TO_Struct_Extrapolation& settings) noexcept {
  extrapolation_.configure(modulo_, period, kAcquisitionTime);
  settings.LeadingAxisDependentTime = extrapolation_.leading_axis_time(settings_of(settings));
}

void LeadingObject::reset_leading(AxisPosition actual) noexcept {
  handing_over_ = false;
  uncontrolled_.returning = false;
  extrapolation_.reset(actual);
  leading_actual_ = last_leading_actual_ = {actual, 0.0, 0.0};
  delayed_ = last_delayed_ = leading_actual_;
}

/// The actual value of this tick as following axes see it. Its acceleration is not extrapolated: a difference
/// of differences of what an encoder reports would be noise.
void LeadingObject::extrapolate(AxisPosition actual, double velocity,
                                const TO_Struct_Extrapolation& settings) noexcept {
  const ExtrapolatedValues& values =
      extrapolation_.step(actual, velocity, settings_of(settings, provided_delay()));
  last_leading_actual_ = leading_actual_;
  leading_actual_ = {values.position, values.velocity, 0.0};
}

Setpoint LeadingObject::ahead_of_delay() const noexcept {
  const ExtrapolatedValues& values = extrapolation_.values();
  return {values.ahead, values.velocity_ahead, 0.0};
}

void LeadingObject::shift_leading(double by) noexcept {
  renamed_ = renamed_ + by;
  extrapolation_.shift(by);
  led_.position = advanced(led_.position, by, modulo_);
  last_led_.position = advanced(last_led_.position, by, modulo_);
  uncontrolled_.now.position = advanced(uncontrolled_.now.position, by, modulo_);
  uncontrolled_.last.position = advanced(uncontrolled_.last.position, by, modulo_);
  leading_actual_.position = advanced(leading_actual_.position, by, modulo_);
  last_leading_actual_.position = advanced(last_leading_actual_.position, by, modulo_);
  if (!provides_) return;
  provided_->rename(by);
  delayed_.position = advanced(delayed_.position, by, modulo_);
  last_delayed_.position = advanced(last_delayed_.position, by, modulo_);
}

void LeadingObject::provide_leading_value() {
  provides_ = leads_specially_ = true;
  if (provided_ == nullptr) provided_ = std::make_unique<ProvidedValue>();
}

void LeadingObject::provide_if_asked(const TO_Struct_CrossPlcSynchronousOperation& settings) {
  const auto enabled = [](const auto& one) { return one.EnableLeadingValueOutput; };
  const auto& all = settings.Interface;
  if (std::any_of(std::begin(all), std::end(all), enabled)) provide_leading_value();
}

void LeadingObject::configure_provided(double period,
                                       const TO_Struct_CrossPlcSynchronousOperation& settings) noexcept {
  if (!provides_) return;
  provided_->clear();
  provided_->configure(modulo_, nanoseconds(period), settings.LocalLeadingValueDelayTime);
}

void LeadingObject::provide(const Setpoint& value, bool position_led,
                            TO_Struct_StatusProvidedLeadingValue& status) noexcept {
  provided_->step(tick_time, value, actual_values_valid(), position_led);
  last_delayed_ = delayed_;
  delayed_ = provided_->delayed();
  status.DelayedLeadingValue = {delayed_.position.value, delayed_.velocity, delayed_.acceleration};
}

LeadingValueTelegram LeadingObject::telegram() const noexcept {
  LeadingValueTelegram telegram = provided_->telegram();
  telegram.renamed = renamed_;
  telegram.restarts = restarts_;
  return telegram;
}

void LeadingObject::count_homing(const Job& job) noexcept {
  const auto effect = override_effect(class_of(job, true), JobClass::measuring, position_controlled_);
  if (effect == OverrideEffect::abort) ++homings_;
}

void LeadingObject::publish_extrapolation(TO_Struct_Extrapolation& settings,
                                          TO_Struct_StatusExtrapolation& status) const noexcept {
  const ExtrapolatedValues& values = extrapolation_.values();
  settings.LeadingAxisDependentTime = extrapolation_.leading_axis_time(settings_of(settings));
  status.FilteredPosition = values.filtered_position.value;
  status.FilteredVelocity = values.filtered_velocity;
  status.ExtrapolatedPosition = values.position.value;
  status.ExtrapolatedVelocity = values.velocity;
}

}  // namespace lockstep
