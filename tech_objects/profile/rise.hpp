/// A rise of velocity: the quickest change from a velocity, with an acceleration ≥ 0, to a higher one.
/// Every profile is made of rises: a fall is a rise with the velocity's sign changed, and the fall from a
/// cruising velocity is a rise run backwards in time.
#pragma once

#include <algorithm>
#include <cmath>

namespace lockstep {

/// Jerk and its reciprocal. Unlimited jerk has both 0: whatever the jerk phases would add is then nothing.
struct JerkLimit {
  double jerk;
  double inverse;
};

/// Maximum acceleration [u/s²] of a rise below and above standstill.
struct RiseLimits {
  double below;
  double above;

  /// Those of this motion run backwards: what slowed down speeds up.
  RiseLimits reversed() const noexcept { return {above, below}; }
};

/// One part of a rise with one limit: to the peak acceleration, along it, and to the last acceleration.
struct RisePart {
  double t1{}, t2{}, t3{};  // [s]
  double a0{}, peak{}, a1{};
  double v0{}, v1{};

  double duration() const noexcept { return t1 + t2 + t3; }
  double distance() const noexcept {
    const double v = v0 + t1 * (a0 + peak) * 0.5;
    return t1 * (v0 + t1 * (2.0 * a0 + peak) * (1.0 / 6.0)) + t2 * (v + t2 * peak * 0.5) +
           t3 * (v1 - t3 * (2.0 * a1 + peak) * (1.0 / 6.0));
  }
};

/// The part from (v0, a0) to (v1, a1). `excess` ≥ 0 [u/s] is what v1 lies above the velocity that is reached
/// by letting the acceleration fall from a0 to a1 at once; it is a parameter of its own, since v1 - v0 would
/// have lost it to rounding where it is small.
inline RisePart rise_part(double v0, double a0, double v1, double a1, double excess, double limit,
                          JerkLimit jerk) noexcept {
  RisePart part{.a0 = a0, .a1 = a1, .v0 = v0, .v1 = v1};
  excess = std::max(excess, 0.0);
  if (a0 <= limit) {
    const double spare = excess - (limit * limit - a0 * a0) * jerk.inverse;
    if (spare >= 0.0) {
      part.peak = limit;
      part.t1 = (limit - a0) * jerk.inverse;
      part.t2 = spare / limit;
    } else {
      part.peak = std::sqrt(a0 * a0 + jerk.jerk * excess);
      const double sum = part.peak + a0;
      part.t1 = sum > 0.0 ? excess / sum : 0.0;
    }
  } else {  // too great an acceleration falls to the limit first, if there is a margin
    part.peak = std::max(limit, a1);
    part.t1 = (a0 - part.peak) * jerk.inverse;
    part.t2 = excess / part.peak;
  }
  part.t3 = std::max(part.peak - a1, 0.0) * jerk.inverse;
  return part;
}

/// A rise to acceleration 0; its limit changes at standstill, where both limits hold.
struct Rise {
  RisePart first{};
  RisePart second{};
  bool crosses{};  // `second` is part of it

  double duration() const noexcept { return first.duration() + (crosses ? second.duration() : 0.0); }
  double distance() const noexcept { return first.distance() + (crosses ? second.distance() : 0.0); }
  /// The acceleration from which it falls to 0 at the end.
  double last_peak() const noexcept {
    const bool falls_from_first = crosses && second.t1 + second.t2 <= 0.0 && first.t3 > 0.0;
    return crosses && !falls_from_first ? second.peak : first.peak;
  }
};

/// A rise through standstill with limits that differ: v0 < 0 < v1.
inline Rise crossing_rise(double v0, double a0, double v1, const RiseLimits& limits,
                          JerkLimit jerk) noexcept {
  Rise rise{.crosses = true};
  if (jerk.jerk == 0.0) {
    rise.first = rise_part(v0, 0.0, 0.0, 0.0, -v0, limits.below, jerk);
    rise.second = rise_part(0.0, 0.0, v1, 0.0, v1, limits.above, jerk);
    return rise;
  }
  // In the plane of v and a² every motion with full jerk is a straight line of slope ±2 jerk.
  const double a0_square = a0 * a0;
  const double steepest = a0_square - 2.0 * jerk.jerk * v0;
  const double flattest = a0_square + 2.0 * jerk.jerk * v0;
  const double limit = std::min(limits.below, limits.above);
  const double to_end = 2.0 * jerk.jerk * v1;
  const double wanted = std::min(limit * limit, to_end);
  if (steepest <= wanted) {
    const double a = std::sqrt(steepest);
    rise.first = {.t1 = (a - a0) * jerk.inverse, .a0 = a0, .peak = a, .a1 = a, .v0 = v0, .v1 = 0.0};
    rise.second = rise_part(0.0, a, v1, 0.0, v1 - steepest * 0.5 * jerk.inverse, limits.above, jerk);
  } else {
    const double square = std::max(wanted, flattest);
    const double a = std::sqrt(square);
    const double first_excess = -v0 - (a0_square - square) * 0.5 * jerk.inverse;
    rise.first = rise_part(v0, a0, 0.0, a, first_excess, limits.below, jerk);
    const double second_excess = square == to_end ? 0.0 : v1 - square * 0.5 * jerk.inverse;
    rise.second = rise_part(0.0, a, v1, 0.0, second_excess, limits.above, jerk);
  }
  return rise;
}

/// The rise from (v0, a0 ≥ 0) to (v1, 0), where `excess` = v1 - v0 - a0²/(2 jerk) ≥ 0.
inline Rise make_rise(double v0, double a0, double v1, double excess, const RiseLimits& limits,
                      JerkLimit jerk) noexcept {
  if (v0 < 0.0 && v1 > 0.0 && limits.below != limits.above) return crossing_rise(v0, a0, v1, limits, jerk);
  return {.first =
              rise_part(v0, a0, v1, 0.0, excess, v0 < 0.0 && v1 <= 0.0 ? limits.below : limits.above, jerk)};
}

}  // namespace lockstep
