#include "tech_objects/profile/position.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lockstep {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// The cube root to a few percent, by arithmetic on the exponent: a start value for an iteration.
double rough_cube_root(double value) noexcept {
  constexpr std::uint64_t kTwoThirdsOfBias = 0x2A9F7893782DA1CEu;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) / 3 + kTwoThirdsOfBias);
}

}  // namespace

PositionPlanner::PositionPlanner(const MotionState& start, double target_velocity,
                                 const ProfileLimits& limits) noexcept
    : start_(start),
      target_velocity_(target_velocity),
      limit_up_(limits.velocity_max),
      limit_down_(-limits.velocity_min),
      rise_limits_{limits.deceleration, limits.acceleration},
      jerk_{limits.jerk, limits.jerk > 0.0 ? 1.0 / limits.jerk : 0.0} {}

PositionPlanner::View PositionPlanner::view(double sign) const noexcept {
  const double v0 = sign * start_.velocity;
  const double a0 = jerk_.jerk > 0.0 ? sign * start_.acceleration : 0.0;
  const double end = sign * target_velocity_;
  const double released = a0 * std::abs(a0) * 0.5 * jerk_.inverse;
  double stop = v0 + released;
  // A change of velocity by what rounding leaves would take far more than a rounding error of time.
  const double velocities = std::abs(v0) + std::abs(released) + std::abs(end);
  if (std::abs(stop - end) <= 16.0 * kEpsilon * velocities) stop = end;
  return {sign, v0, a0, stop, end, sign > 0.0 ? limit_up_ : limit_down_};
}

/// Distance until an acceleration against the view's direction has fallen to 0.
double PositionPlanner::release_distance(const View& view) const noexcept {
  if (view.a0 >= 0.0) return 0.0;
  const double t = -view.a0 * jerk_.inverse;
  return t * (view.v0 + t * view.a0 * (1.0 / 3.0));
}

/// The rise to a velocity, after the release. `excess` is `to` - stop, known better than by subtracting.
Rise PositionPlanner::climb(const View& view, double to, double excess) const noexcept {
  return view.a0 >= 0.0 ? make_rise(view.v0, view.a0, to, excess, rise_limits_, jerk_)
                        : make_rise(view.stop, 0.0, to, excess, rise_limits_, jerk_);
}

void PositionPlanner::build_climb(ProfileBuilder& builder, const View& view,
                                  const Rise& rise) const noexcept {
  if (view.a0 < 0.0) builder.add_release(view.sign, view.sign * view.stop);
  builder.add_rise(rise, view.sign);
}

void PositionPlanner::plan_direct(Profile& out) const noexcept {
  const View up = view(1.0);
  const View direct = up.end >= up.stop ? up : view(-1.0);
  ProfileBuilder builder{out, start_, jerk_};
  build_climb(builder, direct, climb(direct, direct.end, direct.end - direct.stop));
  builder.finish(builder.position(), target_velocity_);
}

/// What rounding leaves of a motion that is planned anew must not cost a detour: so much distance does not
/// count.
double PositionPlanner::rounding(const View& direct, const Rise& rise, double target) const noexcept {
  const double v = std::max(std::abs(direct.v0), std::abs(direct.end));
  if (v == 0.0 && direct.a0 == 0.0) return 0.0;
  const double distances = std::abs(start_.position) + std::abs(target) + v * rise.duration();
  const double of_acceleration = direct.a0 != 0.0 ? v * rise_limits_.above * jerk_.inverse : 0.0;
  return 32.0 * kEpsilon * (distances + of_acceleration);
}

void PositionPlanner::plan_to(double target_position, Profile& out) const noexcept {
  const View up = view(1.0);
  const View direct = up.end >= up.stop ? up : view(-1.0);
  const Rise rise = climb(direct, direct.end, direct.end - direct.stop);
  const double direct_distance = release_distance(direct) + rise.distance();
  const double distance = target_position - start_.position;
  const double missing = distance - direct.sign * direct_distance;

  if (std::abs(missing) <= rounding(direct, rise, target_position)) {
    ProfileBuilder builder{out, start_, jerk_};
    build_climb(builder, direct, rise);
    builder.finish(target_position, target_velocity_);
    return;
  }
  const View side = view(missing > 0.0 ? 1.0 : -1.0);
  if (side.sign == direct.sign) {
    Pair pair;
    const double cruise = solve_peak(side, side.end, side.sign * distance, pair);
    build_peak(side, pair, cruise, target_position, out);
  } else {
    plan_below(side, side.sign * distance, target_position, out);
  }
}

// ---- peak and cruise ----

/// The motion over a peak `over` ≥ 0 above `base`, the higher one of stop and end.
PositionPlanner::Pair PositionPlanner::peak(const View& view, double base, double over) const noexcept {
  const double top = base + over;
  Pair pair{climb(view, top, (base - view.stop) + over),
            make_rise(view.end, 0.0, top, (base - view.end) + over, rise_limits_.reversed(), jerk_), 0.0};
  pair.distance = release_distance(view) + pair.first.distance() + pair.second.distance();
  return pair;
}

/// A peak near which the search starts. To the third order, the distance gained is a polynomial in x = √over.
/// @param pair the motion without a peak; a rise without length gains as √over, another one as over
double PositionPlanner::first_guess(double base, double missing, const Pair& pair,
                                    double maximum) const noexcept {
  const double a1 = pair.first.last_peak(), a2 = pair.second.last_peak();
  if (base < 0.0 || jerk_.jerk == 0.0 || (a1 > 0.0 && a2 > 0.0)) return maximum;
  const double far_peak = std::max(a1, a2);
  const double count = (far_peak > 0.0 ? 1.0 : 2.0) / std::sqrt(jerk_.jerk);
  const double c1 = 2.0 * count * base, c3 = count;
  const double c2 = far_peak > 0.0 ? base / far_peak + far_peak * 0.5 * jerk_.inverse : 0.0;
  double x = std::min(rough_cube_root(missing / c3) * 1.1, std::sqrt(maximum));
  if (c1 > 0.0) x = std::min(x, missing / c1);
  for (int step = 0; step < 3; ++step) {
    const double gained = x * (c1 + x * (c2 + x * c3));
    x -= (gained - missing) / (c1 + x * (2.0 * c2 + 3.0 * x * c3));
  }
  return x * x;
}

/// How much distance a higher peak adds, per velocity [s].
double PositionPlanner::gain(const Pair& pair, double top) const noexcept {
  const double a1 = pair.first.last_peak(), a2 = pair.second.last_peak();
  return top * (1.0 / a1 + 1.0 / a2) + (a1 + a2) * 0.5 * jerk_.inverse;
}

/// Finds the peak that covers a distance; returns the time at constant velocity [s].
double PositionPlanner::solve_peak(const View& view, double base, double distance,
                                   Pair& pair) const noexcept {
  PeakSearch search{0.0, std::max(view.limit - base, 0.0), 0.0, true};
  pair = peak(view, base, search.high);
  if (pair.distance <= distance) return (distance - pair.distance) / view.limit;

  // From `flat` on the smaller rise has a plateau, and the distance mostly is a quadratic polynomial.
  const bool near_is_second = view.end >= view.stop;
  const double near_limit = (base >= 0.0) == near_is_second ? rise_limits_.below : rise_limits_.above;
  const double flat = near_limit * near_limit * jerk_.inverse;
  if (flat < search.high) {
    pair = peak(view, base, flat);
    search.by_root = pair.distance >= distance;
    (search.by_root ? search.high : search.low) = flat;
  }
  if (search.by_root) {
    pair = peak(view, base, 0.0);
    search.over = first_guess(base, distance - pair.distance, pair, search.high);
  } else {
    const double missing = distance - pair.distance, linear = gain(pair, base + flat);
    const double bend = 1.0 / pair.first.last_peak() + 1.0 / pair.second.last_peak();
    search.over = flat + 2.0 * missing / (linear + std::sqrt(linear * linear + 2.0 * bend * missing));
  }
  if (!(search.over > search.low && search.over < search.high))
    search.over = 0.5 * (search.low + search.high);
  refine_peak(view, base, distance, search, pair);
  return 0.0;
}

/// Newton's method, in √over where the smaller rise has no plateau; bisection where that leaves the bracket.
void PositionPlanner::refine_peak(const View& view, double base, double distance, PeakSearch search,
                                  Pair& pair) const noexcept {
  constexpr int kMaximumSteps = 200;
  const double fastest = std::max(std::abs(view.v0), std::abs(view.end));
  for (int step = 0; step < kMaximumSteps; ++step) {
    const double over = search.over;
    pair = peak(view, base, over);
    const double miss = pair.distance - distance;
    const double distances = std::abs(distance) + std::max(fastest, std::abs(base + over)) *
                                                      (pair.first.duration() + pair.second.duration());
    if (std::abs(miss) <= kEpsilon * distances) return;
    (miss < 0.0 ? search.low : search.high) = over;
    const double slope = gain(pair, base + over);
    double next = over - miss / slope;
    if (search.by_root) {
      const double x = std::sqrt(over);
      const double better = x - miss / (2.0 * x * slope);
      next = better > 0.0 ? better * better : search.low;
    }
    if (std::abs(next - over) <= kEpsilon * over) return;
    if (!(next > search.low && next < search.high)) {
      const double x = 0.5 * (std::sqrt(search.low) + std::sqrt(search.high));
      next = x * x;
      if (!(next > search.low && next < search.high)) return;  // nothing lies between them
    }
    search.over = next;
  }
}

void PositionPlanner::build_peak(const View& view, const Pair& pair, double cruise, double target,
                                 Profile& out) const noexcept {
  ProfileBuilder builder{out, start_, jerk_};
  build_climb(builder, view, pair.first);
  builder.add_cruise(cruise);
  builder.add_reversed(pair.second, view.sign);
  builder.finish(target, target_velocity_);
}

}  // namespace lockstep
