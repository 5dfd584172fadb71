#include "tech_objects/linmot/curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tech_objects/cam/spline.hpp"
#include "tech_objects/profile/profile.hpp"

namespace lockstep::linmot {
namespace {

constexpr double kMetre = 1e3;  // [mm]
constexpr double kPi = 3.14159265358979323846;

bool is_positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

/// Puts one part behind another. @return the time at which it ends; 0: it is none
class PartMaker {
 public:
  PartMaker(CamBuilder& cam, double begin) : cam_(cam), begin_(begin) {}

  double make(const CurvePart& part) {
    if (part.type == CurveType::manual) return spline(part);
    if (!std::isfinite(part.start) || !std::isfinite(part.end)) return 0.0;
    if (part.type == CurveType::sine) return sine(part);
    if (part.type == CurveType::minimal_jerk)
      return part.law == JerkLaw::quintic ? quintic(part) : peak_jerk(part);
    return planned(part);
  }

 private:
  double sine(const CurvePart& part) {
    if (!is_positive(part.time)) return 0.0;
    const double half = 0.5 * (part.end - part.start);
    CamSegment segment;
    segment.origin = begin_;
    segment.coefficient[0] = part.start + half;
    segment.amplitude = half;
    segment.frequency = kPi / part.time;
    segment.phase = -0.5 * kPi;
    cam_.add_segment(segment, part.time);
    return begin_ + part.time;
  }

  /// 10 s³ - 15 s⁴ + 6 s⁵.
  double quintic(const CurvePart& part) {
    if (!is_positive(part.time)) return 0.0;
    const double distance = part.end - part.start, t = part.time;
    CamSegment segment;
    segment.origin = begin_;
    segment.coefficient[0] = part.start;
    segment.coefficient[3] = 10.0 * distance / (t * t * t);
    segment.coefficient[4] = -15.0 * distance / (t * t * t * t);
    segment.coefficient[5] = 6.0 * distance / (t * t * t * t * t);
    cam_.add_segment(segment, t);
    return begin_ + t;
  }

  /// Jerk +J, -J, +J over a quarter, a half and a quarter of the time: J = 32 D/T³.
  double peak_jerk(const CurvePart& part) {
    if (!is_positive(part.time)) return 0.0;
    const double distance = part.end - part.start, quarter = 0.25 * part.time;
    const double cubic = 32.0 * distance / (part.time * part.time * part.time) / 6.0;
    const double velocity = 2.0 * distance / part.time;
    const double acceleration = 8.0 * distance / (part.time * part.time);
    cam_.add_cubic(begin_, part.start, 0.0, 0.0, cubic);
    cam_.add_cubic(begin_ + quarter, part.start + distance / 12.0, 0.5 * velocity, 0.5 * acceleration,
                   -cubic);
    cam_.add_cubic(begin_ + 3.0 * quarter, part.end - distance / 12.0, 0.5 * velocity, -0.5 * acceleration,
                   cubic);
    return begin_ + part.time;
  }

  /// The quickest motion within speed, acceleration and jerk.
  double planned(const CurvePart& part) {
    if (!is_positive(part.speed) || !is_positive(part.acceleration) || !(part.jerk >= 0.0)) return 0.0;
    double jerk = 0.0;
    if (part.type == CurveType::limited_jerk)
      jerk = part.jerk > 0.0 ? part.jerk : part.acceleration * part.acceleration / part.speed;
    const ProfileLimits limits{part.speed * kMetre, -part.speed * kMetre, part.acceleration * kMetre,
                               part.acceleration * kMetre, jerk * kMetre};
    Profile profile;
    if (plan_position({part.start, 0.0, 0.0}, part.end, 0.0, limits, profile) != PlanResult::ok) return 0.0;
    for (const Profile::Phase& phase : profile.phases())
      cam_.add_cubic(begin_ + phase.begin, phase.state.position, phase.state.velocity,
                     0.5 * phase.state.acceleration, phase.jerk / 6.0);
    return profile.duration() > 0.0 ? begin_ + profile.duration() : 0.0;
  }

  double spline(const CurvePart& part) {
    std::vector<CamPoint> points = part.points;
    if (points.size() < 2) return 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) return 0.0;
      if (i > 0 && !(part.points[i].x > part.points[i - 1].x)) return 0.0;
      points[i].x += begin_ - part.points[0].x;
    }
    CamSpline through(points.size());
    add_spline(cam_, points, through.through(points, std::nullopt, std::nullopt));
    return points.back().x;
  }

  CamBuilder& cam_;
  double begin_;
};

double end_position(const CurvePart& part) {
  return part.type == CurveType::manual ? part.points.back().y : part.end;
}

}  // namespace

bool Curve::make(std::span<const CurvePart> parts) {
  function_.reset();
  if (parts.empty() || parts.size() > kCurveSegments) return false;
  std::size_t pieces = 2;
  for (const CurvePart& part : parts) pieces += part.points.size() + Profile::kMaxPhases;
  CamFunction function(pieces);
  CamBuilder cam(function);
  double begin = 0.0;
  for (const CurvePart& part : parts) {
    const double end = PartMaker(cam, begin).make(part);
    if (!(end > begin)) return false;
    begin = end;
  }
  if (!cam.finish(begin, end_position(parts.back()))) return false;
  function_.emplace(std::move(function));
  return true;
}

namespace {

void look_at(const CamDerivatives& at, CurvePeaks& found) {
  found.velocity = std::max(found.velocity, std::abs(at.first) / kMetre);
  found.acceleration = std::max(found.acceleration, std::abs(at.second) / kMetre);
  found.jerk = std::max(found.jerk, std::abs(at.third) / kMetre);
}

}  // namespace

/// A cubic has them at its ends, and its velocity where it has no acceleration; sines and quintics are looked
/// at closely.
CurvePeaks Curve::peaks() const {
  constexpr int kSamples = 1000;
  constexpr double kRounding = 1e-6;  // of a jerk that is the same
  CurvePeaks found;
  for (std::size_t i = 0; i < function_->piece_count(); ++i) {
    const double from = function_->piece_start(i), to = function_->piece_start(i + 1);
    const CamDerivatives begin = function_->piece_value(i, from), end = function_->piece_value(i, to);
    const double middle = function_->piece_value(i, 0.5 * (from + to)).third;
    look_at(begin, found);
    look_at(end, found);
    if (std::abs(middle - begin.third) <= kRounding * std::abs(begin.third) &&
        std::abs(middle - end.third) <= kRounding * std::abs(end.third)) {
      const double flat = begin.third != 0.0 ? from - begin.second / begin.third : from;
      if (flat > from && flat < to) look_at(function_->piece_value(i, flat), found);
      continue;
    }
    for (int k = 1; k < kSamples; ++k)
      look_at(function_->piece_value(i, from + (to - from) * k / kSamples), found);
  }
  return found;
}

}  // namespace lockstep::linmot
