// Transitions by a motion law: what they connect, which law, its parameters.
#include <cmath>
#include <limits>

#include "tech_objects/cam_design/design_parts.hpp"

namespace lockstep {
namespace {

/// A derivative below this part of stroke / length^order is a rounding: the task would be another.
constexpr double kStrokeRounding = 1.0e-8;

std::string_view continuity_name(Continuity continuity) {
  constexpr std::string_view kNames[] = {"nothing", "position", "velocity", "acceleration", "jerk"};
  return kNames[static_cast<std::size_t>(continuity)];
}

/// The motion of an element at an end, freed of what is a rounding.
MotionBoundary motion_beside(MotionBoundary end, const BuiltElement& element) {
  const double length = element.at_end.x - element.at_start.x;
  if (!(length > 0.0)) return end;
  double scale = kStrokeRounding * element.stroke;
  for (std::optional<double>* derivative : {&end.velocity, &end.acceleration, &end.jerk}) {
    scale /= length;
    if (std::abs(**derivative) <= scale) *derivative = 0.0;
  }
  return end;
}

/// A boundary with what a polynomial is to take over.
MotionBoundary up_to(MotionBoundary end, Continuity continuity) {
  if (continuity < Continuity::jerk) end.jerk.reset();
  if (continuity < Continuity::acceleration) end.acceleration.reset();
  if (continuity < Continuity::velocity) end.velocity.reset();
  return end;
}

/// One transition in the making.
class TransitionMaker {
 public:
  TransitionMaker(const CamTransition& transition, const CamDesign& design, CamReport& report,
                  CamStretch& stretch)
      : transition_(transition), design_(design), report_(report), stretch_(stretch) {}

  bool make(MotionLaw& law) {
    if (!parameters_fit() || !find_continuity()) return false;
    if (transition_.law) return make_named(*transition_.law, law);
    return make_best(law);
  }

 private:
  bool parameters_fit() {
    const CamTransition& t = transition_;
    bool good = report_.in_range("lambda", t.lambda) & report_.in_range("lambda_at", t.lambda_at) &
                report_.in_range("ca", t.ca) & report_.in_range("ca_star", t.ca_star) &
                report_.in_range("tolerance", t.tolerance);
    good &= report_.count("count", t.count, kCam10kPoints);
    if (t.lambda && t.lambda_at) {
      report_.problem("lambda_at", "is not allowed beside lambda");
      good = false;
    }
    for (const auto& [field, value] : {std::pair{"ca", t.ca}, {"ca_star", t.ca_star}})
      if (value && !(*value > 0.0)) {
        report_.problem(field, number_text(*value) + " is not allowed here; allowed: a number above 0");
        good = false;
      }
    if (t.lambda) lambda_ = t.lambda;
    if (t.lambda_at) lambda_ = (*t.lambda_at - stretch_.from) / (stretch_.to - stretch_.from);
    if (lambda_ && !(*lambda_ > 0.0 && *lambda_ < 1.0)) {
      report_.problem(t.lambda ? "lambda" : "lambda_at",
                      "the inflection point has to lie within the transition, from " +
                          number_text(stretch_.from) + " to " + number_text(stretch_.to));
      good = false;
    }
    return good;
  }

  bool find_continuity() {
    Applicability usual{Continuity::acceleration, Continuity::acceleration};
    if (transition_.law) {
      const Applicability kept = applicability(*transition_.law, stretch_.start_task, stretch_.end_task);
      usual = {std::min(kept.start, Continuity::acceleration), std::min(kept.end, Continuity::acceleration)};
    }
    const auto wanted = [&](const std::optional<Continuity>& own, Continuity law) {
      return own ? *own : design_.continuity.value_or(law);
    };
    stretch_.start_continuity = wanted(transition_.start_continuity, usual.start);
    stretch_.end_continuity = wanted(transition_.end_continuity, usual.end);
    if (stretch_.start_continuity != Continuity::jerk || stretch_.end_continuity != Continuity::jerk)
      return true;
    report_.problem("", "the jerk can be continuous at one end only");
    return false;
  }

  bool keeps(MotionLawKind kind) const {
    const Applicability kept = applicability(kind, stretch_.start_task, stretch_.end_task);
    return kept.start != Continuity::not_applicable && kept.start >= stretch_.start_continuity &&
           kept.end >= stretch_.end_continuity;
  }

  MotionLawError try_law(MotionLawKind kind, MotionLaw& law) const {
    MotionLawRequest request{kind,    stretch_.at_start, stretch_.at_end,
                             lambda_, transition_.ca,    transition_.ca_star};
    if (kind == MotionLawKind::polynomial) {
      request.start = up_to(request.start, stretch_.start_continuity);
      request.end = up_to(request.end, stretch_.end_continuity);
    } else {
      request.start.jerk.reset();
      request.end.jerk.reset();
    }
    const bool kinks =
        stretch_.start_continuity == Continuity::position || stretch_.end_continuity == Continuity::position;
    if (kind == MotionLawKind::line && kinks) {  // a line need not have the slopes beside it then
      request.start = up_to(request.start, Continuity::position);
      request.end = up_to(request.end, Continuity::position);
    }
    return MotionLaw::make(request, law);
  }

  bool make_named(MotionLawKind kind, MotionLaw& law) {
    stretch_.kind = kind;
    const std::string name = "the law '" + std::string(motion_law_name(kind)) + "'";
    if (!keeps(kind)) {
      const Applicability kept = applicability(kind, stretch_.start_task, stretch_.end_task);
      std::string text = name + " does not serve " + pair();
      if (kept.start != Continuity::not_applicable)
        text = name + " keeps " + std::string(continuity_name(kept.start)) + " at the start and " +
               std::string(continuity_name(kept.end)) + " at the end of " + pair() + "; required are " +
               std::string(continuity_name(stretch_.start_continuity)) + " and " +
               std::string(continuity_name(stretch_.end_continuity));
      report_.problem("law", text + "; allowed: " + allowed());
      return false;
    }
    const MotionLawError error = try_law(kind, law);
    if (error == MotionLawError::none) return true;
    report_.problem(error == MotionLawError::parameter ? parameter_field() : "law", name + explain(error));
    return false;
  }

  /// With a goal the law with the minimum peak, without one the polynomial.
  bool make_best(MotionLaw& law) {
    const CamGoal goal = transition_.goal.value_or(design_.goal);
    if (goal == CamGoal::none) return make_named(MotionLawKind::polynomial, law);
    double best = std::numeric_limits<double>::infinity();
    bool found = false;
    for (std::size_t i = 0; i < kMotionLaws; ++i) {
      const auto kind = static_cast<MotionLawKind>(i);
      MotionLaw candidate;
      if (!keeps(kind) || try_law(kind, candidate) != MotionLawError::none) continue;
      const MotionPeaks peaks = candidate.peaks();
      const double acceleration = std::max(peaks.acceleration, peaks.deceleration);
      const double peak = goal == CamGoal::velocity       ? peaks.velocity
                          : goal == CamGoal::acceleration ? acceleration
                          : goal == CamGoal::jerk         ? peaks.jerk
                                                          : peaks.torque;
      if (found && !(peak < best)) continue;
      best = peak;
      found = true;
      stretch_.kind = kind;
      law = candidate;
    }
    if (!found) report_.problem("", "no law serves " + pair() + " with these parameters");
    return found;
  }

  std::string pair() const {
    return std::string("a transition ") + task_letter(stretch_.start_task) + "-" +
           task_letter(stretch_.end_task);
  }

  std::string allowed() const {
    std::string names;
    for (std::size_t i = 0; i < kMotionLaws; ++i)
      if (keeps(static_cast<MotionLawKind>(i)))
        names += (names.empty() ? "" : ", ") + std::string(motion_law_name(static_cast<MotionLawKind>(i)));
    return names;
  }

  std::string_view parameter_field() const {
    if (transition_.lambda) return "lambda";
    if (transition_.lambda_at) return "lambda_at";
    return transition_.ca ? "ca" : "ca_star";
  }

  static std::string explain(MotionLawError error) {
    switch (error) {
      case MotionLawError::boundary:
        return " needs slopes at both ends that are its own; with the continuity 'position' it may have "
               "kinks";
      case MotionLawError::parameter:
        return " does not have this parameter, or cannot meet its value here";
      default:
        return " cannot be formed here: its numbers are beyond all bounds";
    }
  }

  const CamTransition& transition_;
  const CamDesign& design_;
  CamReport& report_;
  CamStretch& stretch_;
  std::optional<double> lambda_;
};

}  // namespace

bool build_transition(const CamTransition& transition, const CamDesign& design, const BuiltElement& left,
                      const BuiltElement& right, CamReport& report, CamStretch& stretch,
                      BuiltElement& built) {
  stretch.at_start = motion_beside(left.at_end, left);
  stretch.at_end = motion_beside(right.at_start, right);
  stretch.from = stretch.at_start.x;
  stretch.to = stretch.at_end.x;
  if (!(stretch.from < stretch.to)) {
    report.problem("", "there is no room for a transition: both elements meet at " + number_text(stretch.to));
    return false;
  }
  for (const MotionBoundary* end : {&stretch.at_start, &stretch.at_end})
    if (!std::isfinite(*end->velocity + *end->acceleration + *end->jerk)) {
      report.problem("", "the slope of the element at " + number_text(end->x) +
                             " is infinite; leave out the end of its domain");
      return false;
    }
  stretch.start_task = motion_task(*stretch.at_start.velocity, *stretch.at_start.acceleration);
  stretch.end_task = motion_task(*stretch.at_end.velocity, *stretch.at_end.acceleration);
  stretch.tolerance = transition.tolerance;
  MotionLaw law;
  if (!TransitionMaker(transition, design, report, stretch).make(law)) return false;
  stretch.law = law;
  built.curve = [law](double x) { return law.value(x); };
  if (law.becomes_points()) {
    built.points.resize(transition.count);
    law.points(built.points);
  } else {
    built.segments.resize(2 * MotionLaw::kMaxPieces);
    built.segments.resize(law.segments(built.segments));
  }
  return true;
}

}  // namespace lockstep
