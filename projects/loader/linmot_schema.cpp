#include "projects/loader/linmot_schema.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "tech_objects/linmot_catalogue/mt_commands.hpp"
#include "tech_objects/linmot_catalogue/parameters.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

Json directory() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

Json leaf(const linmot::Parameter& parameter) {
  using enum linmot::Kind;
  std::string text(parameter.text);
  if (!parameter.unit.empty()) text += " [" + std::string(parameter.unit) + "]";
  if (!parameter.effective()) text += " (no effect yet)";
  Json schema = {{"description", text}};
  if (parameter.kind == on_off) {
    schema["type"] = "boolean";
  } else if (parameter.kind == choice) {
    for (const std::string_view option : parameter.options) schema["enum"].push_back(option);
  } else {
    schema["type"] = parameter.kind == whole ? "integer" : "number";
    // Or a duration, such as "5ms".
    if (parameter.unit == "ms") schema["type"] = {"number", "string"};
    schema["minimum"] = parameter.range.lowest;
    schema["maximum"] = parameter.range.highest;
  }
  return schema;
}

void insert(Json& root, const linmot::Parameter& parameter) {
  if (parameter.read_only() || parameter.kind == linmot::Kind::shown) return;
  Json* node = &root;
  for (std::string_view rest = parameter.path;;) {
    const auto end = rest.find('\\');
    const std::string name(rest.substr(0, end));
    Json& properties = (*node)["properties"];
    if (end == rest.npos) {
      properties[name] = leaf(parameter);
      return;
    }
    if (!properties.contains(name)) properties[name] = directory();
    node = &properties[name];
    rest.remove_prefix(end + 1);
  }
}

}  // namespace

void add_linmot_definitions(Json& definitions) {
  Json drive = directory();
  for (const linmot::Parameter& parameter : linmot::motor_parameters())
    if (parameter.scope <= linmot::Scope::linear_motor) insert(drive, parameter);
  definitions["linmot_drive"] = std::move(drive);
  Json config = directory();
  for (const linmot::Parameter& parameter : linmot::system_parameters()) insert(config, parameter);
  Json& drives = config["properties"]["Drives"] = directory();
  for (const char* const name : {"Drive A", "Drive B", "Drive C", "Drive D"})
    drives["properties"][name] = {{"$ref", "#/definitions/linmot_drive"}};
  config["description"] = "parameters of a LinMot controller";
  definitions["linmot_config"] = std::move(config);
  Json cell = directory();
  for (const linmot::MtRow& row : linmot::mt_commands())
    if (row.scope == linmot::MtScope::linear_motor)
      cell["properties"][std::string(row.name)] = {{"description", row.text},
                                                   {"type", "array"},
                                                   {"items", {{"type", "number"}}},
                                                   {"minItems", row.arity()},
                                                   {"maxItems", row.arity()}};
  cell["maxProperties"] = 1;
  definitions["linmot_cell"] = std::move(cell);
  Json row = directory();
  for (const char* const motor : {"A", "B", "C", "D"})
    row["properties"][motor] = {{"$ref", "#/definitions/linmot_cell"}};
  definitions["linmot_state_table"] = {
      {"description", "rows 0 to 63"},
      {"type", "object"},
      {"properties", {{"file", {{"type", "string"}, {"description", "CSV file with rows"}}}}},
      {"additionalProperties", std::move(row)}};
  definitions["linmot_input_table"] = {{"description", "what the codes of the inputs do"},
                                       {"type", "object"},
                                       {"additionalProperties", {{"type", {"string", "array"}}}}};
  definitions["linmot_points"] = {
      {"description", "[ms, mm] each"},
      {"type", "array"},
      {"items", {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}}}};
}

}  // namespace lockstep
