#include "tech_objects/drive/encoder_source.hpp"

#include <cmath>

namespace lockstep {

DoubleDouble quantised(DoubleDouble position, double increment) noexcept {
  const DoubleDouble increments = position / increment + 0.5;
  double count = std::floor(increments.hi);
  if (count == increments.hi && increments.lo < 0.0) count -= 1.0;
  return two_product(count, increment);
}

void SimulatedEncoder::configure(const SimulatedEncoderSettings& settings, double servo_period, int ratio,
                                 std::uint64_t seed) noexcept {
  settings_ = settings;
  if (settings_.follows != nullptr) load_.watch(*settings_.follows, servo_period, ratio);
  begun_ = false;
  position_ = {};
  state_ = seed;
}

EncoderReading SimulatedEncoder::read() noexcept {
  if (settings_.follows != nullptr) {
    load_.servo();
    position_ = load_.line() * settings_.ratio;
  } else if (!follow_signal()) {
    return {position_, position_, false, !begun_ && !heard_of()};
  }
  DoubleDouble shown = position_;
  if (settings_.noise > 0.0) shown = shown + settings_.noise * noise();
  if (settings_.resolution > 0.0) shown = quantised(shown, settings_.resolution);
  return {shown, position_, true, false};
}

/// A signal that wraps has gone the shorter way round.
bool SimulatedEncoder::follow_signal() noexcept {
  if (settings_.signal.address == nullptr || !heard_of()) return false;
  const double now = as_double(settings_.signal.load(), settings_.signal.type);
  if (!(std::abs(now) <= kPositionRange)) return false;
  if (!begun_) {
    position_ = to_double_double(now);
  } else if (settings_.wrap > 0.0) {
    position_ = position_ + shortest_distance(last_signal_, now, {true, settings_.wrap, 0.0});
  } else {
    position_ = position_ + two_difference(now, last_signal_);
  }
  begun_ = true;
  last_signal_ = now;
  return true;
}

/// In [-1, 1): SplitMix64, whose sequence is the same everywhere.
double SimulatedEncoder::noise() noexcept {
  state_ += 0x9E3779B97F4A7C15u;
  std::uint64_t bits = state_;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
  bits ^= bits >> 31;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
}

}  // namespace lockstep
