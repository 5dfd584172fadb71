// Writes cams as JSON: an element a line.
#include <nlohmann/json.hpp>

#include "projects/cam_files/definition.hpp"
#include "projects/cam_files/fields.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
void write_numbers(const T& source, std::span<const CamNumber<T>> numbers, Json& json) {
  for (const CamNumber<T>& number : numbers) {
    const std::string key(number.key);
    if (const auto* const plain = std::get_if<double T::*>(&number.member))
      json[key] = source.**plain;
    else if (const auto& optional = source.*std::get<std::optional<double> T::*>(number.member))
      json[key] = *optional;
  }
}

Json json_of(const std::vector<TO_Cam_Struct_PointData>& points) {
  Json list = Json::array();
  for (const TO_Cam_Struct_PointData& point : points) list.push_back({point.x, point.y});
  return list;
}

/// A segment without the members that are 0.
Json json_of(const TO_Cam_Struct_SegmentData& segment) {
  Json json = Json::object();
  for (const auto& number : cam_fields::kSegment) {
    const double value = segment.*std::get<double TO_Cam_Struct_SegmentData::*>(number.member);
    if (value != 0.0 || number.required) json[std::string(number.key)] = value;
  }
  return json;
}

void write_shape(const CamPointElement& point, Json& json) {
  write_numbers<CamPointElement>(point, cam_fields::kPoint, json);
}

void write_shape(const CamPointGroup& group, Json& json) {
  json["interpolation"] = cam_words::kGroupInterpolations[group.bezier ? 1 : 0];
  json["mapping"] = cam_words::kMappings[group.as_segments ? 1 : 0];
  json["count"] = group.count;
  if (group.relative_x) json["relative_x"] = true;
  if (group.relative_y) json["relative_y"] = true;
  write_numbers<CamPointGroup>(group, cam_fields::kGroup, json);
  json["points"] = json_of(group.points);
}

void write_shape(const CamLine& line, Json& json) {
  write_numbers<CamLine>(line, cam_fields::kLine, json);
}

void write_shape(const CamSine& sine, Json& json) {
  write_numbers<CamSine>(sine, cam_fields::kSine, json);
  write_numbers<CamWave>(sine.wave, cam_fields::kWave, json);
}

void write_shape(const CamPolynomial& polynomial, Json& json) {
  write_numbers<CamPolynomial>(polynomial, cam_fields::kPolynomial, json);
  if (polynomial.coefficients) json["coefficients"] = *polynomial.coefficients;
  if (polynomial.wave) write_numbers<CamWave>(*polynomial.wave, cam_fields::kWave, json);
}

void write_shape(const CamInverseSine& inverse, Json& json) {
  write_numbers<CamInverseSine>(inverse, cam_fields::kInverseSine, json);
  if (inverse.mirrored) json["mirrored"] = true;
  json["count"] = inverse.count;
}

std::string_view continuity_word(Continuity continuity) {
  return cam_words::kContinuities[static_cast<std::size_t>(continuity) - 1];
}

Json json_of(const CamTransition& transition) {
  Json json = {{"type", cam_words::kElements[cam_words::kTransition]}};
  if (transition.law) json["law"] = motion_law_name(*transition.law);
  if (transition.goal) json["goal"] = cam_words::kGoals[static_cast<std::size_t>(*transition.goal)];
  if (transition.start_continuity) json["start_continuity"] = continuity_word(*transition.start_continuity);
  if (transition.end_continuity) json["end_continuity"] = continuity_word(*transition.end_continuity);
  write_numbers<CamTransition>(transition, cam_fields::kTransition, json);
  if (transition.count != MotionLaw::kDefaultPoints) json["count"] = transition.count;
  if (!transition.comment.empty()) json["comment"] = transition.comment;
  return json;
}

Json json_of(const std::vector<CamElement>& elements) {
  Json list = Json::array();
  for (const CamElement& element : elements) {
    Json json = {{"type", cam_words::kElements[element.shape.index()]}};
    std::visit([&](const auto& shape) { write_shape(shape, json); }, element.shape);
    if (!element.comment.empty()) json["comment"] = element.comment;
    list.push_back(std::move(json));
    if (element.transition) list.push_back(json_of(*element.transition));
    if (!element.gap_comment.empty())
      list.push_back({{"type", cam_words::kElements[cam_words::kTransition]},
                      {"method", cam_words::kMethods[0]},
                      {"comment", element.gap_comment}});
  }
  return list;
}

Json json_of(const CamChecks& checks) {
  Json json = Json::object();
  if (checks.leading_range) json["leading_range"] = *checks.leading_range;
  if (checks.following_range) json["following_range"] = *checks.following_range;
  write_numbers<CamChecks>(checks, cam_fields::kChecks, json);
  if (checks.suitability) json["suitability"] = true;
  if (checks.continuity) json["continuity"] = continuity_word(*checks.continuity);
  if (checks.closed)
    json["cyclic"] = cam_words::kClosed;
  else if (checks.cyclic)
    json["cyclic"] = true;
  return json;
}

Json json_of_segments(const std::vector<TO_Cam_Struct_SegmentData>& segments) {
  Json list = Json::array();
  for (const TO_Cam_Struct_SegmentData& segment : segments) list.push_back(json_of(segment));
  return list;
}

/// The members a line each, and of the long lists an element a line.
std::string lines_of(const Json& root) {
  std::string text = "{";
  const char* before = "\n";
  for (const auto& [key, value] : root.items()) {
    text += before + std::string("  ") + Json(key).dump() + ": ";
    before = ",\n";
    if (!value.is_array()) {
      text += value.dump();
      continue;
    }
    const char* item_before = "\n";
    text += "[";
    for (const Json& item : value) {
      text += item_before + std::string("    ") + item.dump();
      item_before = ",\n";
    }
    text += "\n  ]";
  }
  return text + "\n}\n";
}

}  // namespace

std::string cam_document(const CamDefinition& definition, bool flat) {
  Json root = {{"lockstep_cam", 1}};
  if (!definition.name.empty()) root["name"] = definition.name;
  if (!definition.description.empty()) root["description"] = definition.description;
  root["type"] = cam_words::kTypes[definition.capacity == kCamPoints ? 0 : 1];
  const TO_Cam_Struct_InterpolationSettings& settings = definition.design.interpolation;
  root["interpolation"] = {{"mode", cam_words::kModes[settings.InterpolationMode]},
                           {"boundary", cam_words::kBoundaries[settings.BoundaryConditions]}};
  if (definition.designed && !flat) {
    Json optimization = Json::object();
    if (definition.design.continuity)
      optimization["continuity"] = continuity_word(*definition.design.continuity);
    if (definition.design.goal != CamGoal::none)
      optimization["goal"] = cam_words::kGoals[static_cast<std::size_t>(definition.design.goal)];
    if (!optimization.empty()) root["optimization"] = optimization;
    root["elements"] = json_of(definition.design.elements);
  } else {
    if (!definition.cam.points.empty()) root["points"] = json_of(definition.cam.points);
    if (!definition.cam.segments.empty()) root["segments"] = json_of_segments(definition.cam.segments);
  }
  if (const Json checks = json_of(definition.checks); !checks.empty()) root["checks"] = checks;
  return lines_of(root);
}

}  // namespace lockstep
