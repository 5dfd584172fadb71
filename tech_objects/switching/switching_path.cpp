#include "tech_objects/switching/switching_path.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kSecond = 1e-9;  // per nanosecond

double between(double from, double to, double part) noexcept {
  if (part <= 0.0) return from;
  return part >= 1.0 ? to : from + (to - from) * part;
}

}  // namespace

Stretch Stretch::part(double begin, double end) const noexcept {
  return {between(from_time, to_time, begin),
          between(from_time, to_time, end),
          between(from, to, begin),
          between(from, to, end),
          between(from_velocity, to_velocity, begin),
          between(from_velocity, to_velocity, end)};
}

Stretch Stretch::shifted(double by) const noexcept {
  Stretch stretch = *this;
  stretch.from += by;
  stretch.to += by;
  return stretch;
}

void SwitchingPath::watch(const LeadingObject& object, bool actual, double servo_period, int ratio) noexcept {
  object_ = &object;
  ratio_ = static_cast<std::size_t>(ratio);
  load_.watch(object, servo_period, ratio, !actual);
  begun_ = false;
  direction_ = 0;
  back_ = 0.0;
  count_ = 0;
}

void SwitchingPath::servo(std::int64_t now, double hysteresis) noexcept {
  load_.servo();
  const double before = stretch_.to;
  const double position = load_.position().value;
  stretch_ = {stretch_.to_time, static_cast<double>(now) * kSecond, position, position, stretch_.to_velocity,
              velocity(now)};
  renamed_ = jumped_ = 0.0;
  free_from_ = 0.0;
  stretched_ = begun_;
  begun_ = true;
  if (!stretched_) {
    direction_ = 0;
    back_ = 0.0;
    stretch_.from_time = stretch_.to_time;
    stretch_.from_velocity = stretch_.to_velocity;
    return;
  }
  const double distance = load_.distance().rounded();
  connect(before, distance);
  const Modulo ring = modulo();
  turn(distance, ring.enabled ? std::min(hysteresis, 0.25 * ring.length) : hysteresis);
}

/// Of a setpoint its own; of an actual position the mean over an interpolator cycle, as encoders show it.
double SwitchingPath::velocity(std::int64_t now) noexcept {
  if (!load_.measured()) return load_.setpoint_velocity();
  const std::size_t older = std::min(count_, ratio_);
  double mean = 0.0;
  if (older > 0) {
    const Sample& sample = samples_[(count_ - older) % kSamples];
    mean = (load_.line() - sample.line).rounded() / (static_cast<double>(now - sample.time) * kSecond);
  }
  samples_[count_ % kSamples] = {now, load_.line()};
  ++count_;
  return mean;
}

/// Where the path began, in the names of its end. It is the very end of the one before, unless homing has
/// renamed that, so that no place lies between two stretches or in both.
void SwitchingPath::connect(double before, double distance) noexcept {
  const Modulo ring = modulo();
  double begin = before;
  if (ring.enabled) begin -= ring.length * std::nearbyint((before + distance - stretch_.to) / ring.length);
  const double rest = stretch_.to - (begin + distance);
  const double rounding = 1e-9 * std::max({1.0, std::abs(stretch_.to), std::abs(before)});
  if (std::abs(rest) > rounding) {
    begin = stretch_.to - distance;
    jumped_ = rest;
  }
  stretch_.from = begin;
  renamed_ = begin - before;
}

/// The direction, and from where on positions count.
void SwitchingPath::turn(double distance, double hysteresis) noexcept {
  if (direction_ == 0) {
    back_ += distance;
    if (std::abs(back_) > hysteresis) {
      direction_ = back_ > 0.0 ? 1 : -1;
      back_ = 0.0;
    }
    return;
  }
  const double along = direction_ * distance;
  const double was_back = back_;
  back_ = was_back - along;
  if (back_ > hysteresis) {
    direction_ = -direction_;
    free_from_ = std::max(0.0, (hysteresis - was_back) / -along);
    back_ = 0.0;
  } else if (back_ > 0.0) {
    free_from_ = 2.0;
  } else {
    if (was_back > 0.0) free_from_ = std::min(1.0, was_back / along);
    back_ = 0.0;
  }
}

}  // namespace lockstep
