#include "tech_objects/drive/setpoint_filter.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Longest time constant [s]; the order of the arguments makes 0 of what is no number.
constexpr double kLongestTime = 1e12;

double time_of(double value) noexcept {
  return std::min(std::max(0.0, value), kLongestTime);
}

}  // namespace

void DynamicFilter::configure(const Modulo& modulo, double servo_cycle) noexcept {
  modulo_ = modulo;
  servo_cycle_ = servo_cycle;
}

double DynamicFilter::dead_cycles(const TO_Struct_DynamicFilter& settings) const noexcept {
  return std::min(time_of(settings.Tt) / servo_cycle_, static_cast<double>(kMaximumDeadCycles));
}

double DynamicFilter::delay(const TO_Struct_DynamicFilter& settings) const noexcept {
  if (settings.Mode != DynamicFilterMode::filter_and_dead_time) return 0.0;
  return time_of(settings.T1) + time_of(settings.T2) + dead_cycles(settings) * servo_cycle_;
}

void DynamicFilter::tune(const TO_Struct_DynamicFilter& settings) noexcept {
  const double t1 = time_of(settings.T1);
  const double t2 = time_of(settings.T2);
  for (Pt2Filter* filter : {&position_, &velocity_}) {
    if (t1 != filter->first.time_constant()) filter->first.tune(t1, servo_cycle_);
    if (t2 != filter->second.time_constant()) filter->second.tune(t2, servo_cycle_);
  }
}

void DynamicFilter::reset(const ServoSetpoint& setpoint, const TO_Struct_DynamicFilter& settings) noexcept {
  tune(settings);
  last_ = setpoint;
  position_.first.set_behind(setpoint.velocity * time_of(settings.T1));
  position_.second.set_behind(setpoint.velocity * time_of(settings.T2));
  velocity_.first.set_behind(0.0);
  velocity_.second.set_behind(0.0);
  for (std::size_t age = 0; age < kKept; ++age) {
    const double distance = position_.behind() + setpoint.velocity * servo_cycle_ * static_cast<double>(age);
    filtered_[(cycle_ + kKept - 1 - age) % kKept] = {advanced(setpoint.position, -distance, modulo_),
                                                     setpoint.velocity};
  }
}

void DynamicFilter::shift(double by) noexcept {
  last_.position = advanced(last_.position, by, modulo_);
  for (ServoSetpoint& setpoint : filtered_) setpoint.position = advanced(setpoint.position, by, modulo_);
}

ServoSetpoint DynamicFilter::step(const ServoSetpoint& setpoint,
                                  const TO_Struct_DynamicFilter& settings) noexcept {
  tune(settings);
  position_.step(rounded_difference(setpoint.position, last_.position, modulo_));
  velocity_.step(setpoint.velocity - last_.velocity);
  last_ = setpoint;
  filtered_[cycle_ % kKept] = {advanced(setpoint.position, -position_.behind(), modulo_),
                               setpoint.velocity - velocity_.behind()};
  const double dead = dead_cycles(settings);
  const auto whole = static_cast<std::size_t>(dead);
  const double part = dead - static_cast<double>(whole);
  ServoSetpoint result = filtered_[(cycle_ + kKept - whole) % kKept];
  if (part > 0.0) {
    const ServoSetpoint& older = filtered_[(cycle_ + kKept - whole - 1) % kKept];
    result.position =
        advanced(result.position, difference(older.position, result.position, modulo_) * part, modulo_);
    result.velocity += (older.velocity - result.velocity) * part;
  }
  cycle_ = cycle_ + 1 == kKept ? 0 : cycle_ + 1;
  return result;
}

}  // namespace lockstep
