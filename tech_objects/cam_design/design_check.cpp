#include "tech_objects/cam_design/design_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/cam_design/design_parts.hpp"

namespace lockstep {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Part of the maximum value, or of what the derivative below makes over the length of the cam, that is a
/// rounding.
constexpr double kRounding = 1.0e-6;

constexpr std::string_view kOrders[] = {"following value", "velocity", "acceleration", "jerk"};

using Orders = std::array<double, 5>;  // position, velocity, acceleration, jerk, |torque|

Orders orders_of(const MotionValue& v) {
  return {v.position, v.velocity, v.acceleration, v.jerk, std::abs(v.velocity * v.acceleration)};
}

Orders orders_of(const CamDerivatives& v) {
  return {v.position, v.first, v.second, v.third, std::abs(v.first * v.second)};
}

/// Finds extremes over one stretch after the other, each given by one formula.
class Extremes {
 public:
  Extremes() {
    lowest_.fill({kInfinity, 0.0, 0.0});
    highest_.fill({-kInfinity, 0.0, 0.0});
  }

  template <class Curve>
  void sample(const Curve& curve, double from, double to, int samples) {
    for (int k = 0; k <= samples; ++k) {
      const double x = k < samples ? from + (to - from) * k / samples : to;
      const Orders values = orders_of(curve(x));
      const double low = from + (to - from) * std::max(k - 1, 0) / samples;
      const double high = from + (to - from) * std::min(k + 1, samples) / samples;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] < lowest_[i].value) lowest_[i] = {values[i], low, high};
        if (values[i] > highest_[i].value) highest_[i] = {values[i], low, high};
      }
    }
  }

  /// Narrows what was sampled; `curve` gives the formula that holds in the middle of a neighbourhood.
  template <class CurveNear>
  CamExtremes refined(const CurveNear& curve_near) const {
    CamExtremes result;
    for (std::size_t i = 0; i < 5; ++i) {
      const double highest = refine(curve_near, i, 1.0, highest_[i]);
      if (i == 4) {
        result.torque = highest;
        continue;
      }
      result.highest[i] = highest;
      result.lowest[i] = -refine(curve_near, i, -1.0, lowest_[i]);
    }
    return result;
  }

 private:
  struct Found {
    double value, low, high;  // and the neighbourhood
  };

  /// The golden section.
  template <class CurveNear>
  static double refine(const CurveNear& curve_near, std::size_t order, double sign, Found found) {
    const auto curve = curve_near(0.5 * (found.low + found.high));
    double best = sign * found.value;
    for (int step = 0; step < 60; ++step) {
      const double left = found.high - 0.6180339887498949 * (found.high - found.low);
      const double right = found.low + 0.6180339887498949 * (found.high - found.low);
      const double left_value = sign * orders_of(curve(left))[order];
      const double right_value = sign * orders_of(curve(right))[order];
      best = std::max({best, left_value, right_value});
      (left_value < right_value ? found.low : found.high) = left_value < right_value ? left : right;
    }
    return best;
  }

  std::array<Found, 5> lowest_, highest_;
};

/// The piece that a leading value within the range lies in; at a joint the one behind it.
std::size_t piece_at(const CamFunction& cam, double x) {
  std::size_t low = 0;
  std::size_t high = cam.piece_count();
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (cam.piece_start(middle) <= x ? low : high) = middle;
  }
  return low;
}

/// What of a cam is a rounding, for each derivative.
std::array<double, 4> roundings_of(const CamFunction& cam) {
  const double length = cam.end_leading_value() - cam.start_leading_value();
  const CamExtremes extremes = extremes_of(cam, cam.start_leading_value(), cam.end_leading_value());
  std::array<double, 4> rounding{};
  rounding[0] = 1.0e-9 * extremes.peak(0);
  for (int order = 1; order < 4; ++order)
    rounding[order] = kRounding * std::max(extremes.peak(order), extremes.peak(order - 1) / length);
  return rounding;
}

/// The first order in which two values differ; 4 if in none.
int first_step(const Orders& left, const Orders& right, const std::array<double, 4>& rounding) {
  int order = 0;
  while (order < 4 && std::abs(left[order] - right[order]) <= rounding[order]) ++order;
  return order;
}

/// Checks of one cam, one after the other.
class Checker {
 public:
  Checker(const CamDesign* design, const DesignedCam& cam, const CamChecks& checks)
      : design_(design), cam_(cam), checks_(checks) {}

  std::vector<CamFinding> check() {
    check_ranges();
    check_limits();
    check_suitability();
    check_continuity();
    return std::move(findings_);
  }

 private:
  /// A finding at the element or transition at a leading value.
  void find(double x, std::string text) {
    const CamStretch* at = nullptr;
    for (const CamStretch& stretch : cam_.stretches)
      if (stretch.from <= x && x <= stretch.to && (at == nullptr || stretch.transition)) at = &stretch;
    findings_.push_back({at != nullptr ? at->element : CamFinding::kWhole, at != nullptr && at->transition,
                         "", std::move(text)});
  }

  /// Each element and transition, or the cam if it has none.
  template <class Check>
  void for_each_stretch(const Check& check) {
    for (const CamStretch& stretch : cam_.stretches) check(stretch.from, stretch.to, &stretch);
    if (cam_.stretches.empty())
      check(cam_.function->start_leading_value(), cam_.function->end_leading_value(), nullptr);
  }

  void find_at(const CamStretch* stretch, std::string text) {
    findings_.push_back({stretch != nullptr ? stretch->element : CamFinding::kWhole,
                         stretch != nullptr && stretch->transition, "", std::move(text)});
  }

  static std::string span(double low, double high) {
    return "from " + number_text(low) + " to " + number_text(high);
  }

  void check_ranges() {
    for_each_stretch([&](double from, double to, const CamStretch* stretch) {
      if (const auto& range = checks_.leading_range; range && (from < (*range)[0] || to > (*range)[1]))
        find_at(stretch,
                "leading values " + span(from, to) + " leave the range " + span((*range)[0], (*range)[1]));
      if (!checks_.following_range) return;
      const auto& range = *checks_.following_range;
      const CamExtremes extremes = extremes_of(*cam_.function, from, to);
      const double rounding = 1.0e-12 * std::max(std::abs(range[0]), std::abs(range[1]));
      if (extremes.lowest[0] < range[0] - rounding || extremes.highest[0] > range[1] + rounding)
        find_at(stretch, "following values " + span(extremes.lowest[0], extremes.highest[0]) +
                             " leave the range " + span(range[0], range[1]));
    });
  }

  void check_limits() {
    if (!checks_.leading_velocity) return;
    const std::optional<double> limits[] = {checks_.max_velocity, checks_.max_acceleration, checks_.max_jerk};
    for_each_stretch([&](double from, double to, const CamStretch* stretch) {
      if (!(from < to)) return;
      const CamExtremes extremes = extremes_of(*cam_.function, from, to);
      double factor = 1.0;
      for (int order = 1; order < 4; ++order) {
        factor *= std::abs(*checks_.leading_velocity);
        const auto& limit = limits[order - 1];
        const double peak = extremes.peak(order) * factor;
        if (limit && peak > *limit * (1.0 + 1.0e-9))
          find_at(stretch, std::string(kOrders[order]) + " of the following axis reaches " +
                               number_text(peak) + " at a leading velocity of " +
                               number_text(*checks_.leading_velocity) + "; allowed are " +
                               number_text(*limit));
      }
    });
    // Where a derivative steps, the next one is infinite.
    for (const CamJoint& joint : joints_of(*cam_.function, checks_.cyclic, checks_.closed)) {
      const auto step = static_cast<std::size_t>(joint.keeps);  // order of what steps
      if (step < 3 && limits[step])
        find(joint.x, step_text(joint) + ": the " + std::string(kOrders[step + 1]) +
                          " is infinite there, whatever its limit");
    }
  }

  void check_suitability() {
    if (!checks_.suitability || design_ == nullptr) return;
    const auto rounding = roundings_of(*cam_.function);
    for (const CamStretch& stretch : cam_.stretches) {
      if (!stretch.law) continue;
      const auto compare = [&](const MotionBoundary& beside, double x, std::string_view end) {
        const MotionValue value = stretch.law->value(x);
        const std::pair<double, double> pairs[] = {{value.velocity, *beside.velocity},
                                                   {value.acceleration, *beside.acceleration}};
        for (std::size_t i = 0; i < 2; ++i)
          if (std::abs(pairs[i].first - pairs[i].second) > rounding[i + 1])
            find_at(&stretch, "the law '" + std::string(motion_law_name(stretch.kind)) + "' has the " +
                                  std::string(kOrders[i + 1]) + " " + number_text(pairs[i].first) +
                                  " at its " + std::string(end) + ", the element there " +
                                  number_text(pairs[i].second));
      };
      compare(stretch.at_start, stretch.from, "start");
      compare(stretch.at_end, stretch.to, "end");
    }
  }

  void check_continuity() {
    for (const CamJoint& joint : joints_of(*cam_.function, checks_.cyclic, checks_.closed))
      if (joint.wrap && joint.keeps == Continuity::not_applicable)
        find(joint.x, step_text(joint) + "; it has to close");
      else if (checks_.continuity && joint.keeps < *checks_.continuity)
        find(joint.x, step_text(joint) + "; it has to be continuous up to the " +
                          std::string(kOrders[static_cast<std::size_t>(*checks_.continuity) - 1]));
  }

  const CamDesign* design_;
  const DesignedCam& cam_;
  const CamChecks& checks_;
  std::vector<CamFinding> findings_;
};

}  // namespace

double CamExtremes::peak(int order) const noexcept {
  return std::max(std::abs(lowest[order]), std::abs(highest[order]));
}

CamExtremes extremes_of(const CamFunction& cam, double from, double to) {
  Extremes extremes;
  const std::size_t first = piece_at(cam, from);
  const std::size_t last = from < to ? std::max(first, piece_at(cam, std::nextafter(to, from))) : first;
  const int samples = last - first > 200 ? 8 : 64;
  for (std::size_t piece = first; piece <= last; ++piece) {
    const auto curve = [&](double x) { return cam.piece_value(piece, x); };
    extremes.sample(curve, std::max(from, cam.piece_start(piece)), std::min(to, cam.piece_start(piece + 1)),
                    samples);
  }
  return extremes.refined([&](double near) {
    const std::size_t piece = piece_at(cam, near);
    return [&cam, piece](double x) { return cam.piece_value(piece, x); };
  });
}

CamExtremes extremes_of(const std::function<MotionValue(double)>& curve, double from, double to) {
  Extremes extremes;
  extremes.sample(curve, from, to, 4096);
  return extremes.refined([&](double /*near*/) { return curve; });
}

MotionPeaks mapped_peaks(const CamFunction& cam, const CamStretch& stretch) {
  const CamExtremes extremes = extremes_of(cam, stretch.from, stretch.to);
  const double length = stretch.to - stretch.from;
  const double stroke = stretch.at_end.y - stretch.at_start.y;
  if (stroke == 0.0) return {kNan, kNan, kNan, kNan, kNan};
  const double velocity = std::abs(stroke) / length;
  const double acceleration = velocity / length;
  MotionPeaks peaks{extremes.peak(1) / velocity, extremes.highest[2] / acceleration,
                    -extremes.lowest[2] / acceleration, extremes.peak(3) / (acceleration / length),
                    extremes.torque / (velocity * acceleration)};
  if (stroke < 0.0) std::swap(peaks.acceleration, peaks.deceleration);
  peaks.acceleration = std::max(peaks.acceleration, 0.0);
  peaks.deceleration = std::max(peaks.deceleration, 0.0);
  for (const CamJoint& joint : joints_of(cam, false))
    if (joint.x >= stretch.from && joint.x <= stretch.to && joint.keeps < Continuity::acceleration)
      peaks.jerk = kInfinity;
  return peaks;
}

std::string step_text(const CamJoint& joint) {
  return std::string(joint.wrap ? "from the end to the start" : "at leading value " + number_text(joint.x)) +
         " the " + std::string(kOrders[static_cast<std::size_t>(joint.keeps)]) + " steps from " +
         number_text(joint.left) + " to " + number_text(joint.right);
}

std::vector<CamJoint> joints_of(const CamFunction& cam, bool cyclic, bool closed) {
  const auto rounding = roundings_of(cam);
  std::vector<CamJoint> joints;
  const auto compare = [&](double x, const Orders& left, const Orders& right, bool wrap) {
    const int order = first_step(left, right, rounding);
    if (order < 4) joints.push_back({x, static_cast<Continuity>(order), left[order], right[order], wrap});
  };
  const std::size_t count = cam.piece_count();
  for (std::size_t piece = 1; piece < count; ++piece) {
    const double x = cam.piece_start(piece);
    compare(x, orders_of(cam.piece_value(piece - 1, x)), orders_of(cam.piece_value(piece, x)), false);
  }
  if (cyclic || closed) {
    Orders left = orders_of(cam.piece_value(count - 1, cam.end_leading_value()));
    const Orders right = orders_of(cam.piece_value(0, cam.start_leading_value()));
    if (!closed) left[0] = right[0];  // a stroke a turn is no step
    compare(cam.end_leading_value(), left, right, true);
  }
  return joints;
}

std::vector<CamFinding> check_cam(const CamDesign* design, const DesignedCam& cam, const CamChecks& checks) {
  return Checker(design, cam, checks).check();
}

}  // namespace lockstep
