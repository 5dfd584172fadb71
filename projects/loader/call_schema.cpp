#include "projects/loader/call_schema.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "fb/block.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/constant_schema.hpp"

namespace lockstep {
namespace {

using Json = KeySchema::Json;

std::string inputs_of(const BlockType& type) {
  return std::string(type.name) + ".in";
}

std::string meaning_of(const Pin& pin) {
  std::string text(pin.text);
  if (pin.unit != Unit::kNone) text += " [" + std::string(unit_text(pin.unit)) + "]";
  for (const Choice& choice : pin.choices)
    text += (&choice == &pin.choices.front() ? ": " : "; ") + std::to_string(choice.value) + " " +
            std::string(choice.text);
  return text;
}

Json value_of(const Pin& pin) {
  Json schema = {{"description", meaning_of(pin)}};
  const bool named = pin.type == Type::AXIS || pin.type == Type::ARRAY;
  schema.update(named ? Json{{"type", "string"}} : constant_schema(pin.type));
  return schema;
}

/// An object of the inputs, of which those that take an object have to be there.
Json inputs_schema(const BlockType& type) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Pin& pin : type.pins) {
    if (pin.pin_class == PinClass::output) continue;
    properties[std::string(pin.name)] = value_of(pin);
    if (pin.type == Type::AXIS) required.push_back(pin.name);
  }
  Json schema = {{"description", "inputs of " + std::string(type.name)},
                 {"type", "object"},
                 {"properties", properties},
                 {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

/// What a call has if its block is the one.
Json branch(const BlockType& type, bool takes_object) {
  const Json is_it = {{"properties", {{"fb", {{"enum", {type.name}}}}}}};
  Json then = {{"properties", {{"in", {{"$ref", "#/definitions/" + inputs_of(type)}}}}}};
  if (takes_object) then["required"] = Json::array({"in"});
  return {{"if", is_it}, {"then", then}};
}

/// The keys of one kind of call, and no others; what they may be is said where all keys are.
Json kind(KeySchema& keys, Keys of_kind) {
  Json schema = keys.object(of_kind);
  for (auto& [name, value] : schema["properties"].items()) value = Json::object();
  return schema;
}

}  // namespace

void add_call_definitions(KeySchema& keys) {
  Json blocks = Json::array();
  Json names = Json::array();
  for (const BlockType& type : block_types()) {
    names.push_back(type.name);
    const Json inputs = inputs_schema(type);
    blocks.push_back(branch(type, inputs.contains("required")));
    keys.definitions[inputs_of(type)] = inputs;
  }
  keys.definitions["function_block"] = {{"description", "function block"}, {"enum", names}};

  Json properties = Json::object();
  for (const Keys one : {Keys(keys::kCall), Keys(keys::kSet), Keys(keys::kSetStart), Keys(keys::kIf)})
    properties.update(keys.object(one)["properties"]);
  Json of_block = kind(keys, keys::kCall);
  of_block["allOf"] = std::move(blocks);
  Json schema = {{"type", "object"}, {"properties", properties}};
  // Which kind it is says the first of these keys that it has.
  Json* place = &schema;
  const auto if_there_is = [&](const char* key, Json of_kind) {
    (*place)["if"]["required"] = Json::array({key});
    (*place)["then"] = std::move(of_kind);
    place = &(*place)["else"];
  };
  if_there_is("fb", std::move(of_block));
  if_there_is("set", kind(keys, keys::kSet));
  if_there_is("set_start", kind(keys, keys::kSetStart));
  *place = kind(keys, keys::kIf);
  keys.definitions["call"] = schema;
}

}  // namespace lockstep
