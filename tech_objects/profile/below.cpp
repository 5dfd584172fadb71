// Motions that gain distance against the direction in which the velocity changes. Everything but `distance`
// of plan_below is seen in the direction of that change: less distance is wanted than the quickest change
// covers.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tech_objects/profile/position.hpp"
#include "tech_objects/profile/root.hpp"

namespace lockstep {
namespace {

constexpr double kResolution = std::numeric_limits<double>::epsilon();

}  // namespace

/// A start beyond the limit against the change comes inside on the quickest change; only then it may be
/// eased.
PositionPlanner::Entry PositionPlanner::entry(const View& down) const noexcept {
  const double edge = -(down.sign > 0.0 ? limit_down_ : limit_up_);
  if (down.v0 >= edge && down.stop >= edge) return {{}, down.v0, std::max(down.a0, 0.0), 0.0, down.stop};
  // The quickest change passes the edge with the smallest of the squares that its constraints allow there.
  const double v = down.a0 >= 0.0 ? down.v0 : down.stop;
  const double a = std::max(down.a0, 0.0);
  const double limit = rise_limits_.below;
  const double gain = 2.0 * jerk_.jerk * (edge - v);
  double square = a <= limit ? std::min(a * a + gain, limit * limit) : limit * limit;
  if (down.end > 0.0) {
    const double minimum = std::min(rise_limits_.below, rise_limits_.above);
    square = std::min(square, minimum * minimum - 2.0 * jerk_.jerk * edge);
  }
  square = std::max(square, a * a - gain);
  if (square >= 2.0 * jerk_.jerk * (down.end - edge)) return {{}, v, 0.0, 0.0, down.end};  // it ends before
  Entry entry{{}, edge, std::sqrt(square), 0.0, edge + square * 0.5 * jerk_.inverse};
  entry.part =
      rise_part(v, a, edge, entry.a, edge - v - (a * a - square) * 0.5 * jerk_.inverse, limit, jerk_);
  entry.distance = release_distance(down) + entry.part.distance();
  return entry;
}

// ---- ease ----

/// The rest of the change after the acceleration at the entry is reduced; `distance` is of the whole.
Rise PositionPlanner::eased(const View& down, const Entry& from, double reduction,
                            double& distance) const noexcept {
  const double a = from.a - reduction;
  const double v = from.v + reduction * (from.a + a) * 0.5 * jerk_.inverse;
  const double t = reduction * jerk_.inverse;
  const Rise rise = make_rise(v, a, down.end, down.end - from.lowest, rise_limits_, jerk_);
  distance = from.distance + t * (from.v + t * (2.0 * from.a + a) * (1.0 / 6.0)) + rise.distance();
  return rise;
}

/// Reductions at which the distance may be smallest. Easing from a velocity against the change to one with it
/// first takes distance and then adds it. With a the acceleration it is eased to, p the one it rises to
/// afterwards and s the velocity where it would be 0, the distance grows with the reduction where 2 s + a (p
/// - 2 a)/jerk > 0; p is a limit, or p² = a² + jerk · excess up to the end, or up to standstill where the
/// limits change. Where the rise just meets the lower limit at standstill, p steps.
std::array<double, 5> PositionPlanner::turning_reductions(const Entry& from, double end) const noexcept {
  const double s = from.lowest, j = jerk_.jerk;
  const double minimum = std::min(rise_limits_.below, rise_limits_.above);
  const auto on_limit = [&](double p) {
    return from.a - 0.25 * (p + std::sqrt(std::max(p * p + 16.0 * j * s, 0.0)));
  };
  const auto at_peak = [&](double excess) {
    const double b = j * (8.0 * s + excess), c = 4.0 * j * s;
    const double square = (b + std::sqrt(std::max(b * b - 3.0 * c * c, 0.0))) / 6.0;
    return from.a - std::sqrt(std::max(square, 0.0));
  };
  return {on_limit(rise_limits_.below), on_limit(rise_limits_.above), at_peak(end - s),
          at_peak(minimum * minimum * 0.5 * jerk_.inverse - s),
          from.a - std::sqrt(std::max(j * s + 0.5 * minimum * minimum, 0.0))};
}

/// The minimum reduction that covers a distance; false if there is none.
bool PositionPlanner::solve_ease(const View& down, const Entry& from, double distance,
                                 double& reduction) const noexcept {
  const auto miss = [&](double by) {
    double covered = 0.0;
    eased(down, from, by, covered);
    return covered - distance;
  };
  double maximum = from.a, miss_maximum = miss(maximum);
  if (from.v < 0.0 && down.end > 0.0) {
    for (const double by : turning_reductions(from, down.end)) {
      if (!(by > 0.0 && by < maximum)) continue;
      const double miss_by = miss(by);
      if (miss_by > 0.0) continue;
      maximum = by;
      miss_maximum = miss_by;
    }
  }
  if (miss_maximum > 0.0) return false;
  reduction = find_root([&](double by) { return -miss(by); }, 0.0, -miss(0.0), maximum, -miss_maximum,
                        2.0 * kResolution * std::abs(distance));
  return true;
}

void PositionPlanner::build_eased(const View& down, const Entry& from, double reduction, double target,
                                  Profile& out) const noexcept {
  double distance = 0.0;
  const Rise rise = eased(down, from, reduction, distance);
  ProfileBuilder builder{out, start_, jerk_};
  if (from.part.duration() > 0.0) {
    if (down.a0 < 0.0) builder.add_release(down.sign, down.sign * down.stop);
    builder.add_part(from.part, down.sign);
  }
  builder.add_jerk(reduction * jerk_.inverse, -down.sign * jerk_.jerk);
  builder.add_rise(rise, down.sign);
  builder.finish(target, target_velocity_);
}

// ---- hold ----

/// The change in two: to velocity `at` without acceleration, then on.
PositionPlanner::Pair PositionPlanner::hold(const View& down, double at, double excess_to,
                                            double excess_from) const noexcept {
  Pair pair{climb(down, at, excess_to), make_rise(at, 0.0, down.end, excess_from, rise_limits_, jerk_), 0.0};
  pair.distance = release_distance(down) + pair.first.distance() + pair.second.distance();
  return pair;
}

/// The velocity between `first` and `last` < `first` that splits the change so that it covers a distance;
/// false if there is none: `pair` is then split at `last`.
bool PositionPlanner::solve_hold(const View& down, double first, double last, double distance,
                                 Pair& pair) const noexcept {
  const auto miss = [&](double below) {
    pair = hold(down, first - below, (first - down.stop) - below, (down.end - first) + below);
    return distance - pair.distance;
  };
  const double maximum = first - last;
  const double miss_maximum = miss(maximum);
  if (miss_maximum < 0.0) return false;
  const double miss_minimum = miss(0.0);
  if (miss_minimum < 0.0)
    miss(find_root(miss, 0.0, miss_minimum, maximum, miss_maximum, 2.0 * kResolution * std::abs(distance)));
  return true;
}

void PositionPlanner::build_hold(const View& down, const Pair& pair, double cruise, double target,
                                 Profile& out) const noexcept {
  ProfileBuilder builder{out, start_, jerk_};
  build_climb(builder, down, pair.first);
  builder.add_cruise(cruise);
  builder.add_rise(pair.second, down.sign);
  builder.finish(target, target_velocity_);
}

void PositionPlanner::plan_below(const View& up, double distance, double target,
                                 Profile& out) const noexcept {
  const View down = view(-up.sign);
  const Entry from = entry(down);
  double reduction = 0.0;
  if (from.a > 0.0 && solve_ease(down, from, -distance, reduction)) {
    build_eased(down, from, reduction, target, out);
    return;
  }
  Pair pair;
  const double last = std::max(down.stop, -up.limit);
  const bool starts_beyond = up.stop > up.limit;
  if ((starts_beyond || last < from.lowest) && solve_hold(down, from.lowest, last, -distance, pair)) {
    build_hold(down, pair, 0.0, target, out);
  } else if (starts_beyond) {
    build_hold(down, pair, (distance + pair.distance) / up.limit, target, out);
  } else {
    const double cruise = solve_peak(up, up.stop, distance, pair);
    build_peak(up, pair, cruise, target, out);
  }
}

}  // namespace lockstep
