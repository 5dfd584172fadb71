#include "tech_objects/profile_position.hpp"

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

/// Way until an acceleration against the view's direction has fallen to 0.
double PositionPlanner::release_way(const View& view) const noexcept {
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

/// What rounding leaves of a motion that is planned anew must not cost a detour: so much way does not count.
double PositionPlanner::rounding(const View& direct, const Rise& rise, double target) const noexcept {
  const double v = std::max(std::abs(direct.v0), std::abs(direct.end));
  if (v == 0.0 && direct.a0 == 0.0) return 0.0;
  const double ways = std::abs(start_.position) + std::abs(target) + v * rise.duration();
  const double of_acceleration = direct.a0 != 0.0 ? v * rise_limits_.above * jerk_.inverse : 0.0;
  return 32.0 * kEpsilon * (ways + of_acceleration);
}

void PositionPlanner::plan_to(double target_position, Profile& out) const noexcept {
  const View up = view(1.0);
  const View direct = up.end >= up.stop ? up : view(-1.0);
  const Rise rise = climb(direct, direct.end, direct.end - direct.stop);
  const double direct_way = release_way(direct) + rise.distance();
  const double way = target_position - start_.position;
  const double missing = way - direct.sign * direct_way;

  if (std::abs(missing) <= rounding(direct, rise, target_position)) {
    ProfileBuilder builder{out, start_, jerk_};
    build_climb(builder, direct, rise);
    builder.finish(target_position, target_velocity_);
    return;
  }
  const View side = view(missing > 0.0 ? 1.0 : -1.0);
  if (side.sign == direct.sign) {
    Pair pair;
    const double cruise = solve_peak(side, side.end, side.sign * way, pair);
    build_peak(side, pair, cruise, target_position, out);
  } else {
    plan_below(side, side.sign * way, target_position, out);
  }
}

// ---- peak and cruise ----

/// The motion over a peak `over` ≥ 0 above `base`, the higher one of stop and end.
PositionPlanner::Pair PositionPlanner::peak(const View& view, double base, double over) const noexcept {
  const double top = base + over;
  Pair pair{climb(view, top, (base - view.stop) + over),
            make_rise(view.end, 0.0, top, (base - view.end) + over, rise_limits_.reversed(), jerk_), 0.0};
  pair.way = release_way(view) + pair.first.distance() + pair.second.distance();
  return pair;
}

/// A peak near which the search starts. To the third order, the way gained is a polynomial in x = √over.
/// @param pair the motion without a peak; a rise without length gains as √over, another one as over
double PositionPlanner::first_guess(double base, double missing, const Pair& pair,
                                    double most) const noexcept {
  const double a1 = pair.first.last_peak(), a2 = pair.second.last_peak();
  if (base < 0.0 || jerk_.jerk == 0.0 || (a1 > 0.0 && a2 > 0.0)) return most;
  const double far_peak = std::max(a1, a2);
  const double count = (far_peak > 0.0 ? 1.0 : 2.0) / std::sqrt(jerk_.jerk);
  const double c1 = 2.0 * count * base, c3 = count;
  const double c2 = far_peak > 0.0 ? base / far_peak + far_peak * 0.5 * jerk_.inverse : 0.0;
  double x = std::min(rough_cube_root(missing / c3) * 1.1, std::sqrt(most));
  if (c1 > 0.0) x = std::min(x, missing / c1);
  for (int step = 0; step < 3; ++step) {
    const double gained = x * (c1 + x * (c2 + x * c3));
    x -= (gained - missing) / (c1 + x * (2.0 * c2 + 3.0 * x * c3));
  }
  return x * x;
}

/// Finds the peak that covers a way; returns the time at constant velocity [s].
double PositionPlanner::solve_peak(const View& view, double base, double way, Pair& pair) const noexcept {
  constexpr int kMostSteps = 200;
  double high = std::max(view.limit - base, 0.0);
  pair = peak(view, base, high);
  if (pair.way <= way) return (way - pair.way) / view.limit;

  const auto slope = [&](double over) {
    const double a1 = pair.first.last_peak(), a2 = pair.second.last_peak();
    return (base + over) * (1.0 / a1 + 1.0 / a2) + (a1 + a2) * 0.5 * jerk_.inverse;
  };
  const bool near_is_second = base == view.end && view.end >= view.stop;
  const double near_limit = (base >= 0.0) == near_is_second ? rise_limits_.below : rise_limits_.above;
  const double flat = near_limit * near_limit * jerk_.inverse;  // from here on the smaller rise has a plateau
  double low = 0.0, over = high;
  bool by_root = true;
  if (flat < high) {
    pair = peak(view, base, flat);
    if (pair.way < way) {
      low = flat;
      by_root = false;
      const double missing = way - pair.way, gain = slope(flat);
      const double bend = 1.0 / pair.first.last_peak() + 1.0 / pair.second.last_peak();
      const double root = gain * gain + 2.0 * bend * missing;
      over = gain > 0.0 ? flat + 2.0 * missing / (gain + std::sqrt(root)) : high;
    } else {
      high = flat;
      over = flat;
    }
  }
  if (by_root) {
    pair = peak(view, base, 0.0);
    over = first_guess(base, way - pair.way, pair, over);
  }
  if (!(over > low && over < high)) over = 0.5 * (low + high);
  for (int step = 0; step < kMostSteps; ++step) {
    pair = peak(view, base, over);
    const double miss = pair.way - way;
    const double v = std::max(std::abs(view.v0), std::max(std::abs(view.end), std::abs(base + over)));
    if (std::abs(miss) <= kEpsilon * (std::abs(way) + v * (pair.first.duration() + pair.second.duration())))
      break;
    (miss < 0.0 ? low : high) = over;
    double next;
    if (by_root) {
      const double x = std::sqrt(over);
      const double better = x - miss / (2.0 * x * slope(over));
      next = better > 0.0 ? better * better : low;
    } else {
      next = over - miss / slope(over);
    }
    if (std::abs(next - over) <= kEpsilon * over) break;
    if (!(next > low && next < high)) {
      const double x = 0.5 * (std::sqrt(low) + std::sqrt(high));
      next = x * x;
    }
    if (high - low <= kEpsilon * high) break;
    over = next;
  }
  return 0.0;
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
