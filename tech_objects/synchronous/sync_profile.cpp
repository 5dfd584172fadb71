#include "tech_objects/synchronous/sync_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

/// What rounding of the planned quantities may amount to, against the length of a turn.
constexpr double kRounding = 1e-13;

/// How far a profile in one direction may go, as a multiple of the distances that the slopes and curvatures
/// at its ends make over the leading distance: beyond it no turns are added any more.
constexpr double kFarthest = 2.0;

/// The positive root of t⁴ + 2t³ - 2pt - q, q ≥ 0: there is one (Descartes), and Newton's iteration falls on
/// it from above because the quartic is convex there.
double quartic_root(double p, double q) noexcept {
  double t = 1.0 + std::max(2.0 * std::abs(p), q);
  for (int i = 0; i < 500; ++i) {
    const double value = ((t + 2.0) * t * t - 2.0 * p) * t - q;
    const double next = t - value / ((4.0 * t + 6.0) * t * t - 2.0 * p);
    if (!(next < t) || next <= 0.0) break;
    t = next;
  }
  return t;
}

}  // namespace

// In Bernstein form over [0, 1] the derivative of x has the coefficients
//   c0 = start_slope, c1 = c0 + start_curvature / 4, c2 = 5 distance - 2 c4 - c1 - c0, c3 = c4 = end_slope
// (c0 and c1 add up to 2 c0 + start_curvature / 4). With t = u / (1 - u) it is not negative where
//   c0 + 4 c1 t + 6 c2 t² + 4 c3 t³ + c4 t⁴ ≥ 0 for all t ≥ 0,
// hence where 6 c2 ≥ -min (c0/t² + 4 c1/t + 4 c3 t + c4 t²). That minimum is the only one: its equation,
// times t³, has one change of sign.
double minimum_monotone_distance(double start_slope, double start_curvature, double end_slope) noexcept {
  const double c0 = start_slope;
  const double c1 = c0 + 0.25 * start_curvature;
  const double c4 = end_slope;
  if (c0 < 0.0 || !(c4 > 0.0) || (c0 == 0.0 && c1 < 0.0)) return std::numeric_limits<double>::infinity();
  double c2 = 0.0;
  if (c0 > 0.0 || c1 > 0.0) {
    const double p = c1 / c4;
    const double q = c0 / c4;
    const double t = quartic_root(p, q);
    c2 = -c4 * (q / (t * t) + 4.0 * p / t + (4.0 + t) * t) / 6.0;
  }
  return (c2 + 2.0 * c4 + c1 + c0) / 5.0;
}

double minimum_monotone_distance(double start_slope, double start_curvature, double end_slope,
                                 double end_curvature) noexcept {
  if (end_curvature == 0.0 && end_slope > 0.0)
    return minimum_monotone_distance(start_slope, start_curvature, end_slope);
  const double c0 = start_slope;
  const double c1 = c0 + 0.25 * start_curvature;
  const double c4 = end_slope;
  const double c3 = c4 - 0.25 * end_curvature;
  if (c0 < 0.0 || c4 < 0.0 || (c0 == 0.0 && c1 < 0.0) || (c4 == 0.0 && c3 < 0.0))
    return std::numeric_limits<double>::infinity();
  // 6 c2 ≥ -min (c0/t² + 4 c1/t + 4 c3 t + c4 t²), which may have two minima: from far below to far above.
  const auto bound = [&](double t) { return (c0 / t + 4.0 * c1) / t + (4.0 * c3 + c4 * t) * t; };
  constexpr double kStep = 1.0905077326652577;  // 2^(1/8)
  double best = 1e-6;
  for (double t = best; t < 1e6; t *= kStep)
    if (bound(t) < bound(best)) best = t;
  double low = best / kStep;
  double high = best * kStep;
  for (int i = 0; i < 60; ++i) {
    const double left = low + (high - low) / 3.0;
    const double right = high - (high - low) / 3.0;
    (bound(left) < bound(right) ? high : low) = bound(left) < bound(right) ? right : left;
  }
  return (-bound(low) / 6.0 + c0 + c1 + c3 + c4) / 5.0;
}

SyncPlan SyncProfile::plan(const SyncStart& start, const SyncTarget& target, double distance, bool backward,
                           SyncDirection direction, const Modulo& leading, const Modulo& following) noexcept {
  const double sign = backward ? -1.0 : 1.0;
  const double distance_velocity = sign * start.leading_velocity;
  double slope = 0.0;
  double curvature = 0.0;
  if (distance_velocity > 0.0) {
    slope = start.velocity / distance_velocity;
    curvature = (start.acceleration - slope * sign * start.leading_acceleration) / distance_velocity /
                distance_velocity;
    // A leading axis that creeps so slowly that nothing finite comes of it stands.
    if (!std::isfinite(slope * distance) || !std::isfinite(curvature * distance * distance))
      slope = curvature = 0.0;
  }
  const double end_slope = sign * target.slope;
  DoubleDouble ahead = difference(start.following, target.at_start, following);  // y at the start
  double turns = 0.0;
  if (following.enabled) {
    const double length = following.length;
    const DoubleDouble to_choose = two_product(end_slope, distance) -
                                   0.5 * target.curvature * distance * distance -
                                   ahead;  // of the following axis: which of its turns is to be chosen
    if (direction == SyncDirection::kShortestPath) {
      turns = -std::floor(to_choose.hi / length + 0.5);
    } else {
      const double to = direction == SyncDirection::kPositive ? 1.0 : -1.0;
      if (to * end_slope < 0.0) return SyncPlan::kFunctionRunsInOppositeDirection;
      const double nearest = std::floor(ahead.hi / length + 0.5);
      const double begin_slope = end_slope - target.curvature * distance;
      const double there = kOnSynchronousValue * length;
      const bool on_function = std::abs((ahead - two_product(nearest, length)).hi) <= there &&
                               std::abs(slope - begin_slope) * distance <= there &&
                               std::abs(curvature - target.curvature) * distance * distance <= there &&
                               to * begin_slope * distance >= -there;
      const double minimum =
          minimum_monotone_distance(to * slope * distance, to * curvature * distance * distance,
                                    to * end_slope * distance, to * target.curvature * distance * distance);
      const double natural = (std::abs(slope) + std::abs(end_slope)) * distance +
                             (std::abs(curvature) + std::abs(target.curvature)) * distance * distance;
      if (!on_function && !(minimum <= std::min(kFarthest * natural, 0x1p52 * length) + length))
        return SyncPlan::kAxisMovesInOppositeDirection;
      const double rounding = std::max(kOnSynchronousValue, kRounding * (1.0 + std::abs(minimum / length)));
      turns = on_function ? nearest : to * std::ceil((minimum - to * to_choose.hi) / length - rounding);
    }
    ahead = ahead - two_product(turns, length);
  }
  leading_start_ = start.leading;
  leading_ = leading;
  backward_ = backward;
  turns_ = static_cast<std::int64_t>(turns);
  remainder_.set({.position = ahead.rounded(),
                  .slope = slope - (end_slope - target.curvature * distance),
                  .curvature = curvature - target.curvature},
                 distance);
  return SyncPlan::kReady;
}

double SyncProfile::covered(AxisPosition leading) const noexcept {
  const double distance = rounded_difference(leading, leading_start_, leading_);
  return backward_ ? -distance : distance;
}

}  // namespace lockstep
