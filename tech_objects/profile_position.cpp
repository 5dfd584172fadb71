#include "tech_objects/profile_position.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tech_objects/profile_root.hpp"

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
  return {sign,
          v0,
          a0,
          v0 + a0 * std::abs(a0) * 0.5 * jerk_.inverse,
          sign * target_velocity_,
          sign > 0.0 ? limit_up_ : limit_down_};
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

void PositionPlanner::plan_to(double target_position, Profile& out) const noexcept {
  const View up = view(1.0);
  const View direct = up.end >= up.stop ? up : view(-1.0);
  const Rise rise = climb(direct, direct.end, direct.end - direct.stop);
  const double direct_way = release_way(direct) + rise.distance();
  const double way = target_position - start_.position;
  const double missing = way - direct.sign * direct_way;

  // What rounding leaves of a motion that is planned anew must not cost a detour.
  const bool at_rest = start_.velocity == 0.0 && start_.acceleration == 0.0 && target_velocity_ == 0.0;
  const double rounding = at_rest ? 0.0
                                  : 8.0 * kEpsilon *
                                        (std::abs(start_.position) + std::abs(target_position) +
                                         std::abs(release_way(direct)) + std::abs(rise.first.distance()));
  if (std::abs(missing) <= rounding) {
    ProfileBuilder builder{out, start_, jerk_};
    build_climb(builder, direct, rise);
    builder.finish(target_position, target_velocity_);
    return;
  }
  const View side = view(missing > 0.0 ? 1.0 : -1.0);
  if (side.sign == direct.sign) {
    Pair pair;
    const double cruise = solve_peak(side, side.end, side.sign * way, rise.last_peak(), pair);
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

/// A peak near which the search starts, as √over: not below the root where the velocity stays positive, since
/// each term of the way alone is less than the way.
double PositionPlanner::first_guess(double base, double missing, double far_peak,
                                    double most) const noexcept {
  if (base < 0.0 || jerk_.jerk == 0.0) return most;
  const double root_jerk = std::sqrt(jerk_.jerk);
  double x = std::min(most, rough_cube_root(missing * root_jerk * (far_peak > 0.0 ? 1.0 : 0.5)));
  if (base > 0.0) x = std::min(x, missing * root_jerk / (base * (far_peak > 0.0 ? 2.0 : 4.0)));
  if (far_peak > 0.0)
    x = std::min(x, std::sqrt(missing / (base / far_peak + far_peak * 0.5 * jerk_.inverse)));
  return x;
}

/// Finds the peak that covers a way; returns the time at constant velocity [s].
/// @param far_peak last acceleration of the rise that is there already without a peak; 0 if there is none
double PositionPlanner::solve_peak(const View& view, double base, double way, double far_peak,
                                   Pair& pair) const noexcept {
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
    const double x = first_guess(base, way - pair.way, far_peak, std::sqrt(over));
    over = x * x;
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

// ---- ease and hold: more way in the direction against the change of velocity ----

PositionPlanner::Entry PositionPlanner::entry(const View& down) const noexcept {
  const double edge = -(down.sign > 0.0 ? limit_down_ : limit_up_);
  if (down.v0 >= edge && down.stop >= edge) return {{}, down.v0, std::max(down.a0, 0.0), 0.0, down.stop};
  const double v = down.a0 >= 0.0 ? down.v0 : down.stop;
  const double a = std::max(down.a0, 0.0);
  const double limit = rise_limits_.below;
  const double flattest = a * a - 2.0 * jerk_.jerk * (edge - v);
  double square = a <= limit ? std::min(a * a + 2.0 * jerk_.jerk * (edge - v), limit * limit) : limit * limit;
  if (down.end > 0.0) {
    const double least = std::min(rise_limits_.below, rise_limits_.above);
    square = std::min(square, least * least - 2.0 * jerk_.jerk * edge);
  }
  square = std::max(square, flattest);
  if (square >= 2.0 * jerk_.jerk * (down.end - edge)) return {{}, v, 0.0, 0.0, down.end};
  Entry entry{{}, edge, std::sqrt(square), 0.0, edge + square * 0.5 * jerk_.inverse};
  entry.part =
      rise_part(v, a, edge, entry.a, edge - v - (a * a - square) * 0.5 * jerk_.inverse, limit, jerk_);
  entry.way = release_way(down) + entry.part.distance();
  return entry;
}

/// The change in two: to velocity `at` without acceleration, then on.
PositionPlanner::Pair PositionPlanner::hold(const View& down, double at, double excess_to,
                                            double excess_from) const noexcept {
  Pair pair{climb(down, at, excess_to), make_rise(at, 0.0, down.end, excess_from, rise_limits_, jerk_), 0.0};
  pair.way = release_way(down) + pair.first.distance() + pair.second.distance();
  return pair;
}

/// The rest of the change after the acceleration at the entry is reduced; `way` is of the whole.
Rise PositionPlanner::eased(const View& down, const Entry& from, double reduction,
                            double& way) const noexcept {
  const double a = from.a - reduction;
  const double v = from.v + reduction * (from.a + a) * 0.5 * jerk_.inverse;
  const double t = reduction * jerk_.inverse;
  const Rise rise = make_rise(v, a, down.end, down.end - from.lowest, rise_limits_, jerk_);
  way = from.way + t * (from.v + t * (2.0 * from.a + a) * (1.0 / 6.0)) + rise.distance();
  return rise;
}

void PositionPlanner::plan_below(const View& up, double way, double target, Profile& out) const noexcept {
  const View down = view(-up.sign);
  const double tolerance = 2.0 * kEpsilon * std::abs(way);
  Pair pair;
  double highest = up.stop, miss_highest = 0.0;
  if (up.stop <= up.limit) {
    pair = peak(up, up.stop, 0.0);
    if (pair.way <= way) {
      const double cruise = solve_peak(up, up.stop, way, pair.second.last_peak(), pair);
      build_peak(up, pair, cruise, target, out);
      return;
    }
    miss_highest = pair.way - way;
  } else {
    highest = up.limit;
    pair = hold(down, -highest, up.stop - highest, highest - up.end);
    if (-pair.way <= way) {
      ProfileBuilder builder{out, start_, jerk_};
      build_climb(builder, down, pair.first);
      builder.add_cruise((way + pair.way) / highest);
      builder.add_rise(pair.second, down.sign);
      builder.finish(target, target_velocity_);
      return;
    }
    miss_highest = -pair.way - way;
  }
  const Entry from = entry(down);
  const double lowest = -from.lowest;
  const auto hold_at = [&](double over) {
    return hold(down, -(lowest + over), (up.stop - lowest) - over, (lowest - up.end) + over);
  };
  const double miss_lowest = -hold_at(0.0).way - way;
  ProfileBuilder builder{out, start_, jerk_};
  if (lowest < highest && (miss_lowest < 0.0 || from.a <= 0.0)) {
    double over = 0.0;
    if (miss_lowest < 0.0)
      over = find_root([&](double x) { return -hold_at(x).way - way; }, 0.0, miss_lowest, highest - lowest,
                       miss_highest, tolerance);
    pair = hold_at(over);
    build_climb(builder, down, pair.first);
    builder.add_rise(pair.second, down.sign);
  } else {
    double eased_way = 0.0;
    const auto miss = [&](double reduction) {
      eased(down, from, reduction, eased_way);
      return -eased_way - way;
    };
    const double reduction = find_root(miss, 0.0, miss(0.0), from.a, miss(from.a), tolerance);
    const Rise rise = eased(down, from, reduction, eased_way);
    if (from.part.duration() > 0.0) {
      if (down.a0 < 0.0) builder.add_release(down.sign, down.sign * down.stop);
      builder.add_part(from.part, down.sign);
    }
    builder.add_jerk(reduction * jerk_.inverse, -down.sign * jerk_.jerk);
    builder.add_rise(rise, down.sign);
  }
  builder.finish(target, target_velocity_);
}

}  // namespace lockstep
