// The elements of a curve: what they say, as curves, points and segments.
#include <cmath>

#include "tech_objects/cam/sine.hpp"
#include "tech_objects/cam_design/design_parts.hpp"
#include "tech_objects/cam_design/motion_law_segment.hpp"
#include "tech_objects/cam_object/segment_data.hpp"

namespace lockstep {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kDegree = kPi / 180.0;

template <class... T>
int given(const T&... values) {
  return (0 + ... + (values ? 1 : 0));
}

/// A stretch of leading values.
struct Stretch {
  double start, end;
  double length() const noexcept { return end - start; }
};

MotionPiece piece_over(Stretch range) {
  MotionPiece piece;
  piece.start = range.start;
  piece.length = range.length();
  return piece;
}

bool is_range(Stretch range, CamReport& report) {
  const bool numbers = report.in_range("start", range.start) & report.in_range("end", range.end);
  return numbers && report.ascending(range.start, range.end);
}

/// Angular frequency and phase at the start of an element.
std::optional<MotionPiece::Sine> resolved(const CamWave& wave, Stretch range, CamReport& report) {
  bool good = report.in_range("amplitude", wave.amplitude);
  good &= report.in_range("start_phase", wave.start_phase);
  good &= report.in_range("end_phase", wave.end_phase);
  good &= report.in_range("period", wave.period);
  good &= report.in_range("frequency", wave.frequency);
  if (!good) return std::nullopt;
  if (given(wave.start_phase, wave.end_phase, wave.period, wave.frequency) != 2 ||
      (wave.period && wave.frequency)) {
    report.problem(
        "",
        "a sine is given by two of start_phase, end_phase, period and frequency, of which one has to "
        "be a phase");
    return std::nullopt;
  }
  for (const auto& [field, value] : {std::pair{"period", wave.period}, {"frequency", wave.frequency}})
    if (value && !(*value > 0.0)) {
      report.problem(field, number_text(*value) + " is not allowed here; allowed: a number above 0");
      return std::nullopt;
    }
  MotionPiece::Sine sine;
  sine.amplitude = wave.amplitude;
  if (wave.period) sine.frequency = 2.0 * kPi / *wave.period;
  if (wave.frequency) sine.frequency = 2.0 * kPi * *wave.frequency;
  if (wave.start_phase && wave.end_phase)
    sine.frequency = (*wave.end_phase - *wave.start_phase) * kDegree / range.length();
  sine.phase = wave.start_phase ? *wave.start_phase * kDegree
                                : *wave.end_phase * kDegree - sine.frequency * range.length();
  const double periods = std::abs(sine.frequency) * range.length() / (2.0 * kPi);
  if (periods <= 1024.0) return sine;
  report.problem("", "the sine has " + number_text(periods) + " periods; allowed are 1024 in a cam");
  return std::nullopt;
}

/// The end of an element as a boundary, all derivatives given.
MotionBoundary boundary(double x, const MotionValue& value) {
  return {x, value.position, value.velocity, value.acceleration, value.jerk};
}

/// Ends and stroke of an element from its curve.
void measure(Stretch range, BuiltElement& built) {
  built.at_start = boundary(range.start, built.curve(range.start));
  built.at_end = boundary(range.end, built.curve(range.end));
  double lowest = built.at_start.y, highest = built.at_start.y;
  constexpr int kSamples = 256;
  for (int k = 1; k <= kSamples; ++k) {
    const double y = built.curve(range.start + range.length() * k / kSamples).position;
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }
  built.stroke = highest - lowest;
}

void become(const MotionPiece& piece, double end, BuiltElement& built) {
  built.segments = {segment_of(piece)};
  built.segments[0].xmax = end;
  built.curve = [piece](double x) { return piece.value(x - piece.start); };
  measure({piece.start, end}, built);
}

bool build(const CamPointElement& point, CamReport& report, BuiltElement& built) {
  bool good = report.in_range("x", point.x) & report.in_range("y", point.y);
  good &= report.in_range("velocity", point.velocity);
  good &= report.in_range("acceleration", point.acceleration);
  good &= report.in_range("jerk", point.jerk);
  built.at_start = {point.x, point.y, point.velocity.value_or(0.0), point.acceleration.value_or(0.0),
                    point.jerk.value_or(0.0)};
  built.at_end = built.at_start;
  built.points = {{point.x, point.y}};
  return good;
}

bool build(const CamLine& line, CamReport& report, BuiltElement& built) {
  const Stretch range{line.start, line.end};
  bool good = is_range(range, report);
  good &= report.in_range("start_value", line.start_value);
  good &= report.in_range("end_value", line.end_value);
  good &= report.in_range("slope", line.slope);
  if (given(line.start_value, line.end_value, line.slope) != 2) {
    report.problem("", "a line is given by two of start_value, end_value and slope");
    return false;
  }
  if (!good) return false;
  MotionPiece piece = piece_over(range);
  piece.coefficient[1] = line.slope ? *line.slope : (*line.end_value - *line.start_value) / range.length();
  piece.coefficient[0] =
      line.start_value ? *line.start_value : *line.end_value - *line.slope * range.length();
  become(piece, line.end, built);
  return true;
}

bool build(const CamSine& sine, CamReport& report, BuiltElement& built) {
  const Stretch range{sine.start, sine.end};
  bool good = is_range(range, report);
  good &= report.in_range("offset", sine.offset);
  good &= report.in_range("start_offset", sine.start_offset);
  good &= report.in_range("end_offset", sine.end_offset);
  good &= report.in_range("inclination", sine.inclination);
  const int inclined = given(sine.start_offset, sine.end_offset, sine.inclination);
  if (sine.offset ? inclined != 0 : inclined != 2) {
    report.problem("", "a sine lies at an offset, or by two of start_offset, end_offset and inclination");
    good = false;
  }
  if (!good) return false;
  const auto wave = resolved(sine.wave, range, report);
  if (!wave) return false;
  MotionPiece piece = piece_over(range);
  piece.sine[0] = *wave;
  if (sine.offset) {
    piece.coefficient[0] = *sine.offset;
  } else {
    piece.coefficient[1] =
        sine.inclination ? *sine.inclination : (*sine.end_offset - *sine.start_offset) / range.length();
    piece.coefficient[0] =
        sine.start_offset ? *sine.start_offset : *sine.end_offset - *sine.inclination * range.length();
  }
  become(piece, sine.end, built);
  return true;
}

bool build_from_coefficients(const CamPolynomial& polynomial, const MotionPiece& wave, CamReport& report,
                             BuiltElement& built) {
  for (const double coefficient : *polynomial.coefficients)
    if (!report.in_range("coefficients", coefficient)) return false;
  const auto& a = *polynomial.coefficients;
  const CamSegment sine = shifted(segment_of(wave), 0.0);  // as the coefficients: x is the leading value
  const TO_Cam_Struct_SegmentData segment{
      polynomial.start, polynomial.end, a[0],      a[1], a[2], a[3], a[4], a[5], a[6],
      sine.amplitude,   sine.frequency, sine.phase};
  const CamSegment local = shifted(segment, polynomial.start);
  built.segments = {segment};
  built.curve = [local](double x) {
    const double d = x - local.origin;
    return MotionValue{local.derivative(0, d), local.derivative(1, d), local.derivative(2, d),
                       local.derivative(3, d)};
  };
  measure({polynomial.start, polynomial.end}, built);
  return true;
}

/// What a boundary leaves to the polynomial once the sine has its part.
void take_off(MotionBoundary& end, const MotionValue& part) {
  end.y -= part.position;
  if (end.velocity) *end.velocity -= part.velocity;
  if (end.acceleration) *end.acceleration -= part.acceleration;
  if (end.jerk) *end.jerk -= part.jerk;
}

bool build_from_boundaries(const CamPolynomial& p, const MotionPiece& wave, CamReport& report,
                           BuiltElement& built) {
  if (!p.start_value || !p.end_value) {
    report.problem("",
                   "a polynomial is given by its coefficients, or by start_value, end_value and derivatives");
    return false;
  }
  MotionLawRequest request;
  request.start = {p.start, *p.start_value, p.start_velocity, p.start_acceleration, p.start_jerk};
  request.end = {p.end, *p.end_value, p.end_velocity, p.end_acceleration, p.end_jerk};
  take_off(request.start, wave.value(0.0));
  take_off(request.end, wave.value(wave.length));
  request.lambda = p.lambda;
  if (p.lambda_at) request.lambda = (*p.lambda_at - p.start) / (p.end - p.start);
  MotionLaw law;
  const MotionLawError error = MotionLaw::make(request, law);
  if (error == MotionLawError::parameter) {
    const bool inside = *request.lambda > 0.0 && *request.lambda < 1.0;
    report.problem(p.lambda ? "lambda" : "lambda_at",
                   inside ? "a polynomial with lambda needs the velocity at both ends"
                          : "the inflection point has to lie between start and end");
    return false;
  }
  if (error != MotionLawError::none) {
    report.problem("", "no polynomial has these values at its ends; give lower derivatives too");
    return false;
  }
  built.segments.resize(4);
  built.segments.resize(law.segments(built.segments));
  for (TO_Cam_Struct_SegmentData& segment : built.segments) {
    const CamSegment sine = shifted(segment_of(wave), segment.Origin);
    segment.sineAmplitude = sine.amplitude;
    segment.sinePeriod = sine.frequency;
    segment.sinePhase = sine.phase;
  }
  built.curve = [law, wave](double x) {
    MotionValue value = law.value(x);
    const MotionValue part = wave.value(x - wave.start);
    value.position += part.position;
    value.velocity += part.velocity;
    value.acceleration += part.acceleration;
    value.jerk += part.jerk;
    return value;
  };
  measure({p.start, p.end}, built);
  return true;
}

bool build(const CamPolynomial& p, CamReport& report, BuiltElement& built) {
  const Stretch range{p.start, p.end};
  bool good = is_range(range, report);
  const std::pair<std::string_view, std::optional<double>> ends[] = {
      {"start_value", p.start_value},
      {"start_velocity", p.start_velocity},
      {"start_acceleration", p.start_acceleration},
      {"start_jerk", p.start_jerk},
      {"end_value", p.end_value},
      {"end_velocity", p.end_velocity},
      {"end_acceleration", p.end_acceleration},
      {"end_jerk", p.end_jerk},
      {"lambda", p.lambda},
      {"lambda_at", p.lambda_at}};
  for (const auto& [field, value] : ends) {
    good &= report.in_range(field, value);
    if (!value || !p.coefficients) continue;
    report.problem(field, "is not allowed beside coefficients");
    good = false;
  }
  if (p.lambda && p.lambda_at) {
    report.problem("lambda_at", "is not allowed beside lambda");
    good = false;
  }
  if (!good) return false;
  MotionPiece wave = piece_over(range);
  if (p.wave) {
    const auto sine = resolved(*p.wave, range, report);
    if (!sine) return false;
    wave.sine[0] = *sine;
  }
  return p.coefficients ? build_from_coefficients(p, wave, report, built)
                        : build_from_boundaries(p, wave, report, built);
}

/// The arcsine without the C library, whose last digit depends on the processor; -1 ≤ u ≤ 1.
double arcsine(double u) {
  if (u < 0.0) return -arcsine(-u);
  if (u > 0.7) return 0.5 * kPi - 2.0 * arcsine(std::sqrt(0.5 * (1.0 - u)));
  double t = u;
  for (int step = 0; step < 6; ++step) {
    const SineCosine wave = sine_cosine(t);
    t -= (wave.sine - u) / wave.cosine;
  }
  return t;
}

bool build(const CamInverseSine& e, CamReport& report, BuiltElement& built) {
  const Stretch range{e.start, e.end};
  bool good = is_range(range, report) & report.in_range("lowest", e.lowest) &
              report.in_range("highest", e.highest) & report.in_range("tolerance", e.tolerance);
  good &= report.count("count", e.count, kCam10kPoints);
  if (!(e.lowest <= e.highest)) {
    report.problem("highest", number_text(e.highest) + " is below lowest, " + number_text(e.lowest));
    good = false;
  }
  if (!(e.from >= -1.0 && e.from < e.to && e.to <= 1.0)) {
    report.problem("from", "the domain of the arcsine from " + number_text(e.from) + " to " +
                               number_text(e.to) + " is not allowed; allowed: an ascending part of -1 to 1");
    good = false;
  }
  if (!good) return false;
  const double low = arcsine(e.from);
  const double per_radian = (e.mirrored ? -1.0 : 1.0) * (e.highest - e.lowest) / (arcsine(e.to) - low);
  const double rate = (e.to - e.from) / range.length();
  const double begin = e.mirrored ? e.highest : e.lowest;
  built.curve = [=](double x) {
    const double u = std::clamp(e.from + (x - e.start) * rate, e.from, e.to);
    const double cosine = std::sqrt((1.0 - u) * (1.0 + u));  // of the angle: 0 where the slope is infinite
    const double slope = per_radian * rate / cosine;
    const double bend = u * rate / (cosine * cosine);
    return MotionValue{begin + per_radian * (arcsine(u) - low), slope, slope * bend,
                       slope * (rate * rate + 3.0 * cosine * cosine * bend * bend) / (cosine * cosine)};
  };
  for (std::size_t k = 0; k < e.count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(e.count - 1);
    const double x = k + 1 < e.count ? e.start + part * range.length() : e.end;
    built.points.push_back({x, built.curve(x).position});
  }
  measure(range, built);
  return true;
}

/// The points of a group in the units of the cam.
bool resolve(const CamPointGroup& group, CamReport& report, std::vector<TO_Cam_Struct_PointData>& points) {
  bool good = true;
  const auto limits = [&](bool relative, std::string_view low_field, const std::optional<double>& low,
                          std::string_view high_field, const std::optional<double>& high) {
    good &= report.in_range(low_field, low) & report.in_range(high_field, high);
    if (relative ? low && high && *low < *high : !low && !high) return;
    good = false;
    const std::string both = std::string(low_field) + " and " + std::string(high_field);
    report.problem(high ? high_field : "", relative ? "relative values need " + both + ", ascending"
                                                    : both + " are for relative values only");
  };
  limits(group.relative_x, "start", group.start, "end", group.end);
  limits(group.relative_y, "lowest", group.lowest, "highest", group.highest);
  if (!good) return false;
  for (TO_Cam_Struct_PointData point : group.points) {
    for (const auto& [relative, value] : {std::pair{group.relative_x, point.x}, {group.relative_y, point.y}})
      if (!report.in_range("points", value)) {
        return false;
      } else if (relative && !(value >= 0.0 && value <= 1.0)) {
        report.problem("points",
                       "the relative value " + number_text(value) + " is not allowed; allowed: 0 to 1");
        return false;
      }
    if (group.relative_x) point.x = *group.start + point.x * (*group.end - *group.start);
    if (group.relative_y) point.y = *group.lowest + point.y * (*group.highest - *group.lowest);
    if (!points.empty() && !(points.back().x < point.x)) {
      report.problem("points", "the leading values have to ascend; " + number_text(point.x) + " follows " +
                                   number_text(points.back().x));
      return false;
    }
    points.push_back(point);
  }
  if (points.size() >= 2) return true;
  report.problem("points", "a point group needs two points at least");
  return false;
}

MotionValue group_value(const CamFunction& function, double x) {
  std::size_t low = 0;
  std::size_t high = function.piece_count();
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (function.piece_start(middle) <= x ? low : high) = middle;
  }
  const CamDerivatives value =
      function.piece_value(low, std::clamp(x, function.start_leading_value(), function.end_leading_value()));
  return {value.position, value.first, value.second, value.third};
}

bool build(const CamPointGroup& group, CamReport& report, BuiltElement& built) {
  std::vector<TO_Cam_Struct_PointData> points;
  bool good = report.in_range("tolerance", group.tolerance);
  good &= report.count("count", group.count, group.as_segments ? kCamSegments + 1 : kCam10kPoints);
  if (!resolve(group, report, points) || !good) return false;
  const auto function = std::make_shared<CamFunction>(points.size());
  if (interpolate_all(points, {}, {group.bezier ? 2 : 1, 0}, *function) != ErrorId::none) {
    report.problem("points", "no curve runs through these points");
    return false;
  }
  built.curve = [function](double x) { return group_value(*function, x); };
  const Stretch range{points.front().x, points.back().x};
  std::vector<double> places;
  for (std::size_t k = 0; k < group.count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(group.count - 1);
    places.push_back(group.count == points.size() ? points[k].x : range.start + part * range.length());
  }
  places.back() = range.end;
  for (std::size_t k = 0; k < group.count && !group.as_segments; ++k)
    built.points.push_back({places[k], built.curve(places[k]).position});
  for (std::size_t k = 0; k + 1 < group.count && group.as_segments; ++k) {
    built.segments.push_back(segment_between(built.curve(places[k]), 2, built.curve(places[k + 1]), 2,
                                             places[k], places[k + 1] - places[k]));
    built.segments.back().xmax = places[k + 1];
  }
  measure(range, built);
  return true;
}

}  // namespace

bool build_element(const CamShape& shape, CamReport& report, BuiltElement& built) {
  return std::visit([&](const auto& element) { return build(element, report, built); }, shape);
}

}  // namespace lockstep
