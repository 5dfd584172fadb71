#include "tech_objects/leading_values/adapted_value.hpp"

#include <algorithm>
#include <cstdlib>

#include "tech_objects/leading_values/seconds.hpp"

namespace lockstep {

/// Where the path on which it is now was in the last tick: behind a step of it, where it would have been.
Setpoint AdaptedValue::path_before(const RecordedValues& recorded, const Setpoint& target, std::int64_t time,
                                   std::int64_t passed) const noexcept {
  if (recorded.stood_between(time - passed, time) == 0) return recorded.at(time - passed);
  const double t = seconds(passed);
  const double distance = (target.velocity - 0.5 * target.acceleration * t) * t;
  return {advanced(target.position, -distance, recorded.modulo()), target.velocity - target.acceleration * t,
          target.acceleration};
}

/// Looks where the path was in the last tick by what is known now, and begins a return if that is not where
/// it was then.
void AdaptedValue::compare(const RecordedValues& recorded, const Setpoint& target, std::int64_t passed,
                           std::int64_t time, std::int64_t stood, std::int64_t cycle) noexcept {
  const Setpoint was = path_before(recorded, target, time, passed);
  if (was.position == followed_.position && was.velocity == followed_.velocity &&
      was.acceleration == followed_.acceleration)
    return;
  const std::int64_t change = std::abs(time - passed - time_);
  plan({rounded_difference(followed_.position, was.position, recorded.modulo()),
        followed_.velocity - was.velocity, followed_.acceleration - was.acceleration},
       kReturnCycles * cycle + 4 * (std::max(extrapolated_, stood) + change), 4 * stood);
}

const Setpoint& AdaptedValue::step(const RecordedValues& recorded, std::int64_t now, std::int64_t time,
                                   std::int64_t cycle) noexcept {
  const Setpoint target = recorded.at(time);
  const Modulo& modulo = recorded.modulo();
  if (begun_) {
    const std::int64_t passed = now - now_;
    const std::int64_t stood = recorded.stood_between(stood_to_, time);
    if (stood != 0 || time - passed != time_ || time_ > recorded.changed_from())
      compare(recorded, target, passed, time, stood, cycle);
    returned_for_ += passed;
    if (returned_for_ >= return_time_) return_time_ = 0;
  }
  begun_ = true;
  now_ = now;
  time_ = time;
  extrapolated_ = time - recorded.newest_time();
  stood_to_ = std::min(time, recorded.newest_time());
  followed_ = value_ = target;
  if (return_time_ == 0) return value_;
  const Difference beside = difference();
  value_.position = advanced(target.position, beside.position, modulo);
  value_.velocity += beside.velocity;
  value_.acceleration += beside.acceleration;
  return value_;
}

/// Begins a return with what is left of the last one and more; it takes no less time than that has left, and
/// longer where the source has stood meanwhile.
void AdaptedValue::plan(const Difference& more, std::int64_t time, std::int64_t stood) noexcept {
  Difference left;
  if (return_time_ != 0) left = difference();
  start_ = {left.position + more.position, left.velocity + more.velocity,
            left.acceleration + more.acceleration};
  return_time_ = std::max(time, return_time_ - returned_for_ + stood);
  returned_for_ = 0;
}

AdaptedValue::Difference AdaptedValue::difference() const noexcept {
  const double h = seconds(return_time_);
  const double u = static_cast<double>(returned_for_) / static_cast<double>(return_time_);
  const double linear = start_.velocity * h;
  const double square = 0.5 * start_.acceleration * h * h;
  const double p = -start_.position - linear - square;
  const double v = -linear - 2.0 * square;
  const double a = -2.0 * square;
  const double c3 = 10.0 * p - 4.0 * v + 0.5 * a;
  const double c4 = -15.0 * p + 7.0 * v - a;
  const double c5 = 6.0 * p - 3.0 * v + 0.5 * a;
  return {start_.position + u * (linear + u * (square + u * (c3 + u * (c4 + u * c5)))),
          (linear + u * (2.0 * square + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / h,
          (2.0 * square + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (h * h)};
}

void AdaptedValue::rename(double by, const Modulo& modulo) noexcept {
  value_.position = advanced(value_.position, by, modulo);
  followed_.position = advanced(followed_.position, by, modulo);
}

}  // namespace lockstep
