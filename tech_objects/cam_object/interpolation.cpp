#include "tech_objects/cam_object/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

constexpr double kLargest = 1.0e12;     // magnitude of everything in the data block
constexpr double kSmallGap = 1.0e-4;    // [leading u] that is closed without a transition
constexpr double kSlopeMatch = 1.0e-6;  // of the slopes at both ends

enum Mode : DINT { linear = 0, cubic = 1, bezier = 2 };

/// Whether two elements are so near that the gap between them is closed. Leading values written with a gap of
/// exactly 1.0E-4 differ by a little more or less as doubles: that counts as 1.0E-4.
bool small_gap(double from, double to) noexcept {
  const double rounding =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(from), std::abs(to));
  return to - from <= kSmallGap + rounding;
}

bool in_range(double value) noexcept {
  return value >= -kLargest && value <= kLargest;  // FALSE for NaN
}

/// What is wrong with the numbers of a segment.
CamFault fault_of(const TO_Cam_Struct_SegmentData& s, std::size_t index) noexcept {
  for (const double value : {s.xmin, s.xmax, s.a0, s.a1, s.a2, s.a3, s.a4, s.a5, s.a6, s.sineAmplitude,
                             s.sinePeriod, s.sinePhase, s.Origin})
    if (!in_range(value)) return {CamFault::Reason::number, true, index, value};
  if (!(s.xmin < s.xmax)) return {CamFault::Reason::order, true, index, s.xmax, s.xmin};
  return {};
}

/// The point a third of the distance from a to b on the line through a with a slope: with it as neighbour a
/// B-spline runs evenly in x and leaves a with that slope.
CamPoint guide(CamPoint a, CamPoint b, double slope) noexcept {
  const double distance = (b.x - a.x) / 3.0;
  return {a.x + distance, a.y + slope * distance};
}

double leg(CamPoint a, CamPoint b) noexcept {
  return (b.y - a.y) / (b.x - a.x);
}

}  // namespace

CamInterpolator::CamInterpolator(std::size_t points) : capacity_(points), spline_(points + 4) {
  points_.reserve(points);
  parts_.reserve(2 * kCamSegments);
  run_.reserve(points + 4);
  other_run_.reserve(points + 4);
}

ErrorId CamFault::error() const noexcept {
  if (reason == Reason::none) return ErrorId::none;
  return reason == Reason::no_element ? ErrorId::cam_empty : ErrorId::cam_elements_wrong;
}

bool CamInterpolator::fail(const CamFault& fault) noexcept {
  fault_ = fault;
  return false;
}

/// The curve fails at a leading value: in the segment there, or behind the point before it.
bool CamInterpolator::fail_at(double leading_value) noexcept {
  fault_ = {CamFault::Reason::not_held, false, points_.empty() ? 0 : points_.front().index, leading_value};
  for (const Point& point : points_)
    if (point.at.x <= leading_value) fault_.element = point.index;
  for (const Part& part : parts_) {
    if (leading_value < part.from || leading_value > part.to) continue;
    fault_.segment = true;
    fault_.element = part.index;
  }
  return false;
}

ErrorId CamInterpolator::interpolate(const CamElements& elements, CamFunction& function) noexcept {
  CamBuilder{function};  // empty until it is built
  fault_ = {};
  points_.clear();
  parts_.clear();
  make(elements, function);
  return fault_.error();
}

bool CamInterpolator::make(const CamElements& elements, CamFunction& function) noexcept {
  const auto& settings = elements.InterpolationSettings;
  if (settings.InterpolationMode < linear || settings.InterpolationMode > bezier ||
      settings.BoundaryConditions < 0 || settings.BoundaryConditions > 1)
    return fail({.reason = CamFault::Reason::settings});
  if (!collect_points(elements) || !collect_parts(elements)) return false;
  if (points_.empty() && parts_.empty()) return fail({.reason = CamFault::Reason::no_element});
  close_small_gaps();
  drop_points_in_parts();
  if (!shift_parts(elements)) return false;
  if (parts_.empty() && points_.size() < 2)
    return fail({CamFault::Reason::one_leading_value, false, points_[0].index, points_[0].at.x});
  return build(settings, function);
}

/// The valid points ascending by leading value; of equal ones the last.
bool CamInterpolator::collect_points(const CamElements& elements) noexcept {
  for (std::size_t i = 0; i < elements.Point.size(); ++i) {
    if (!elements.ValidPoint[i]) continue;
    const auto& point = elements.Point[i];
    for (const double value : {point.x, point.y})
      if (!in_range(value)) return fail({CamFault::Reason::number, false, i, value});
    if (points_.size() == capacity_) return fail({CamFault::Reason::too_many_points, false, i});
    points_.push_back({{point.x, point.y}, static_cast<std::uint32_t>(i)});
  }
  const auto before = [](const Point& a, const Point& b) {
    return a.at.x < b.at.x || (a.at.x == b.at.x && a.index < b.index);
  };
  if (!std::is_sorted(points_.begin(), points_.end(), before))
    std::sort(points_.begin(), points_.end(), before);
  auto last = points_.begin();  // of those that stay
  for (const Point& point : points_) {
    if (point.at.x != last->at.x) ++last;
    *last = point;
  }
  if (last != points_.end()) points_.erase(last + 1, points_.end());
  return true;
}

/// The stretches that segments fill, after overlaps.
bool CamInterpolator::collect_parts(const CamElements& elements) noexcept {
  if (elements.Segment.size() > kCamSegments)
    return fail({CamFault::Reason::too_many_segments, true, kCamSegments});
  double edges[2 * kCamSegments];
  std::size_t edge_count = 0;
  for (std::size_t i = 0; i < elements.Segment.size(); ++i) {
    if (!elements.ValidSegment[i]) continue;
    if (const CamFault fault = fault_of(elements.Segment[i], i); fault.reason != CamFault::Reason::none)
      return fail(fault);
    edges[edge_count++] = elements.Segment[i].xmin;
    edges[edge_count++] = elements.Segment[i].xmax;
  }
  std::sort(edges, edges + edge_count);
  edge_count = static_cast<std::size_t>(std::unique(edges, edges + edge_count) - edges);
  for (std::size_t e = 0; e + 1 < edge_count; ++e) {
    std::optional<std::size_t> best;  // the one that begins last, of equals the last in the data block
    for (std::size_t i = 0; i < elements.Segment.size(); ++i) {
      const auto& segment = elements.Segment[i];
      if (!elements.ValidSegment[i] || segment.xmin > edges[e] || segment.xmax < edges[e + 1]) continue;
      if (!best || segment.xmin >= elements.Segment[*best].xmin) best = i;
    }
    if (!best) continue;
    if (parts_.empty() || parts_.back().index != *best || parts_.back().to != edges[e]) {
      parts_.emplace_back();
      parts_.back().from = edges[e];
      parts_.back().index = *best;
    }
    parts_.back().to = edges[e + 1];
  }
  return true;
}

void CamInterpolator::close_small_gaps() noexcept {
  for (std::size_t i = 0; i + 1 < parts_.size(); ++i)
    if (small_gap(parts_[i].to, parts_[i + 1].from)) parts_[i].to = parts_[i + 1].from;
}

/// Points on a segment or as near to one as a small gap do not count, but the ends of the cam stay.
void CamInterpolator::drop_points_in_parts() noexcept {
  if (parts_.empty() || points_.empty()) return;
  const double first = points_.front().at.x;
  const double last = points_.back().at.x;
  std::size_t part = 0;
  const auto covered = [&](const Point& point) {
    while (part < parts_.size() && !small_gap(parts_[part].to, point.at.x)) ++part;
    return part < parts_.size() && small_gap(point.at.x, parts_[part].from);
  };
  std::erase_if(points_, covered);
  if (first < parts_.front().from && !head()) parts_.front().from = first;
  if (last > parts_.back().to && !tail()) parts_.back().to = last;
}

bool CamInterpolator::shift_parts(const CamElements& elements) noexcept {
  constexpr double kTurn = 6.283185307179586;
  CamFault fault{CamFault::Reason::periods, true};  // if there are too many of them
  for (Part& part : parts_) {
    part.segment = shifted(elements.Segment[part.index], part.from);
    part.at_from = part.segment.value(0.0);
    part.at_to = part.segment.value(part.to - part.from);
    const double periods = std::abs(part.segment.frequency) * (part.to - part.from) / kTurn;
    fault.value += periods;
    if (periods <= fault.other) continue;
    fault.other = periods;
    fault.element = part.index;
  }
  return fault.value <= CamBuilder::kMaxPeriods || fail(fault);
}

bool CamInterpolator::head() const noexcept {
  return !points_.empty() && points_.front().at.x < parts_.front().from;
}

bool CamInterpolator::tail() const noexcept {
  return !points_.empty() && points_.back().at.x > parts_.back().to;
}

bool CamInterpolator::build(const TO_Cam_Struct_InterpolationSettings& settings,
                            CamFunction& function) noexcept {
  const DINT mode = settings.InterpolationMode;
  closed_ = settings.BoundaryConditions == 1 && mode != linear;
  free_end_slope_.reset();
  if (closed_ && !parts_.empty() && !find_end_slopes()) return false;
  CamBuilder cam(function);
  for (std::size_t gap = 0; gap <= parts_.size(); ++gap) {
    fill_run(gap);
    if (run_.size() > 1 && run_.front().x < run_.back().x) close_gap(cam, gap, mode);
    if (gap < parts_.size()) cam.add_segment(parts_[gap].segment, parts_[gap].to - parts_[gap].from);
  }
  const bool ends_in_point = parts_.empty() || tail();
  const double end = ends_in_point ? points_.back().at.x : parts_.back().to;
  const double value = ends_in_point ? points_.back().at.y : parts_.back().at_to.position;
  return cam.finish(end, value) || fail_at(cam.failed_at());
}

/// With equal slopes wanted at both ends of a cam with segments: the slope a free end takes, where it does
/// not come out of closing the gaps.
bool CamInterpolator::find_end_slopes() noexcept {
  const double start_slope = parts_.front().at_from.first_derivative;
  const double end_slope = parts_.back().at_to.first_derivative;
  if (head() && tail()) {  // for Bézier splines; a cubic spline goes on across the ends
    fill_run(0);
    const double first = leg(run_[0], run_[1]);
    fill_run(parts_.size());
    free_end_slope_ = 0.5 * (first + leg(run_[run_.size() - 2], run_.back()));
    return true;
  }
  if (head()) free_end_slope_ = end_slope;
  if (tail()) free_end_slope_ = start_slope;
  if (head() || tail()) return true;
  const double mean = (parts_.back().at_to.position - parts_.front().at_from.position) /
                      (parts_.back().to - parts_.front().from);
  const double tolerance = kSlopeMatch * (std::abs(start_slope) + std::abs(end_slope) + std::abs(mean));
  if (std::abs(end_slope - start_slope) <= tolerance) return true;
  return fail({CamFault::Reason::end_slopes, true, parts_.back().index, end_slope, start_slope});
}

/// Fills run_ with the end of the segment before a gap, the points in it, and the start of the segment
/// behind.
void CamInterpolator::fill_run(std::size_t gap) noexcept {
  run_.clear();
  auto first = points_.begin();
  auto last = points_.end();
  const auto before = [](const Point& point, double x) { return point.at.x < x; };
  if (gap > 0) {
    run_.push_back({parts_[gap - 1].to, parts_[gap - 1].at_to.position});
    first = std::lower_bound(first, last, parts_[gap - 1].to, before);
  }
  if (gap < parts_.size()) last = std::lower_bound(first, last, parts_[gap].from, before);
  for (auto point = first; point != last; ++point) run_.push_back(point->at);
  if (gap < parts_.size()) run_.push_back({parts_[gap].from, parts_[gap].at_from.position});
}

std::optional<double> CamInterpolator::left_slope(std::size_t gap) const noexcept {
  if (gap > 0) return parts_[gap - 1].at_to.first_derivative;
  return free_end_slope_;
}

std::optional<double> CamInterpolator::right_slope(std::size_t gap) const noexcept {
  if (gap < parts_.size()) return parts_[gap].at_from.first_derivative;
  return free_end_slope_;
}

void CamInterpolator::close_gap(CamBuilder& cam, std::size_t gap, DINT mode) noexcept {
  if (mode == cubic) return close_cubic(cam, gap);
  if (mode == bezier) return close_bezier(cam, gap);
  for (std::size_t i = 0; i + 1 < run_.size(); ++i)
    cam.add_cubic(run_[i].x, run_[i].y, leg(run_[i], run_[i + 1]), 0.0, 0.0);
}

void CamInterpolator::close_cubic(CamBuilder& cam, std::size_t gap) noexcept {
  const bool at_an_end = gap == 0 || gap == parts_.size();
  if (closed_ && parts_.empty()) return add_spline(cam, run_, spline_.closed_through(run_));
  if (!(closed_ && at_an_end && head() && tail()))
    return add_spline(cam, run_, spline_.through(run_, left_slope(gap), right_slope(gap)));
  // Both ends are free: one spline from the last segment over the end of the cam, which is its start, to the
  // first segment.
  other_run_.assign(run_.begin(), run_.end());
  fill_run(gap == 0 ? parts_.size() : 0);
  std::span<const CamPoint> last_run = run_;
  std::span<const CamPoint> first_run = other_run_;
  if (gap != 0) std::swap(last_run, first_run);
  const auto moments = spline_.through(last_run, first_run, parts_.back().at_to.first_derivative,
                                       parts_.front().at_from.first_derivative);
  if (gap == 0)
    add_spline(cam, first_run, moments.subspan(last_run.size() - 1));
  else
    add_spline(cam, last_run, moments.first(last_run.size()));
}

void CamInterpolator::close_bezier(CamBuilder& cam, std::size_t gap) noexcept {
  if (parts_.empty()) {
    if (closed_) level_end_legs();
    return add_b_spline(cam, run_);
  }
  const auto left = left_slope(gap);
  const auto right = right_slope(gap);
  const CamPoint from_left = left ? guide(run_[0], run_[1], *left) : CamPoint{};
  const CamPoint from_right = right ? guide(run_.back(), run_[run_.size() - 2], *right) : CamPoint{};
  if (right) run_.insert(run_.end() - 1, from_right);
  if (left) run_.insert(run_.begin() + 1, from_left);
  add_b_spline(cam, run_);
}

/// Gives the first and the last leg of a cam of points their mean slope.
void CamInterpolator::level_end_legs() noexcept {
  const std::size_t last = run_.size() - 1;
  if (last < 2) return;  // one leg
  double slope = 0.5 * (leg(run_[0], run_[1]) + leg(run_[last - 1], run_[last]));
  if (last == 2) slope = leg(run_[0], run_[2]);
  run_[1].y = run_[0].y + slope * (run_[1].x - run_[0].x);
  run_[last - 1].y = run_[last].y - slope * (run_[last].x - run_[last - 1].x);
}

TO_Cam_Struct_StatusCam status_of(const CamElements& elements, const CamFunction& function) noexcept {
  return {function.start_leading_value(), function.end_leading_value(),
          static_cast<DINT>(std::ranges::count(elements.ValidPoint, true)),
          static_cast<DINT>(std::ranges::count(elements.ValidSegment, true))};
}

}  // namespace lockstep
