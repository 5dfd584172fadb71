#include "projects/loader/linmot_curves.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "projects/json/named_file.hpp"
#include "projects/json/text_file.hpp"
#include "projects/keys/linmot.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"

namespace lockstep {
namespace {

constexpr double kMillisecond = 1e-3;
constexpr std::size_t kLargestCurveFile = 8 << 20;
constexpr std::size_t kMaximumPoints = 100'000;
constexpr const char* kTooManyPoints = "there are more than 100000 points";
constexpr double kLatest = 1e9, kFurthest = 2520.0;  // [ms], [mm] of a point

void load_points(const JsonValue& json, linmot::CurvePart& part, const Loading& loading) {
  if (read_array(&json, loading.problems) == nullptr) return;
  if (json.elements.size() > kMaximumPoints) return loading.problems.report(json, kTooManyPoints);
  for (const JsonValue* const point : json.elements) {
    if (point->kind != JsonKind::array || point->elements.size() != 2)
      return report_kind(*point, "[time in ms, position in mm]", loading.problems);
    const auto time = read_number(point->elements[0], 0.0, kLatest, loading.problems);
    const auto position = read_number(point->elements[1], -kFurthest, kFurthest, loading.problems);
    if (!time || !position) return;
    if (!part.points.empty() && !(*time * kMillisecond > part.points.back().x))
      return loading.problems.report(*point, "its time is not behind that of the point before");
    part.points.push_back({*time * kMillisecond, *position});
  }
}

bool take_figure(std::string_view& line, double& value) {
  while (!line.empty() &&
         (line.front() == ' ' || line.front() == ';' || line.front() == ',' || line.front() == '\t'))
    line.remove_prefix(1);
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc{}) return false;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return true;
}

/// A point of a line. @return what is wrong with it; empty: nothing
std::string take_point(std::string_view line, linmot::CurvePart& part) {
  double time = 0.0, position = 0.0;
  const bool figures = take_figure(line, time) && take_figure(line, position);
  if (!figures || !(time >= 0.0 && time <= kLatest && std::abs(position) <= kFurthest))
    return "allowed: a time in ms from 0 on and a position in mm from -2520 to 2520";
  if (line.find_first_not_of(" ;\t\r") != line.npos)
    return "more than a time and a position; allowed: ms;mm with decimal points";
  if (!part.points.empty() && !(time * kMillisecond > part.points.back().x))
    return "its time is not behind that of the point before";
  if (part.points.size() == kMaximumPoints) return kTooManyPoints;
  part.points.push_back({time * kMillisecond, position});
  return "";
}

/// ms;mm in each line; one that begins without a figure at the top is a heading.
void load_curve_file(const JsonValue& json, linmot::CurvePart& part, const Loading& loading) {
  if (!read_string(&json, loading.problems)) return;
  const auto path = named_file(json, loading.folder, loading.folder, loading.problems);
  if (!path) return;
  try {
    const std::string text = read_text_file(*path, kLargestCurveFile);
    if (text.size() > kLargestCurveFile) return loading.problems.report(json, *path + " has more than 8 MiB");
    std::size_t number = 0;
    for (std::string_view rest = without_mark(text); !rest.empty();) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
      ++number;
      double figure = 0.0;
      std::string_view begin = line;
      if (line.find_first_not_of(" \r\t") == line.npos || (number == 1 && !take_figure(begin, figure)))
        continue;
      if (const std::string fault = take_point(line, part); !fault.empty())
        return loading.problems.report(json, *path + ":" + std::to_string(number) + ": " + fault);
    }
  } catch (const UnreadableFile& error) {
    loading.problems.report(json, error.what());
  }
}

linmot::CurvePart load_part(const JsonValue& json, const Fields& fields, const Loading& loading) {
  linmot::CurvePart part;
  read_members(fields, keys::kCurvePart, &part, loading);
  const JsonValue* const points = fields["points"];
  if (points != nullptr) load_points(*points, part, loading);
  if (const JsonValue* const file = json.find("file")) load_curve_file(*file, part, loading);
  if (!part.points.empty()) part.type = linmot::CurveType::manual;
  return part;
}

/// "Ramp" has steps of the velocity at both ends.
bool is_ramp(const JsonValue& json) {
  const JsonValue* const type = json.kind == JsonKind::object ? json.find("type") : nullptr;
  return type != nullptr && type->kind == JsonKind::string && same_name(type->text, "Ramp");
}

void load_curve(const std::string& name, const JsonValue& json, LinMotController& controller,
                const Loading& loading) {
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size() || number < 1 || number >= linmot::kCurves)
    return loading.problems.report_key(json, quote(name) + " is no number of a curve; allowed: 1 to 63");
  if (is_ramp(json))
    return loading.problems.report(*json.find("type"),
                                   "a ramp has steps of the velocity at its ends; allowed: Manual "
                                   "with two points, or another type");
  const std::size_t before = loading.problems.count();
  const Fields fields(json, keys::kCurve, loading.problems);
  if (!fields.usable()) return;
  std::vector<linmot::CurvePart> parts;
  if (const JsonValue* const list = fields["parts"]) {
    if (read_array(list, loading.problems) == nullptr) return;
    for (const JsonValue* const part : list->elements)
      parts.push_back(load_part(*part, Fields(*part, keys::kCurvePart, loading.problems), loading));
  } else {
    parts.push_back(load_part(json, fields, loading));
  }
  if (loading.problems.count() != before) return;
  linmot::Curve& curve = controller.curves[static_cast<std::size_t>(number)];
  if (curve.exists())
    return loading.problems.report_key(json, "curve " + std::to_string(number) + " is there already");
  if (!curve.make(parts))
    return loading.problems.report(
        json,
        "that makes no curve; allowed: a time, or a speed and an acceleration, above "
        "0, or at least two points whose times ascend; at most 50 parts");
  for (const std::string& finding : curve_findings(curve, parts)) loading.problems.warn(json, finding);
}

std::string places(double value) {
  std::string text = std::to_string(value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

namespace {

constexpr double kPositionStep = 1e-6, kVelocityStep = 1e-3;  // [mm], [mm/s] that are told

/// The step between two moments; empty: there is none.
std::string step_between(const CamDerivatives& before, const CamDerivatives& behind, double at) {
  const std::string where = " at " + places(at * 1e3) + " ms";
  if (std::abs(before.position - behind.position) > kPositionStep)
    return "a step of the position by " + places(behind.position - before.position) + " mm" + where;
  if (std::abs(before.first - behind.first) > kVelocityStep)
    return "a step of the velocity by " + places((behind.first - before.first) / 1e3) + " m/s" + where;
  return "";
}

/// Of its ends, or of its points; empty: protocols have them all.
std::string reach_finding(const linmot::CurvePart& part) {
  constexpr double kReach = linmot::kPositionReach * linmot::kPositionIncrement;
  double furthest = 0.0;
  const auto look_at = [&furthest](double position) {
    if (std::abs(position) > std::abs(furthest)) furthest = position;
  };
  for (const auto& point : part.points) look_at(point.y);
  if (part.points.empty()) {
    look_at(part.start);
    look_at(part.end);
  }
  if (std::abs(furthest) <= kReach) return "";
  return "positions outside of those that protocols have, ±630 mm, such as " + places(furthest) + " mm";
}

bool runs_cyclically(const linmot::MotorParameters& parameters, std::size_t number) {
  return static_cast<linmot::RunMode>(parameters.run_mode) == linmot::RunMode::continuous_curve &&
         parameters.curve_number == static_cast<DINT>(number);
}

/// In the state table or by its run mode.
bool runs_curve(const LinMotController& controller, std::size_t motor, std::size_t number) {
  const linmot::MotorParameters& parameters = controller.data.Motors[motor].Parameters;
  const auto mode = static_cast<linmot::RunMode>(parameters.run_mode);
  const auto wanted = static_cast<DINT>(number);
  if (runs_cyclically(parameters, number)) return true;
  if (mode == linmot::RunMode::trigger_curve &&
      (parameters.rise_curve_number == wanted || parameters.fall_curve_number == wanted))
    return true;
  return std::ranges::any_of(controller.table.rows, [&](const linmot::StateRow& row) {
    const linmot::Cell& cell = row.cells[motor];
    const bool curve =
        cell.command == linmot::MtCommand::curve || cell.command == linmot::MtCommand::curve_from_demand;
    return row.exists && curve && cell.arguments[0] == static_cast<double>(number);
  });
}

}  // namespace

std::vector<std::string> curve_findings(const linmot::Curve& curve,
                                        const std::vector<linmot::CurvePart>& parts) {
  std::vector<std::string> findings;
  const CamFunction& function = curve.function();
  const auto compare = [&](const CamDerivatives& before, const CamDerivatives& behind, double at) {
    if (std::string step = step_between(before, behind, at); !step.empty())
      findings.push_back(std::move(step));
  };
  compare({.position = curve.start()}, function.piece_value(0, 0.0), 0.0);
  for (std::size_t i = 1; i < function.piece_count(); ++i) {
    const double at = function.piece_start(i);
    compare(function.piece_value(i - 1, at), function.piece_value(i, at), at);
  }
  const CamDerivatives end = function.piece_value(function.piece_count() - 1, curve.duration());
  compare(end, {.position = curve.end()}, curve.duration());
  for (const linmot::CurvePart& part : parts) {
    if (part.points.size() > 2 && part.points.size() < 16)
      findings.push_back("fewer than 16 points, " + std::to_string(part.points.size()));
    if (std::string finding = reach_finding(part); !finding.empty()) findings.push_back(std::move(finding));
    for (std::size_t i = 1; i < part.points.size(); ++i)
      if (part.points[i].x - part.points[i - 1].x < kMillisecond - 1e-9) {
        findings.push_back("points nearer than 1 ms, from " + places(part.points[i - 1].x * 1e3) + " ms on");
        break;
      }
  }
  return findings;
}

std::string cyclic_finding(const linmot::Curve& curve) {
  const CamFunction& function = curve.function();
  const CamDerivatives end = function.piece_value(function.piece_count() - 1, curve.duration());
  return step_between(end, function.piece_value(0, 0.0), curve.duration());
}

/// Acceleration goes with the amplitude and the square of the speed.
std::string force_finding(const LinMotController& controller, std::size_t motor, const linmot::Curve& curve) {
  const linmot::MotorSettings& settings = controller.motor_settings[motor];
  const linmot::MotorParameters& parameters = controller.data.Motors[motor].Parameters;
  if (!settings.exists || parameters.type == linmot::kNoDrive) return "";
  const double rate = parameters.curve_speed / 100.0, amplitude = parameters.curve_amplitude / 100.0;
  const double mass = settings.plant.slider_mass + settings.plant.load_mass;
  const double needed = mass * curve.peaks().acceleration * rate * rate * amplitude + settings.plant.friction;
  const double possible = settings.force_constant * parameters.maximal_current;
  if (needed <= possible) return "";
  return "motor " + std::string(1, static_cast<char>('A' + motor)) + " would need " + places(needed) +
         " N and makes " + places(possible) + " N with " + places(parameters.maximal_current) + " A";
}

void warn_of_linmot_curves(const JsonValue& json, const LinMotController& controller,
                           const Loading& loading) {
  if (json.kind != JsonKind::object) return;
  for (const auto& [name, at] : json.members) {
    std::size_t number = 0;
    std::from_chars(name.data(), name.data() + name.size(), number);
    if (number == 0 || number >= linmot::kCurves || !controller.curves[number].exists()) continue;
    const linmot::Curve& curve = controller.curves[number];
    for (std::size_t motor = 0; motor < linmot::kMotors; ++motor) {
      if (!runs_curve(controller, motor, number)) continue;
      if (const std::string finding = force_finding(controller, motor, curve); !finding.empty())
        loading.problems.warn(*at, finding);
      const bool cyclic = runs_cyclically(controller.data.Motors[motor].Parameters, number);
      if (const std::string finding = cyclic ? cyclic_finding(curve) : ""; !finding.empty())
        loading.problems.warn(*at, finding + ", where it begins anew");
    }
  }
}

void load_linmot_curves(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  if (read_object(&json, loading.problems) == nullptr) return;
  for (const auto& [name, curve] : json.members) load_curve(name, *curve, controller, loading);
}

}  // namespace lockstep
