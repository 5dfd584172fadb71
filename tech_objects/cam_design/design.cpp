#include "tech_objects/cam_design/design.hpp"

#include <charconv>
#include <cmath>

#include "tech_objects/cam/segment.hpp"
#include "tech_objects/cam_design/design_parts.hpp"
#include "tech_objects/cam_design/findings.hpp"
#include "tech_objects/cam_object/interpolation.hpp"

namespace lockstep {
namespace {

constexpr double kLargest = 1.0e12;  // magnitude of everything in the data block
/// Part of the stroke, or of a hundredth of the following value, by which the ends of a segment may miss its
/// curve once its coefficients are rounded.
constexpr double kResolution = 1.0e-6;

bool finite_and_in_range(double value) {
  return value >= -kLargest && value <= kLargest;  // FALSE for NaN
}

/// A design in the making.
class Designer {
 public:
  Designer(const CamDesign& design, std::size_t capacity)
      : design_(design), capacity_(capacity), report_(cam_) {
    cam_.interpolation = design.interpolation;
  }

  DesignedCam make() {
    build_elements();
    if (cam_.problems.empty()) build_transitions();
    if (cam_.problems.empty()) collect();
    if (cam_.problems.empty()) check_numbers();
    if (cam_.problems.empty()) finish();
    return std::move(cam_);
  }

 private:
  void build_elements() {
    if (design_.elements.empty()) report_.problem("", "the cam has no element");
    built_.resize(design_.elements.size());
    const BuiltElement* before = nullptr;
    for (std::size_t i = 0; i < built_.size(); ++i) {
      report_.look_at(i, false);
      if (!build_element(design_.elements[i].shape, report_, built_[i])) continue;
      if (before != nullptr && !follows(*before, built_[i]))
        report_.problem("", "begins at " + number_text(built_[i].at_start.x) +
                                ", before or at the end of the " + "element before it, at " +
                                number_text(before->at_end.x));
      before = &built_[i];
    }
    if (!design_.elements.empty() && design_.elements.back().transition) {
      report_.look_at(design_.elements.size() - 1, true);
      report_.problem("", "a transition needs an element behind it");
    }
  }

  static bool is_point(const BuiltElement& element) { return !element.curve; }

  /// Elements may meet; two points may not, as the second would replace the first.
  static bool follows(const BuiltElement& before, const BuiltElement& element) {
    if (is_point(before) && is_point(element)) return before.at_end.x < element.at_start.x;
    return before.at_end.x <= element.at_start.x;
  }

  void build_transitions() {
    for (std::size_t i = 0; i + 1 < built_.size(); ++i) {
      if (!design_.elements[i].transition) continue;
      report_.look_at(i, true);
      transitions_.emplace_back();
      Transition& transition = transitions_.back();
      transition.stretch.element = i;
      transition.stretch.transition = true;
      build_transition(*design_.elements[i].transition, design_, built_[i], built_[i + 1], report_,
                       transition.stretch, transition.built);
    }
  }

  /// The elements and transitions in their order, with what each takes of the data block.
  void collect() {
    auto transition = transitions_.begin();
    bool behind_law = false;
    for (std::size_t i = 0; i < built_.size(); ++i) {
      const bool before_law = transition != transitions_.end() && transition->stretch.element == i;
      BuiltElement& element = built_[i];
      // A point at a law, and the first of an inverse sine behind one, are the end of that law.
      if (is_point(element) && (behind_law || before_law)) element.points.clear();
      if (behind_law && std::holds_alternative<CamInverseSine>(design_.elements[i].shape))
        element.points.erase(element.points.begin());
      CamStretch stretch;
      stretch.element = i;
      stretch.from = element.at_start.x;
      stretch.to = element.at_end.x;
      stretch.at_start = element.at_start;
      stretch.at_end = element.at_end;
      stretch.tolerance = tolerance_of(design_.elements[i].shape);
      take(stretch, element);
      if (before_law) {
        take(transition->stretch, transition->built);
        ++transition;
      }
      behind_law = before_law;
    }
  }

  static std::optional<double> tolerance_of(const CamShape& shape) {
    if (const auto* group = std::get_if<CamPointGroup>(&shape)) return group->tolerance;
    if (const auto* inverse = std::get_if<CamInverseSine>(&shape)) return inverse->tolerance;
    return std::nullopt;
  }

  void take(CamStretch& stretch, const BuiltElement& built) {
    stretch.curve = built.curve;
    stretch.points = built.points.size();
    stretch.segments = built.segments.size();
    cam_.points.insert(cam_.points.end(), built.points.begin(), built.points.end());
    cam_.segments.insert(cam_.segments.end(), built.segments.begin(), built.segments.end());
    cam_.stretches.push_back(stretch);
    check_resolution(stretch, built);
  }

  /// Far from leading value 0 the coefficients of a short segment cancel in their sum: what is lost in their
  /// rounding must not become a step.
  void check_resolution(const CamStretch& stretch, const BuiltElement& built) {
    report_.look_at(stretch.element, stretch.transition);
    double worst = 0.0;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const TO_Cam_Struct_SegmentData& segment : built.segments) {
      const CamSegment local = shifted(segment, segment.xmin);
      for (const double x : {segment.xmin, segment.xmax}) {
        const double y = built.curve(x).position;
        worst = std::max(worst, std::abs(local.value(x - segment.xmin).position - y));
        lowest = std::min(lowest, y);
        highest = std::max(highest, y);
      }
    }
    const double scale = std::max({highest - lowest, built.stroke, 0.01 * std::abs(highest)});
    if (built.segments.empty() || worst <= kResolution * scale) return;
    report_.problem("",
                    "the coefficients of its segments, which belong to leading value 0, cannot hold the "
                    "curve there: it would be missed by " +
                        number_text(worst) + "; begin the cam nearer to leading value 0");
  }

  /// What is computed has to fit the data block as well.
  void check_numbers() {
    std::size_t points = 0, segments = 0;
    for (const CamStretch& stretch : cam_.stretches) {
      report_.look_at(stretch.element, stretch.transition);
      bool good = true;
      for (std::size_t k = 0; k < stretch.points; ++k, ++points)
        good &= finite_and_in_range(cam_.points[points].x) && finite_and_in_range(cam_.points[points].y);
      for (std::size_t k = 0; k < stretch.segments; ++k, ++segments) {
        const auto& s = cam_.segments[segments];
        for (const double value : {s.xmin, s.xmax, s.a0, s.a1, s.a2, s.a3, s.a4, s.a5, s.a6, s.sineAmplitude,
                                   s.sinePeriod, s.sinePhase})
          good &= finite_and_in_range(value);
        good &= s.xmin < s.xmax;
      }
      if (!good)
        report_.problem("", "its points or coefficients are beyond what the data block holds, -1e12 to 1e12");
    }
  }

  void finish() {
    DesignedCam flat =
        interpolated_cam(std::move(cam_.points), std::move(cam_.segments), design_.interpolation, capacity_);
    cam_.points = std::move(flat.points);
    cam_.segments = std::move(flat.segments);
    for (const CamFinding& problem : flat.problems) cam_.problems.push_back(of_design(problem));
    for (const CamFinding& warning : flat.warnings) cam_.warnings.push_back(of_design(warning));
    cam_.function = std::move(flat.function);
    if (!cam_.function) return;
    for (CamStretch& stretch : cam_.stretches) compare(stretch);
  }

  /// A finding about a point or a segment, at the element or the transition that it comes from.
  CamFinding of_design(const CamFinding& flat) const {
    std::size_t left = flat.element;
    for (const CamStretch& stretch : cam_.stretches) {
      const std::size_t count = flat.transition ? stretch.segments : stretch.points;
      if (left < count) return {stretch.element, stretch.transition, "", flat.text};
      left -= count;
    }
    return {CamFinding::kWhole, false, "", flat.text};
  }

  /// How far the finished cam is from a curve, and whether that is too far.
  void compare(CamStretch& stretch) {
    if (!stretch.curve) return;
    constexpr int kSamples = 2000;
    CamHint hint;
    for (int k = 0; k < kSamples; ++k) {  // the end belongs to what follows, which may begin elsewhere
      const double x = stretch.from + (stretch.to - stretch.from) * k / kSamples;
      const double distance = cam_.function->value(x, hint).position - stretch.curve(x).position;
      stretch.deviation = std::max(stretch.deviation, std::abs(distance));
    }
    if (!stretch.tolerance || stretch.deviation <= *stretch.tolerance) return;
    report_.look_at(stretch.element, stretch.transition);
    report_.warning("tolerance", "the cam deviates from the curve by " + number_text(stretch.deviation) +
                                     "; allowed are " + number_text(*stretch.tolerance) +
                                     "; more interpolation points bring it nearer");
  }

  struct Transition {
    CamStretch stretch;
    BuiltElement built;
  };

  const CamDesign& design_;
  std::size_t capacity_;
  DesignedCam cam_;
  CamReport report_;
  std::vector<BuiltElement> built_;
  std::vector<Transition> transitions_;
};

}  // namespace

std::string number_text(double value) {
  char buffer[40];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), value);
  return {std::begin(buffer), end};
}

bool CamReport::in_range(std::string_view field, std::optional<double> value) {
  if (!value || finite_and_in_range(*value)) return true;
  problem(field, number_text(*value) + " is not allowed here; allowed: a number from -1e12 to 1e12");
  return false;
}

bool CamReport::ascending(double start, double end) {
  if (start < end) return true;
  problem("end", number_text(end) + " is not above the start, " + number_text(start));
  return false;
}

bool CamReport::count(std::string_view field, std::size_t value, std::size_t maximum) {
  if (value >= 2 && value <= maximum) return true;
  problem(field, std::to_string(value) + " is not allowed here; allowed: 2 to " + std::to_string(maximum));
  return false;
}

std::string_view cam_shape_name(const CamShape& shape) noexcept {
  constexpr std::string_view kNames[] = {"point", "point group", "line",
                                         "sine",  "polynomial",  "inverse sine"};
  return kNames[shape.index()];
}

ErrorId interpolate_all(std::span<const TO_Cam_Struct_PointData> points,
                        std::span<const TO_Cam_Struct_SegmentData> segments,
                        const TO_Cam_Struct_InterpolationSettings& settings, CamFunction& function,
                        CamFindings* findings) {
  const std::size_t maximum = std::max(points.size(), segments.size());
  const std::unique_ptr<BOOL[]> valid(new BOOL[maximum]);
  std::fill_n(valid.get(), maximum, true);
  const CamElements elements{
      points, {valid.get(), points.size()}, segments, {valid.get(), segments.size()}, settings};
  CamInterpolator interpolator(points.size());
  const ErrorId error = interpolator.interpolate(elements, function);
  if (findings != nullptr) *findings = findings_of(elements, interpolator, function);
  return error;
}

DesignedCam design_cam(const CamDesign& design, std::size_t capacity) {
  return Designer(design, capacity).make();
}

DesignedCam checked_cam(std::vector<TO_Cam_Struct_PointData> points,
                        std::vector<TO_Cam_Struct_SegmentData> segments,
                        const TO_Cam_Struct_InterpolationSettings& interpolation, std::size_t capacity) {
  DesignedCam cam;
  cam.points = std::move(points);
  cam.segments = std::move(segments);
  cam.interpolation = interpolation;
  CamReport report(cam);
  for (std::size_t i = 0; i < cam.points.size(); ++i) {
    report.look_at(i, false);
    report.in_range("x", cam.points[i].x);
    report.in_range("y", cam.points[i].y);
  }
  for (std::size_t i = 0; i < cam.segments.size(); ++i) {
    const auto& s = cam.segments[i];
    report.look_at(i, true);
    const std::pair<std::string_view, double> values[] = {{"xmin", s.xmin},
                                                          {"xmax", s.xmax},
                                                          {"a0", s.a0},
                                                          {"a1", s.a1},
                                                          {"a2", s.a2},
                                                          {"a3", s.a3},
                                                          {"a4", s.a4},
                                                          {"a5", s.a5},
                                                          {"a6", s.a6},
                                                          {"sineAmplitude", s.sineAmplitude},
                                                          {"sinePeriod", s.sinePeriod},
                                                          {"sinePhase", s.sinePhase}};
    bool good = true;
    for (const auto& [field, value] : values) good &= report.in_range(field, value);
    if (good && !(s.xmin < s.xmax))
      report.problem("xmax", number_text(s.xmax) + " is not above xmin, " + number_text(s.xmin));
  }
  report.look_at(CamFinding::kWhole, false);
  if (cam.points.size() > capacity)
    report.problem("", "the cam takes " + std::to_string(cam.points.size()) + " points; allowed are " +
                           std::to_string(capacity));
  if (cam.segments.size() > kCamSegments)
    report.problem("", "the cam takes " + std::to_string(cam.segments.size()) + " segments; allowed are " +
                           std::to_string(kCamSegments));
  return cam;
}

DesignedCam interpolated_cam(std::vector<TO_Cam_Struct_PointData> points,
                             std::vector<TO_Cam_Struct_SegmentData> segments,
                             const TO_Cam_Struct_InterpolationSettings& interpolation, std::size_t capacity) {
  DesignedCam cam = checked_cam(std::move(points), std::move(segments), interpolation, capacity);
  if (!cam.problems.empty()) return cam;
  const auto function = std::make_shared<CamFunction>(cam.points.size());
  CamFindings findings;
  const ErrorId error = interpolate_all(cam.points, cam.segments, interpolation, *function, &findings);
  if (error == ErrorId::none) cam.function = function;
  cam.problems = std::move(findings.problems);
  cam.warnings = std::move(findings.warnings);
  return cam;
}

}  // namespace lockstep
