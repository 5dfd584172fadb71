#include "tech_objects/objects/leading_object.hpp"

#include "tech_objects/jobs/override.hpp"

namespace lockstep {
namespace {

/// Age of an actual value when the interpolator takes it [s]: the drive is read at the beginning of the very
/// tick.
constexpr double kAcquisitionTime = 0.0;

/// The variables Extrapolation of the data block, as the kernel takes them.
ExtrapolationSettings settings_of(const TO_Struct_Extrapolation& from) noexcept {
  return {.makes_up_for_leading_axis = from.Settings.SystemDefinedExtrapolation != 0,
          .velocity_of_positions = from.Settings.ExtrapolatedVelocityMode == 1,
          .further_time = from.FollowingAxisDependentTime,
          .position_lags = {from.PositionFilter.T1, from.PositionFilter.T2},
          .velocity_lags = {from.VelocityFilter.T1, from.VelocityFilter.T2},
          .velocity_tolerance = from.VelocityTolerance.Range,
          .hysteresis = from.Hysteresis.Value};
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
}

/// The actual value of this tick as following axes see it. Its acceleration is not extrapolated: a difference
/// of differences of what an encoder reports would be noise.
void LeadingObject::extrapolate(AxisPosition actual, double velocity,
                                const TO_Struct_Extrapolation& settings) noexcept {
  const ExtrapolatedValues& values = extrapolation_.step(actual, velocity, settings_of(settings));
  last_leading_actual_ = leading_actual_;
  leading_actual_ = {values.position, values.velocity, 0.0};
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
