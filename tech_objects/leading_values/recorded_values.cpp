#include "tech_objects/leading_values/recorded_values.hpp"

#include <algorithm>
#include <utility>

#include "tech_objects/leading_values/seconds.hpp"

namespace lockstep {
namespace {

/// For so many cycles of the source its acceleration goes on behind the newest value.
constexpr int kAccelerated = 4;

}  // namespace

void RecordedValues::reserve() {
  entries_.resize(kCapacity);
}

void RecordedValues::set_source(const Modulo& modulo, std::int64_t cycle) noexcept {
  modulo_ = modulo;
  cycle_ = cycle;
}

bool RecordedValues::add(std::int64_t time, const Setpoint& value, std::int64_t grid) noexcept {
  if (entries_.empty()) return false;
  if (count_ == kCapacity) {
    if (time <= entry(0).time) return false;
    first_ = (first_ + 1) & (kCapacity - 1);
    --count_;
  }
  std::size_t index = count_;
  while (index > 0 && entry(index - 1).time > time) --index;
  if (index > 0 && entry(index - 1).time == time) return false;
  for (std::size_t i = count_; i > index; --i) entry(i) = entry(i - 1);
  entry(index) = {time, value, grid};
  ++count_;
  changed_from_ = std::min(changed_from_, index == 0 ? INT64_MIN : entry(index - 1).time);
  for (std::size_t i = std::max<std::size_t>(index, 1); i < count_ && i <= index + 1; ++i)
    if (stood(entry(i - 1), entry(i)) > 0) newest_step_ = std::max(newest_step_, entry(i).time);
  return true;
}

/// For how long the source has stood between two neighbours; less than half a cycle is the noise of a clock.
/// Whoever sends may put any number into a grid: it never counts for more than the time between them.
std::int64_t RecordedValues::stood(const Entry& from, const Entry& to) const noexcept {
  const auto time =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(to.grid) - static_cast<std::uint64_t>(from.grid));
  return time > cycle_ / 2 ? std::min(time, to.time - from.time) : 0;
}

std::int64_t RecordedValues::sum_of_steps(std::int64_t from, std::int64_t to) const noexcept {
  std::int64_t sum = 0;
  for (std::size_t i = count_; i-- > 1 && entry(i).time > from;)
    if (entry(i).time <= to) sum += stood(entry(i - 1), entry(i));
  return sum;
}

Setpoint RecordedValues::at(std::int64_t time) const noexcept {
  const Entry& newest = entry(count_ - 1);
  if (time >= newest.time) return behind(newest, time);
  if (time <= entry(0).time)
    return time == entry(0).time ? entry(0).value : Setpoint{entry(0).value.position, 0.0, 0.0};
  const std::size_t before = index_before(time);
  return between(entry(before), entry(before + 1), time);
}

/// The last value that is no later than a time between the oldest and the newest. Most are asked for not far
/// ahead of the newest.
std::size_t RecordedValues::index_before(std::int64_t time) const noexcept {
  std::size_t high = count_ - 1;  // entry(low).time <= time < entry(high).time
  std::size_t step = 1;
  while (step < high && entry(high - step).time > time) {
    high -= step;
    step *= 2;
  }
  std::size_t low = step < high ? high - step : 0;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (entry(middle).time <= time ? low : high) = middle;
  }
  return low;
}

Setpoint RecordedValues::between(const Entry& from, const Entry& to, std::int64_t time) const noexcept {
  if (time == from.time) return from.value;
  if (stood(from, to) > 0) return behind(from, time);
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
