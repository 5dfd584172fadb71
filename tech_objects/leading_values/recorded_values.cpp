#include "tech_objects/leading_values/recorded_values.hpp"

#include <algorithm>
#include <utility>

#include "tech_objects/leading_values/seconds.hpp"

namespace lockstep {
namespace {

/// For so many cycles of the source its acceleration goes on behind the newest value.
constexpr int kAccelerated = 4;

/// Values beside those of the longest delay, for what is under way and for lost ones.
constexpr int kBeside = 96;

}  // namespace

void RecordedValues::reserve() {
  entries_.resize(std::size_t{kLongestLeadingDelay} + std::size_t{kBeside});
}

void RecordedValues::set_source(const Modulo& modulo, std::int64_t cycle) noexcept {
  modulo_ = modulo;
  cycle_ = cycle;
}

bool RecordedValues::add(std::int64_t time, const Setpoint& value) noexcept {
  if (entries_.empty()) return false;
  if (count_ == entries_.size()) {
    if (time <= entry(0).time) return false;
    first_ = (first_ + 1) % entries_.size();
    --count_;
  }
  std::size_t index = count_;
  while (index > 0 && entry(index - 1).time > time) --index;
  if (index > 0 && entry(index - 1).time == time) return false;
  for (std::size_t i = count_; i > index; --i) entry(i) = entry(i - 1);
  entry(index) = {time, value};
  ++count_;
  return true;
}

Setpoint RecordedValues::at(std::int64_t time) const noexcept {
  const Entry& newest = entry(count_ - 1);
  if (time >= newest.time) return behind(newest, time);
  if (time <= entry(0).time)
    return time == entry(0).time ? entry(0).value : Setpoint{entry(0).value.position, 0.0, 0.0};
  std::size_t low = 0;
  std::size_t high = count_ - 1;  // entry(low).time <= time < entry(high).time
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (entry(middle).time <= time ? low : high) = middle;
  }
  return between(entry(low), entry(high), time);
}

Setpoint RecordedValues::between(const Entry& from, const Entry& to, std::int64_t time) const noexcept {
  if (time == from.time) return from.value;
  const double h = seconds(to.time - from.time);
  const double u = static_cast<double>(time - from.time) / static_cast<double>(to.time - from.time);
  const double linear = from.value.velocity * h;
  const double square = 0.5 * from.value.acceleration * h * h;
  // What the two leave of position, velocity and acceleration at the end.
  const double p = rounded_difference(to.value.position, from.value.position, modulo_) - linear - square;
  const double v = (to.value.velocity - from.value.velocity - from.value.acceleration * h) * h;
  const double a = (to.value.acceleration - from.value.acceleration) * h * h;
  const double c3 = 10.0 * p - 4.0 * v + 0.5 * a;
  const double c4 = -15.0 * p + 7.0 * v - a;
  const double c5 = 6.0 * p - 3.0 * v + 0.5 * a;
  const double distance = u * (linear + u * (square + u * (c3 + u * (c4 + u * c5))));
  const double slope = linear + u * (2.0 * square + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)));
  const double curvature = 2.0 * square + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5));
  return {advanced(from.value.position, distance, modulo_), slope / h, curvature / (h * h)};
}

Setpoint RecordedValues::behind(const Entry& newest, std::int64_t time) const noexcept {
  if (time == newest.time) return newest.value;
  const Setpoint& from = newest.value;
  const std::int64_t accelerated = std::min(time - newest.time, kAccelerated * cycle_);
  const double t = seconds(accelerated);
  const double rest = seconds(time - newest.time - accelerated);
  const double velocity = from.velocity + from.acceleration * t;
  const double distance = (from.velocity + 0.5 * from.acceleration * t) * t + velocity * rest;
  return {advanced(from.position, distance, modulo_), velocity, rest > 0.0 ? 0.0 : from.acceleration};
}

void RecordedValues::rename(double by) noexcept {
  for (std::size_t i = 0; i < count_; ++i)
    entry(i).value.position = advanced(entry(i).value.position, by, modulo_);
}

}  // namespace lockstep
