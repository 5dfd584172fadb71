// Reads cams from JSON.
#include "projects/cam_files/definition.hpp"

#include <iterator>

#include "projects/cam_files/fields.hpp"
#include "projects/json/fields.hpp"

namespace lockstep {
namespace {

std::optional<double> read_value(const JsonValue* value, Problems& problems) {
  return read_number(value, -kLargestCamNumber, kLargestCamNumber, problems);
}

template <class T>
void read_numbers(const JsonValue& json, std::span<const CamNumber<T>> numbers, T& target,
                  Problems& problems) {
  for (const CamNumber<T>& number : numbers) {
    const auto read = read_value(json.find(number.key), problems);
    if (!read) continue;
    std::visit([&](auto member) { target.*member = *read; }, number.member);
  }
}

template <class Enum>
void read_choice(const JsonValue* value, std::span<const std::string_view> words, int first, Enum& target,
                 Problems& problems) {
  if (const auto word = read_word(value, words, problems))
    target = static_cast<Enum>(static_cast<int>(*word) + first);
}

void read_continuity(const JsonValue* value, std::optional<Continuity>& target, Problems& problems) {
  if (const auto word = read_word(value, cam_words::kContinuities, problems))
    target = static_cast<Continuity>(*word + 1);  // 0 is "not applicable"
}

void read_goal(const JsonValue* value, std::optional<CamGoal>& target, Problems& problems) {
  if (const auto word = read_word(value, cam_words::kGoals, problems)) target = static_cast<CamGoal>(*word);
}

void read_count(const JsonValue* value, std::size_t& target, Problems& problems) {
  if (const auto count = read_integer(value, 2, static_cast<std::int64_t>(kCam10kPoints), problems))
    target = static_cast<std::size_t>(*count);
}

void read_flag(const JsonValue* value, bool& target, Problems& problems) {
  if (const auto flag = read_bool(value, problems)) target = *flag;
}

/// Two numbers, such as a point.
std::optional<std::array<double, 2>> read_pair(const JsonValue& value, std::string_view allowed,
                                               Problems& problems) {
  if (value.kind != JsonKind::array || value.elements.size() != 2) {
    report_kind(value, allowed, problems);
    return std::nullopt;
  }
  const auto first = read_value(value.elements[0], problems);
  const auto second = read_value(value.elements[1], problems);
  if (!first || !second) return std::nullopt;
  return std::array{*first, *second};
}

std::vector<TO_Cam_Struct_PointData> read_points(const JsonValue* value, Problems& problems) {
  std::vector<TO_Cam_Struct_PointData> points;
  if (read_array(value, problems) == nullptr) return points;
  for (const JsonValue* const element : value->elements)
    if (const auto pair = read_pair(*element, "[leading value, following value]", problems))
      points.push_back({(*pair)[0], (*pair)[1]});
  return points;
}

std::vector<TO_Cam_Struct_SegmentData> read_segments(const JsonValue* value, Problems& problems) {
  std::vector<TO_Cam_Struct_SegmentData> segments;
  if (read_array(value, problems) == nullptr) return segments;
  std::vector<Key> keys;
  add_keys<TO_Cam_Struct_SegmentData>(cam_fields::kSegment, keys);
  for (const JsonValue* const element : value->elements) {
    const Fields fields(*element, keys, problems);
    segments.emplace_back();
    if (fields.usable())
      read_numbers<TO_Cam_Struct_SegmentData>(*element, cam_fields::kSegment, segments.back(), problems);
  }
  return segments;
}

/// The keys of an element of a kind, with those that every element has.
template <class T>
std::vector<Key> keys_of(std::span<const CamNumber<T>> numbers, std::span<const CamMember> members = {}) {
  std::vector<Key> keys{{"type", keys::kRequired}, {"comment"}};
  add_keys(numbers, keys);
  add_keys(members, keys);
  return keys;
}

void read_text(const JsonValue* value, std::string& target, Problems& problems) {
  if (const auto text = read_string(value, problems)) target = *text;
}

// The members of each kind of element beyond its numbers.

CamPointElement read_point(const JsonValue& json, Problems& problems) {
  CamPointElement point;
  const Fields fields(json, keys_of<CamPointElement>(cam_fields::kPoint), problems);
  read_numbers<CamPointElement>(json, cam_fields::kPoint, point, problems);
  return point;
}

CamPointGroup read_group(const JsonValue& json, Problems& problems) {
  CamPointGroup group;
  const Fields fields(json, keys_of<CamPointGroup>(cam_fields::kGroup, cam_fields::kGroupMembers), problems);
  read_numbers<CamPointGroup>(json, cam_fields::kGroup, group, problems);
  group.points = read_points(fields["points"], problems);
  read_flag(fields["relative_x"], group.relative_x, problems);
  read_flag(fields["relative_y"], group.relative_y, problems);
  read_choice(fields["interpolation"], cam_words::kGroupInterpolations, 0, group.bezier, problems);
  read_choice(fields["mapping"], cam_words::kMappings, 0, group.as_segments, problems);
  read_count(fields["count"], group.count, problems);
  return group;
}

CamLine read_line(const JsonValue& json, Problems& problems) {
  CamLine line;
  const Fields fields(json, keys_of<CamLine>(cam_fields::kLine), problems);
  read_numbers<CamLine>(json, cam_fields::kLine, line, problems);
  return line;
}

CamSine read_sine(const JsonValue& json, Problems& problems) {
  CamSine sine;
  std::vector<Key> keys = keys_of<CamSine>(cam_fields::kSine);
  add_keys<CamWave>(cam_fields::kWave, keys);
  const Fields fields(json, keys, problems);
  read_numbers<CamSine>(json, cam_fields::kSine, sine, problems);
  read_numbers<CamWave>(json, cam_fields::kWave, sine.wave, problems);
  return sine;
}

CamPolynomial read_polynomial(const JsonValue& json, Problems& problems) {
  CamPolynomial polynomial;
  std::vector<Key> keys = keys_of<CamPolynomial>(cam_fields::kPolynomial, cam_fields::kPolynomialMembers);
  bool waves = false;
  for (const auto& number : cam_fields::kWave) waves |= json.find(number.key) != nullptr;
  for (const auto& number : cam_fields::kWave) keys.push_back({number.key, waves && number.required});
  const Fields fields(json, keys, problems);
  read_numbers<CamPolynomial>(json, cam_fields::kPolynomial, polynomial, problems);
  if (waves) read_numbers<CamWave>(json, cam_fields::kWave, polynomial.wave.emplace(), problems);
  const JsonValue* const coefficients = read_array(fields["coefficients"], problems);
  if (coefficients == nullptr) return polynomial;
  auto& target = polynomial.coefficients.emplace();
  target.fill(0.0);
  if (coefficients->elements.empty() || coefficients->elements.size() > target.size())
    report_kind(*coefficients, "1 to 7 numbers, of x^0 to x^6", problems);
  for (std::size_t k = 0; k < std::min(coefficients->elements.size(), target.size()); ++k)
    target[k] = read_value(coefficients->elements[k], problems).value_or(0.0);
  return polynomial;
}

CamInverseSine read_inverse_sine(const JsonValue& json, Problems& problems) {
  CamInverseSine inverse;
  const Fields fields(
      json, keys_of<CamInverseSine>(cam_fields::kInverseSine, cam_fields::kInverseSineMembers), problems);
  read_numbers<CamInverseSine>(json, cam_fields::kInverseSine, inverse, problems);
  read_flag(fields["mirrored"], inverse.mirrored, problems);
  read_count(fields["count"], inverse.count, problems);
  return inverse;
}

CamShape read_shape(std::size_t kind, const JsonValue& json, Problems& problems) {
  switch (kind) {
    case 0:
      return read_point(json, problems);
    case 1:
      return read_group(json, problems);
    case 2:
      return read_line(json, problems);
    case 3:
      return read_sine(json, problems);
    case 4:
      return read_polynomial(json, problems);
    default:
      return read_inverse_sine(json, problems);
  }
}

/// A transition; none if it is left to the interpolation of the cam, of which the comment stays.
std::optional<CamTransition> read_transition(const JsonValue& json, std::string& gap_comment,
                                             Problems& problems) {
  CamTransition transition;
  const Fields fields(json, keys_of<CamTransition>(cam_fields::kTransition, cam_fields::kTransitionMembers),
                      problems);
  bool by_law = true;
  read_choice(fields["method"], cam_words::kMethods, 0, by_law, problems);
  if (!by_law) {
    for (const auto& [name, value] : json.members)
      if (name != "type" && name != "method" && name != "comment")
        problems.report(*value, quote(name) + " has no meaning with the method 'system'");
    read_text(fields["comment"], gap_comment, problems);
    return std::nullopt;
  }
  read_numbers<CamTransition>(json, cam_fields::kTransition, transition, problems);
  if (const auto law = read_word(fields["law"], law_names(), problems))
    transition.law = static_cast<MotionLawKind>(*law);
  read_goal(fields["goal"], transition.goal, problems);
  read_continuity(fields["start_continuity"], transition.start_continuity, problems);
  read_continuity(fields["end_continuity"], transition.end_continuity, problems);
  read_count(fields["count"], transition.count, problems);
  read_text(fields["comment"], transition.comment, problems);
  return transition;
}

/// Where elements, transitions, points and segments stand in the document.
struct Places {
  const JsonValue* whole = nullptr;
  std::vector<const JsonValue*> elements;     // or points
  std::vector<const JsonValue*> transitions;  // behind the element, nullptr without one; or segments

  const JsonValue& of(const CamFinding& finding) const {
    const auto& list = finding.transition ? transitions : elements;
    if (finding.element >= list.size() || list[finding.element] == nullptr) return *whole;
    return cam_member(*list[finding.element], finding.field);
  }
};

/// Reads elements and the transitions between them.
void read_elements(const JsonValue& array, CamDesign& design, Places& places, Problems& problems) {
  if (read_array(&array, problems) == nullptr) return;
  bool behind_transition = true;  // nothing to join yet
  for (const JsonValue* const json : array.elements) {
    if (read_object(json, problems) == nullptr) continue;
    const JsonValue* const type = json->find("type");
    if (type == nullptr) problems.report(*json, "the key 'type' is missing");
    const auto kind = read_word(type, cam_words::kElements, problems);
    if (!kind) continue;
    if (*kind != cam_words::kTransition) {
      design.elements.push_back({read_shape(*kind, *json, problems), "", std::nullopt, ""});
      read_text(json->find("comment"), design.elements.back().comment, problems);
      places.elements.push_back(json);
      places.transitions.push_back(nullptr);
      behind_transition = false;
      continue;
    }
    std::string gap_comment;
    auto transition = read_transition(*json, gap_comment, problems);
    if (behind_transition) {
      problems.report(*json, "a transition has to stand between two elements");
      continue;
    }
    design.elements.back().transition = std::move(transition);
    design.elements.back().gap_comment = std::move(gap_comment);
    places.transitions.back() = json;
    behind_transition = true;
  }
}

void report_findings(const CamDefinition& definition, const Places& places, Problems& problems) {
  for (const CamFinding& problem : definition.cam.problems) problems.report(places.of(problem), problem.text);
  for (const CamFinding& warning : definition.cam.warnings) problems.warn(places.of(warning), warning.text);
}

void read_optimization(const JsonValue& json, CamDesign& design, Problems& problems) {
  const Fields fields(json, keys::kCamOptimization, problems);
  if (!fields.usable()) return;
  read_continuity(fields["continuity"], design.continuity, problems);
  std::optional<CamGoal> goal;
  read_goal(fields["goal"], goal, problems);
  design.goal = goal.value_or(CamGoal::none);
}

void define_by_elements(const JsonValue& object, CamDefinition& definition, Problems& problems) {
  const std::size_t before = problems.count();
  Places places{object.find("elements"), {}, {}};
  definition.designed = true;
  for (const char* key : {"points", "segments"})
    if (const JsonValue* const value = object.find(key))
      problems.report(*value, "is not allowed beside elements, which give the points and segments");
  if (const JsonValue* const optimization = object.find("optimization"))
    read_optimization(*optimization, definition.design, problems);
  read_elements(*places.whole, definition.design, places, problems);
  if (problems.count() != before) return;
  definition.cam = design_cam(definition.design, definition.capacity);
  report_findings(definition, places, problems);
}

void define_by_data(const JsonValue& object, CamWithoutCurve without_curve, CamDefinition& definition,
                    Problems& problems) {
  const std::size_t before = problems.count();
  const JsonValue* const points = object.find("points");
  const JsonValue* const segments = object.find("segments");
  if (const JsonValue* const optimization = object.find("optimization"))
    problems.report(*optimization, "has no meaning without elements");
  Places places{&object, {}, {}};
  if (points != nullptr) places.elements = points->elements;
  if (segments != nullptr) places.transitions = segments->elements;
  auto point_data = read_points(points, problems);
  auto segment_data = read_segments(segments, problems);
  if (problems.count() != before) return;
  const auto make = without_curve == CamWithoutCurve::allowed ? checked_cam : interpolated_cam;
  definition.cam = make(std::move(point_data), std::move(segment_data), definition.design.interpolation,
                        definition.capacity);
  report_findings(definition, places, problems);
}

void read_interpolation(const JsonValue& json, CamDesign& design, Problems& problems) {
  const Fields fields(json, keys::kCamInterpolation, problems);
  if (!fields.usable()) return;
  read_choice(fields["mode"], cam_words::kModes, 0, design.interpolation.InterpolationMode, problems);
  read_choice(fields["boundary"], cam_words::kBoundaries, 0, design.interpolation.BoundaryConditions,
              problems);
}

void read_range(const JsonValue* value, std::optional<std::array<double, 2>>& target, Problems& problems) {
  if (value == nullptr) return;
  target = read_pair(*value, "[lowest, highest]", problems);
  if (target && (*target)[0] > (*target)[1])
    problems.report(*value, "the lowest is above the highest; allowed: [lowest, highest]");
}

/// `true`, `false` or "closed".
void read_cycle(const JsonValue* json, CamChecks& checks, Problems& problems) {
  if (json == nullptr) return;
  if (json->kind == JsonKind::boolean)
    checks.cyclic = json->boolean;
  else if (json->kind == JsonKind::string && json->text == cam_words::kClosed)
    checks.cyclic = checks.closed = true;
  else
    problems.report(*json, json->shown() + " is not allowed here; allowed: true, false, \"closed\"");
}

void read_checks(const JsonValue& json, CamChecks& checks, Problems& problems) {
  std::vector<Key> keys;
  add_keys<CamChecks>(cam_fields::kChecks, keys);
  add_keys(cam_fields::kCheckMembers, keys);
  const Fields fields(json, keys, problems);
  if (!fields.usable()) return;
  read_numbers<CamChecks>(json, cam_fields::kChecks, checks, problems);
  read_range(fields["leading_range"], checks.leading_range, problems);
  read_range(fields["following_range"], checks.following_range, problems);
  read_flag(fields["suitability"], checks.suitability, problems);
  read_continuity(fields["continuity"], checks.continuity, problems);
  read_cycle(fields["cyclic"], checks, problems);
  for (const char* limit : {"max_velocity", "max_acceleration", "max_jerk"})
    if (fields[limit] != nullptr && fields["leading_velocity"] == nullptr)
      problems.report(*fields[limit], "needs the key 'leading_velocity' beside it");
}

}  // namespace

const JsonValue& cam_member(const JsonValue& element, std::string_view field) {
  if (element.kind == JsonKind::array && element.elements.size() == 2) {  // a point
    if (field == "x") return *element.elements[0];
    if (field == "y") return *element.elements[1];
  }
  const JsonValue* const member = element.find(field);
  return member != nullptr ? *member : element;
}

void read_cam_members(const JsonValue& object, CamWithoutCurve without_curve, CamDefinition& definition,
                      Problems& problems) {
  if (object.find("elements") != nullptr) return define_by_elements(object, definition, problems);
  define_by_data(object, without_curve, definition, problems);
}

void read_cam_document(const JsonValue& root, CamDefinition& definition, Problems& problems) {
  const Fields fields(root, keys::kCamFile, problems);
  if (!fields.usable()) return;
  read_integer(fields["lockstep_cam"], 1, 1, problems);
  if (const auto name = read_title(fields["name"], problems)) definition.name = *name;
  read_text(fields["description"], definition.description, problems);
  if (const auto type = read_word(fields["type"], cam_words::kTypes, problems))
    definition.capacity = *type == 0 ? kCamPoints : kCam10kPoints;
  if (fields["interpolation"] != nullptr)
    read_interpolation(*fields["interpolation"], definition.design, problems);
  if (fields["checks"] != nullptr) read_checks(*fields["checks"], definition.checks, problems);
  read_cam_members(root, CamWithoutCurve::refused, definition, problems);
}

}  // namespace lockstep
