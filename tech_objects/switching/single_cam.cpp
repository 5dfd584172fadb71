#include "tech_objects/switching/single_cam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

double next_towards(double place, double target) noexcept {
  return std::nextafter(place, target);
}

/// The led positions of the edges.
struct Led {
  double on, off;
};

Led led(const SwitchingShape& shape, double position, double velocity) noexcept {
  return {position + velocity * shape.on_lead, position + velocity * shape.off_lead};
}

double place_at(double place, double period, double n) noexcept {
  return place + n * period;
}

/// The last of the places place + n · period that is not above a position: its n. Without period 0 is the
/// only one, and -1 stands for none.
double last_below(double place, double period, double position) noexcept {
  if (period == 0.0) return position >= place ? 0.0 : -1.0;
  double n = std::floor((position - place) / period);
  while (place_at(place, period, n) > position) n -= 1.0;
  while (place_at(place, period, n + 1.0) <= position) n += 1.0;
  return n;
}

/// The first that is not below it. Without period 1 stands for none.
double first_above(double place, double period, double position) noexcept {
  if (period == 0.0) return position <= place ? 0.0 : 1.0;
  double n = std::ceil((position - place) / period);
  while (place_at(place, period, n) < position) n += 1.0;
  while (place_at(place, period, n - 1.0) >= position) n -= 1.0;
  return n;
}

/// Where a distance cam is seen to be: the last lower end that is not above, the first upper end not below.
struct Between {
  double lower, upper;
};

/// Whether it is on there; both ends belong to it.
bool inside(const SwitchingShape& shape, const Between& at) noexcept {
  return shape.outside() ? at.lower >= 0.0 || at.upper <= 0.0 : at.lower >= at.upper;
}

/// The switch-on edge lies where a range is entered, which is its upper end if the motion is downwards.
Between between(const SwitchingShape& shape, const Led& at, int direction) noexcept {
  const bool down = direction < 0;
  return {last_below(shape.on, shape.period, down ? at.off : at.on),
          first_above(shape.off, shape.period, down ? at.on : at.off)};
}

/// The first crossing of one of the places on a path.
struct Crossing {
  bool there = false;
  bool up = false;
  double part = 2.0;   // of the path
  double n = 0.0;      // of the place
  double place = 0.0;  // [u]
};

/// A lower end is crossed upwards on arrival and downwards when it is left, an upper end the other way round,
/// so that no crossing lies between two paths or in both.
enum class End : std::uint8_t { lower, upper };

Crossing crossing(End end, double place, double period, double from, double to) noexcept {
  if (from == to) return {};
  const bool up = to > from;
  double n = 0.0;
  if (end == End::lower)
    n = last_below(place, period, from) + (up ? 1.0 : 0.0);
  else
    n = first_above(place, period, from) - (up ? 0.0 : 1.0);
  if (period == 0.0 && n != 0.0) return {};
  const double found = place_at(place, period, n);
  const bool arrival = (end == End::lower) == up;
  const bool reached = up ? found < to || (arrival && found == to) : found > to || (arrival && found == to);
  if (!reached) return {};
  return {true, up, std::clamp((found - from) / (to - from), 0.0, 1.0), n, found};
}

double at_part(double from, double to, double part) noexcept {
  return from + (to - from) * part;
}

}  // namespace

void SingleCam::set(bool on, double time, SwitchingEdges& edges) noexcept {
  if (on_ == on) return;
  on_ = on;
  edges.add(time, on);
}

void SingleCam::begin(const SwitchingShape& shape, const Stretch& end, int direction, bool inclusive,
                      SwitchingEdges& edges) noexcept {
  const Led at = led(shape, end.to, end.to_velocity);
  if (!shape.timed) {
    set(shape.effective(direction) && inside(shape, between(shape, at, direction)), end.to_time, edges);
    return;
  }
  front_direction_ = direction;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  front_ = inclusive ? next_towards(at.on, direction < 0 ? kFar : -kFar) : at.on;
}

void SingleCam::end(double time, SwitchingEdges& edges) noexcept {
  set(false, time, edges);
}

void SingleCam::step(const SwitchingShape& shape, const Stretch& distance, int direction,
                     SwitchingEdges& edges) noexcept {
  if (shape.timed)
    step_time(shape, distance, direction, edges);
  else
    step_distance(shape, distance, direction, edges);
}

void SingleCam::hold(double to_time, SwitchingEdges& edges) noexcept {
  if (on_ && off_time_ > 0.0 && off_time_ <= to_time) {
    set(false, off_time_, edges);
    off_time_ = 0.0;
  }
}

void SingleCam::step_distance(const SwitchingShape& shape, const Stretch& distance, int direction,
                              SwitchingEdges& edges) noexcept {
  if (!shape.effective(direction)) return set(false, distance.from_time, edges);
  const Led from = led(shape, distance.from, distance.from_velocity);
  const Led to = led(shape, distance.to, distance.to_velocity);
  const bool down = direction < 0;
  Between at = between(shape, from, direction);
  set(inside(shape, at), distance.from_time, edges);
  const Crossing lower =
      crossing(End::lower, shape.on, shape.period, down ? from.off : from.on, down ? to.off : to.on);
  const Crossing upper =
      crossing(End::upper, shape.off, shape.period, down ? from.on : from.off, down ? to.on : to.off);
  const auto pass = [&](const Crossing& crossed, bool is_lower) {
    if (!crossed.there) return;
    if (is_lower)
      at.lower = crossed.up ? crossed.n : crossed.n - 1.0;
    else
      at.upper = crossed.up ? crossed.n + 1.0 : crossed.n;
    set(inside(shape, at), at_part(distance.from_time, distance.to_time, crossed.part), edges);
  };
  const bool lower_first = lower.part <= upper.part;
  pass(lower_first ? lower : upper, lower_first);
  pass(lower_first ? upper : lower, !lower_first);
  set(inside(shape, between(shape, to, direction)), distance.to_time, edges);
}

void SingleCam::step_time(const SwitchingShape& shape, const Stretch& distance, int direction,
                          SwitchingEdges& edges) noexcept {
  const double from = led(shape, distance.from, distance.from_velocity).on;
  const double to = led(shape, distance.to, distance.to_velocity).on;
  if (direction != front_direction_) {
    // The first direction of all leads away from where the cam began; any other from where it turned.
    if (front_direction_ != 0) front_ = from;
    front_direction_ = direction;
  }
  if (direction != 0) {
    const double ahead = direction > 0 ? std::max(front_, from) : std::min(front_, from);
    const bool forwards = direction > 0 ? to > ahead : to < ahead;
    if (forwards) {
      const End end = direction > 0 ? End::lower : End::upper;  // crossed on arrival
      const Crossing at = crossing(end, shape.on, shape.period, ahead, to);
      front_ = to;
      if (at.there && shape.effective(direction)) {
        const double part = from == to ? 1.0 : std::clamp((at.place - from) / (to - from), 0.0, 1.0);
        const double time = at_part(distance.from_time, distance.to_time, part);
        hold(time, edges);
        if (!on_) {
          set(true, time, edges);
          off_time_ = time + shape.on_lead + shape.duration - shape.off_lead;
        }
      }
    } else {
      front_ = ahead;
    }
  }
  hold(distance.to_time, edges);
}

}  // namespace lockstep
