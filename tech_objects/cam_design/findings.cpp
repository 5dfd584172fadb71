#include "tech_objects/cam_design/findings.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/cam_design/design_check.hpp"
#include "tech_objects/cam_design/design_parts.hpp"

namespace lockstep {
namespace {

constexpr double kSameValue = 1.0e-9;  // share of the values or of the length that is no difference

std::string range_text(double from, double to) {
  return "from " + number_text(from) + " to " + number_text(to);
}

std::string text_of(const CamFault& fault) {
  const std::string value = number_text(fault.value);
  switch (fault.reason) {
    case CamFault::Reason::none:
      return "";
    case CamFault::Reason::no_element:
      return "the cam has neither points nor segments";
    case CamFault::Reason::settings:
      return "InterpolationMode or BoundaryConditions is unknown; allowed: 0 to 2, and 0 or 1";
    case CamFault::Reason::number:
      return value + " is not allowed here; allowed: a number from -1e12 to 1e12";
    case CamFault::Reason::order:
      return value + " is not above xmin, " + number_text(fault.other);
    case CamFault::Reason::one_leading_value:
      return value + " is the only leading value, which makes no curve; allowed: two at least, or a segment";
    case CamFault::Reason::periods:
      return "the sines of the cam have " + value + " periods, " + number_text(fault.other) +
             " of them here; allowed: " + number_text(CamBuilder::kMaxPeriods) + " together";
    case CamFault::Reason::end_slopes:
      return "the cam ends here with a slope of " + value + " and begins with one of " +
             number_text(fault.other) +
             "; allowed between segments, with BoundaryConditions 1: slopes that agree within a millionth";
    case CamFault::Reason::too_many_points:
      return "the cam has more points than there is room for";
    case CamFault::Reason::too_many_segments:
      return "the cam has more segments than the " + std::to_string(kCamSegments) + " that are allowed";
    case CamFault::Reason::not_held:
      return "the curve at leading value " + value +
             " has slopes or coefficients that a number cannot hold; allowed: elements farther from one "
             "another, or with smaller values";
  }
  return "";
}

std::string_view field_of(const CamFault& fault) {
  switch (fault.reason) {
    case CamFault::Reason::order:
      return "xmax";
    case CamFault::Reason::periods:
      return "sinePeriod";
    case CamFault::Reason::one_leading_value:
      return "x";
    default:
      return "";
  }
}

/// Looks at the elements of a curve that there is.
class Reader {
 public:
  Reader(const CamElements& elements, const CamInterpolator& interpolator, const CamFunction& function)
      : elements_(elements), interpolator_(interpolator), function_(function) {}

  std::vector<CamFinding> read() {
    look_at_points();
    look_at_segments();
    look_at_range();
    look_at_jumps();
    return std::move(warnings_);
  }

 private:
  void warn(std::size_t element, bool segment, std::string text) {
    warnings_.push_back({element, segment, "", std::move(text)});
  }

  /// The segment that counts at a leading value, or the nearest one.
  const CamInterpolator::Part* part_at(double x) const {
    const auto away = [x](const auto& part) { return std::max({part.from - x, x - part.to, 0.0}); };
    const auto parts = interpolator_.parts();
    const auto nearest = std::ranges::min_element(parts, {}, away);
    return nearest == parts.end() ? nullptr : &*nearest;
  }

  std::string segment_text(std::size_t index) const {
    const auto& segment = elements_.Segment[index];
    return "the segment " + range_text(segment.xmin, segment.xmax);
  }

  void look_at_points() {
    const auto points = interpolator_.points();
    const double scale =
        std::max(std::abs(function_.lowest_following_value()), std::abs(function_.highest_following_value()));
    for (std::size_t i = 0; i < elements_.Point.size(); ++i) {
      if (!elements_.ValidPoint[i]) continue;
      const auto& point = elements_.Point[i];
      const auto counting =
          std::ranges::lower_bound(points, point.x, {}, [](const auto& p) { return p.at.x; });
      const bool there = counting != points.end() && counting->at.x == point.x;
      if (there && counting->index != i)
        warn(i, false,
             "does not count: of the points at leading value " + number_text(point.x) +
                 " the last does, with the following value " + number_text(counting->at.y));
      if (there || std::abs(function_.value(point.x).position - point.y) <= kSameValue * scale) continue;
      warn(i, false,
           "does not count: at leading value " + number_text(point.x) + " " +
               segment_text(part_at(point.x)->index) + " does, with the following value " +
               number_text(function_.value(point.x).position));
    }
  }

  void look_at_segments() {
    const double rounding = kSameValue * (function_.end_leading_value() - function_.start_leading_value());
    for (std::size_t i = 0; i < elements_.Segment.size(); ++i) {
      if (!elements_.ValidSegment[i]) continue;
      const auto& segment = elements_.Segment[i];
      for (const CamInterpolator::Part& part : interpolator_.parts()) {
        const double from = std::max(part.from, segment.xmin);
        const double to = std::min(part.to, segment.xmax);
        if (part.index == i || to - from <= rounding) continue;
        warn(i, true,
             "does not count " + range_text(from, to) + ": there " + segment_text(part.index) +
                 " does, which overlaps it");
      }
    }
  }

  /// Following values that MC_CamIn refuses unscaled.
  void look_at_range() {
    const double lowest = function_.lowest_following_value();
    const double highest = function_.highest_following_value();
    const double maximum = std::abs(lowest) > std::abs(highest) ? lowest : highest;
    if (std::abs(maximum) <= kPositionRange) return;
    const double at = function_.leading_value(maximum, function_.start_leading_value())
                          .value_or(function_.start_leading_value());
    const CamInterpolator::Part* const part = part_at(at);
    const bool in_segment = part != nullptr && at >= part->from && at <= part->to;
    warn(in_segment ? part->index : CamFinding::kWhole, in_segment,
         "the following value reaches " + number_text(maximum) + " at leading value " + number_text(at) +
             ": MC_CamIn refuses the cam with 16#8024 unless SlaveScaling brings it to -1e12 to 1e12");
  }

  /// Elements that meet at one leading value with two following values.
  void look_at_jumps() {
    for (const CamJoint& joint : joints_of(function_, false)) {
      if (joint.keeps != Continuity::not_applicable) continue;
      const CamInterpolator::Part* const part = part_at(joint.x);
      warn(part != nullptr ? part->index : CamFinding::kWhole, part != nullptr,
           step_text(joint) + ": an axis that follows the cam jumps there");
    }
  }

  const CamElements& elements_;
  const CamInterpolator& interpolator_;
  const CamFunction& function_;
  std::vector<CamFinding> warnings_;
};

}  // namespace

CamFindings findings_of(const CamElements& elements, const CamInterpolator& interpolator,
                        const CamFunction& function) {
  const CamFault& fault = interpolator.fault();
  if (fault.reason == CamFault::Reason::none) return {{}, Reader(elements, interpolator, function).read()};
  const bool whole = fault.reason == CamFault::Reason::no_element ||
                     fault.reason == CamFault::Reason::settings ||
                     fault.reason == CamFault::Reason::too_many_points ||
                     fault.reason == CamFault::Reason::too_many_segments;
  const std::size_t element = whole ? CamFinding::kWhole : fault.element;
  return {{{element, fault.segment, field_of(fault), text_of(fault)}}, {}};
}

}  // namespace lockstep
