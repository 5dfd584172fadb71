#include "projects/loader/project_schema.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "projects/cam_files/schema.hpp"
#include "projects/keys/project.hpp"
#include "projects/keys/schema.hpp"
#include "projects/keys/system.hpp"
#include "projects/loader/call_schema.hpp"
#include "projects/loader/configuration_tree.hpp"
#include "projects/loader/linmot_schema.hpp"
#include "projects/loader/tag_schema.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

Json described(std::string_view description, const Json& schema) {
  Json result = {{"description", description}};
  result.update(schema);
  return result;
}

Json text(std::string_view description) {
  return described(description, {{"type", "string"}});
}
Json reference(std::string_view definition) {
  return {{"$ref", "#/definitions/" + std::string(definition)}};
}

Json default_of(const Variable& variable) {
  const Value start = variable.start_value();
  if (variable.type == Type::BOOL) return start.u != 0;
  if (is_real(variable.type)) return start.r;
  if (is_signed_integer(variable.type)) return start.i;
  return start.u;
}

Json variable_schema(const Variable& variable) {
  std::string description(variable.text);
  if (variable.unit != Unit::kNone) description += " [" + std::string(unit_text(variable.unit)) + "]";
  if (variable.later) description += " (no effect yet)";
  if (variable.type == Type::TAG) return text(description + ": the name of a BOOL tag");
  Json schema = {{"description", description}};
  const bool real = is_real(variable.type);
  schema["type"] = variable.type == Type::BOOL ? "boolean" : real ? "number" : "integer";
  if (variable.type != Type::BOOL) {
    const auto bound = [&](double limit) {
      return real ? Json(limit) : Json(static_cast<std::int64_t>(limit));
    };
    if (!variable.choices.empty()) {
      for (const Choice& choice : variable.choices) schema["enum"].push_back(choice.value);
    } else if (variable.range.highest < std::numeric_limits<double>::max()) {
      schema["minimum"] = bound(variable.range.lowest);
      schema["maximum"] = bound(variable.range.highest);
    }
  }
  schema["default"] = default_of(variable);
  return schema;
}

/// A structure of the configuration. Elements of an array become definitions, which the elements refer to.
/// @param owner the type of object, with which the names of the definitions begin
Json structure_schema(const ConfigurationNode& structure, const std::string& owner, Json& definitions) {
  constexpr std::size_t kListedElements = 100;  // of longer arrays an editor gets the kind of element only
  Json properties = Json::object();
  Json others = Json::array();
  for (const auto& child : structure.children) {
    if (child->computed()) continue;
    const std::string name(child->name);
    Json schema = child->variable != nullptr ? variable_schema(*child->variable)
                                             : structure_schema(*child, owner, definitions);
    if (child->count == 0) {
      properties[name] = std::move(schema);
      continue;
    }
    const std::string definition = owner + "." + name;
    definitions[definition] = std::move(schema);
    if (child->count > kListedElements) {
      others.push_back(reference(definition));
      continue;
    }
    for (std::size_t i = 1; i <= child->count; ++i)
      properties[name + "[" + std::to_string(i) + "]"] = reference(definition);
  }
  const Json rest = others.empty() ? Json(false) : Json{{"anyOf", others}};
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", rest}};
}

/// What keys refer to and is declared elsewhere: variables of data blocks, cams, blocks and types.
void add_definitions(KeySchema& keys) {
  Json& definitions = keys.definitions;
  for (const ObjectKindText& type : kObjectKinds) {
    const std::string name(type.name);
    const Json config = structure_schema(configuration_tree(type.kind), name, definitions);
    definitions[name] = described("start values of a " + name, config);
  }
  const Json cam = cam_definition_schema();
  for (const char* part : {"elements", "optimization", "points", "segments"})
    definitions[std::string("cam_") + part] = cam[part];
  definitions.update(cam_schema_definitions());
  add_linmot_definitions(definitions);
  add_tag_definitions(definitions);
  add_call_definitions(keys);
  // Parameters may stand in every value of a template, so that only the loader knows what is right.
  definitions["named_parts"] = {{"type", "object"}, {"additionalProperties", {{"type", "object"}}}};
  definitions["list_of_parts"] = {{"type", "array"}};
  definitions["parameter_value"] = {{"type", {"boolean", "number", "string"}}};
  definitions["parameter_values"] = {{"type", "object"},
                                     {"additionalProperties", reference("parameter_value")}};
  definitions["parameter_range"] = {
      {"type", "object"},
      {"minProperties", 1},
      {"maxProperties", 1},
      {"additionalProperties",
       {{"type", "array"}, {"items", {{"type", "integer"}}}, {"minItems", 2}, {"maxItems", 2}}}};
}

std::string schema_text(std::string_view title, KeySchema& keys, const Json& root) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema.update(root);
  add_definitions(keys);
  schema["definitions"] = keys.definitions;
  return schema.dump(2) + "\n";
}

}  // namespace

std::string project_schema() {
  KeySchema keys;
  return schema_text("Lockstep project", keys, keys.object(keys::kProject));
}

std::string system_schema() {
  KeySchema keys;
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Lockstep system"}};
  schema.update(keys.object(keys::kSystem));
  return schema.dump(2) + "\n";
}

std::string part_schema() {
  KeySchema keys;
  const Json whole = keys.object(keys::kProject)["properties"];
  Json part = keys.object(keys::kPart);
  // What the keys of a part leave open, since a template may have parameters there, the project knows.
  for (auto& [name, section] : part["properties"].items()) {
    const Json& known = whole[name];
    if (!section.contains("properties")) {
      section = known;
      continue;
    }
    for (auto& [inner, value] : section["properties"].items()) value = known["properties"][inner];
  }
  return schema_text("Part of a Lockstep project", keys, part);
}

}  // namespace lockstep
