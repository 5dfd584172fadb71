#include "projects/project_schema.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "fb/block.hpp"
#include "projects/configuration_tree.hpp"
#include "projects/project_keys.hpp"
#include "tech_objects/technology_object.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;
using Members = std::initializer_list<std::pair<std::string_view, Json>>;

/// An object with the keys that the loader accepts. @throws std::logic_error if one of them is not described
Json object(Keys keys, const Members& members) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Key& key : keys) {
    const auto* const member =
        std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.first == key.name; });
    if (member == members.end()) throw std::logic_error("no schema for the key " + std::string(key.name));
    properties[std::string(key.name)] = member->second;
    if (key.required) required.push_back(key.name);
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json described(std::string_view description, const Json& schema) {
  Json result = {{"description", description}};
  result.update(schema);
  return result;
}

Json text(std::string_view description) {
  return described(description, {{"type", "string"}});
}
Json integer(std::string_view description, std::int64_t lowest, std::int64_t highest) {
  return described(description, {{"type", "integer"}, {"minimum", lowest}, {"maximum", highest}});
}
Json duration(std::string_view description) {
  return text(std::string(description) + ": a duration such as 10ms, 1.5s, T#1s500ms");
}
Json words(std::string_view description, std::span<const std::string_view> list) {
  return described(description, {{"enum", Json(std::vector<std::string_view>(list.begin(), list.end()))}});
}
Json reference(std::string_view definition) {
  return {{"$ref", "#/definitions/" + std::string(definition)}};
}
Json array(std::string_view description, Json items) {
  return described(description, {{"type", "array"}, {"items", std::move(items)}});
}
Json map(std::string_view description, Json values) {
  return described(description, {{"type", "object"}, {"additionalProperties", std::move(values)}});
}
Json value(std::string_view description) {
  return described(description, {{"type", {"boolean", "number", "string"}}});
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
Json structure_schema(const ConfigurationNode& structure, Json& definitions) {
  constexpr std::size_t kListedElements = 100;  // of longer arrays an editor gets the kind of element only
  Json properties = Json::object();
  Json others = Json::array();
  for (const auto& child : structure.children) {
    if (child->computed()) continue;
    const std::string name(child->name);
    Json schema = child->variable != nullptr ? variable_schema(*child->variable)
                                             : structure_schema(*child, definitions);
    if (child->count == 0) {
      properties[name] = std::move(schema);
      continue;
    }
    definitions[name] = std::move(schema);
    if (child->count > kListedElements) {
      others.push_back(reference(name));
      continue;
    }
    for (std::size_t i = 1; i <= child->count; ++i)
      properties[name + "[" + std::to_string(i) + "]"] = reference(name);
  }
  const Json rest = others.empty() ? Json(false) : Json{{"anyOf", others}};
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", rest}};
}

std::vector<std::string_view> block_names() {
  std::vector<std::string_view> names;
  for (const BlockType& type : block_types()) names.push_back(type.name);
  return names;
}

std::vector<std::string_view> tag_type_names() {
  std::vector<std::string_view> names;
  for (int type = 0; type <= static_cast<int>(Type::TIME); ++type)
    names.push_back(type_name(static_cast<Type>(type)));
  return names;
}

Json objects_schema() {
  const Json leading_value =
      object(keys::kLeadingValue, {{"to", text("name of the leading axis")},
                                   {"coupling", words("how its value is taken", words::kCouplings)}});
  const Json drive =
      object(keys::kDrive, {{"model", words("kind of the drive", words::kModels)},
                            {"time_constant", duration("lag of the velocity loop")},
                            {"dead_time", duration("dead time of the velocity loop")},
                            {"encoder_resolution", described("increment of the encoder [u]; 0: none",
                                                             {{"type", "number"}, {"minimum", 0}})}});
  const Json type = words("published type", words::kObjectTypes);
  const Json axis =
      object(keys::kObject, {{"type", type},
                             {"config", {{"anyOf", {reference("config"), reference("cam_config")}}}},
                             {"drive", drive},
                             {"leading_values", array("axes that this one may follow", leading_value)}});
  const Json number = {{"type", "number"}, {"minimum", -1e12}, {"maximum", 1e12}};
  const auto coefficient = [&](std::string_view text) { return described(text, number); };
  const Json segment = object(keys::kSegment, {{"xmin", coefficient("leading value at which it begins")},
                                               {"xmax", coefficient("leading value at which it ends")},
                                               {"a0", coefficient("coefficient of x^0")},
                                               {"a1", coefficient("coefficient of x^1")},
                                               {"a2", coefficient("coefficient of x^2")},
                                               {"a3", coefficient("coefficient of x^3")},
                                               {"a4", coefficient("coefficient of x^4")},
                                               {"a5", coefficient("coefficient of x^5")},
                                               {"a6", coefficient("coefficient of x^6")},
                                               {"sineAmplitude", coefficient("amplitude of a sine")},
                                               {"sinePeriod", coefficient("its angular frequency [rad/u]")},
                                               {"sinePhase", coefficient("its phase [rad]")}});
  const Json point = {{"type", "array"}, {"items", number}, {"minItems", 2}, {"maxItems", 2}};
  const Json cam =
      object(keys::kCam, {{"type", type},
                          {"config", axis["properties"]["config"]},
                          {"points", array("of a cam: pairs of leading value and following value", point)},
                          {"segments", array("of a cam: stretches with a formula", segment)}});
  Json any = axis;
  any["properties"].update(cam["properties"]);
  return map("name: technology object", any);
}

/// One schema for all kinds of calls: which keys go together is told by `dependencies`.
Json call_schema() {
  Json schema = object(keys::kCall, {{"fb", words("function block", block_names())},
                                     {"name", text("name of the instance")},
                                     {"in", map("pin: value, expression or technology object",
                                                value("value, expression or technology object"))}});
  const Json set = object(keys::kSet, {{"set", text("tag or writable variable to assign to")},
                                       {"to", value("value or expression")}});
  const Json start = object(keys::kSetStart, {{"set_start", text("variable whose start value is changed; it "
                                                                 "counts with a restart by MC_Reset")},
                                              {"to", value("value or expression")}});
  const Json branch = object(keys::kIf, {{"if", value("BOOL value or expression")},
                                         {"then", array("what runs if it is TRUE", reference("call"))},
                                         {"else", array("what runs if it is FALSE", reference("call"))}});
  schema["properties"].update(set["properties"]);
  schema["properties"].update(start["properties"]);
  schema["properties"].update(branch["properties"]);
  schema.erase("required");
  schema["dependencies"] = {{"fb", {"name"}},      {"name", {"fb"}}, {"in", {"fb"}},   {"set", {"to"}},
                            {"set_start", {"to"}}, {"if", {"then"}}, {"then", {"if"}}, {"else", {"if"}}};
  return schema;
}

Json programs_schema() {
  const Json program = object(
      keys::kProgram,
      {{"name", text("name of the program")},
       {"ob", words("organization block in which it runs", words::kObs)},
       {"cycle", duration("period of a Main or Cyclic program, a whole multiple of servo_cycle")},
       {"priority", integer("of a Cyclic program; the higher runs first", kLowestPriority, kHighestPriority)},
       {"calls", array("what runs, in this order", reference("call"))}});
  return array("programs", program);
}

Json modbus_schema() {
  const Json entry =
      object(keys::kMapEntry,
             {{"tag", text("signal: tag, instance.Pin or Object.Variable")},
              {"table", words("table of Modbus", words::kTables)},
              {"address", integer("zero-based address of the first register or of the bit", 0, 65535)},
              {"type", words("type on the wire; it may narrow that of the signal", tag_type_names())},
              {"word_order", words("big: most significant register first", words::kWordOrders)},
              {"access", words("whether a client may write", words::kAccesses)}});
  const Json server = object(keys::kServer, {{"listen", text("HOST:PORT, such as 127.0.0.1:1502")}});
  return object(keys::kModbus, {{"server", server}, {"map", array("which signal stands where", entry)}});
}

Json trace_schema() {
  const Json lcm = object(keys::kLcm, {{"url", text("network, such as udpm://239.255.76.67:7667?ttl=0")},
                                       {"channel", text("channel of the rows")}});
  return object(
      keys::kTrace,
      {{"lcm", lcm}, {"signals", array("columns of the trace", text("tag, instance.Pin, variable"))}});
}

Json root_schema() {
  const Json clock =
      object(keys::kClock, {{"servo_cycle", duration("period of MC_Servo")},
                            {"interpolator_ratio", integer("servo cycles per interpolator cycle", 1, 32)},
                            {"overrun", words("what three overruns in a row do", words::kOverrun)}});
  const Json tag = object(keys::kTag, {{"type", words("elementary type", tag_type_names())},
                                       {"init", value("value at the start")},
                                       {"retain", {{"type", "boolean"}, {"description", "kept across runs"}}},
                                       {"comment", text("for the reader")}});
  const Json stimulus = object(keys::kStimulus, {{"at", duration("time since the start")},
                                                 {"set", map("tag: value", value("constant"))}});
  return object(keys::kProject, {{"lockstep", described("version of the format", {{"enum", {1}}})},
                                 {"name", text("name of the project")},
                                 {"description", text("what the project does")},
                                 {"clock", clock},
                                 {"technology_objects", objects_schema()},
                                 {"tags", map("name: tag", tag)},
                                 {"programs", programs_schema()},
                                 {"stimuli", array("changes of tags in a simulation", stimulus)},
                                 {"modbus", modbus_schema()},
                                 {"trace", trace_schema()}});
}

}  // namespace

std::string project_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Lockstep project"}};
  schema.update(root_schema());
  Json definitions = Json::object();
  const auto add_configuration = [&](const char* name, ObjectKind kind, std::string_view text) {
    const Json config = structure_schema(configuration_tree(kind), definitions);
    definitions[name] = described(text, config);
  };
  add_configuration("config", ObjectKind::TO_SynchronousAxis, "start values of the technology data block");
  add_configuration("cam_config", ObjectKind::TO_Cam_10k, "start values of the data block of a cam");
  definitions["call"] = call_schema();
  schema["definitions"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace lockstep
