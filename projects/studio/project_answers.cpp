#include "projects/studio/project_answers.hpp"

#include <cmath>
#include <map>
#include <span>
#include <string>

#include "hmi_bridge/traces/text_literal.hpp"
#include "projects/studio/api_values.hpp"

namespace lockstep::studio_api {
namespace {

constexpr std::string_view kEffects[] = {"DIR", "CAL", "RES", "RON"};

std::string_view class_name(PinClass pin_class) noexcept {
  if (pin_class == PinClass::input) return "in";
  return pin_class == PinClass::output ? "out" : "in_out";
}

/// Where values stand on Modbus, by the address of their memory.
std::map<const void*, Json> modbus_addresses(const Project& project) {
  std::map<const void*, Json> addresses;
  for (const ModbusMapConfig& map : project.modbus.maps)
    for (const ModbusEntry& entry : map.map.entries()) {
      const Signal& signal = project.modbus.signal_of(entry).signal;
      if (signal.address == nullptr) continue;
      Json& list = addresses.try_emplace(signal.address, Json::array()).first->second;
      Json one = {{"table", modbus_table_name(entry.table)},
                  {"address", entry.address},
                  {"type", type_name(entry.type)},
                  {"writable", entry.writable}};
      if (map.unit) one["unit"] = *map.unit;
      list.push_back(std::move(one));
    }
  return addresses;
}

Json tag_json(std::string_view name, std::string_view type, const std::string& comment, bool retain) {
  return {{"name", name}, {"type", type}, {"comment", comment}, {"retain", retain}, {"writable", true}};
}

void add_range(Json& json, const Range& range, std::span<const Choice> choices) {
  if (std::isfinite(range.lowest) && range.lowest > -1e300) json["minimum"] = range.lowest;
  if (std::isfinite(range.highest) && range.highest < 1e300) json["maximum"] = range.highest;
  if (range.excluded == range.excluded) json["excluded"] = number_json(range.excluded);
  if (choices.empty()) return;
  json["choices"] = array_of(choices, [](const Choice& choice) {
    return Json{{"value", choice.value}, {"text", choice.text}};
  });
}

Json bits_json(const std::string& path, const BitNames& names) {
  Json bits = Json::array();
  for (std::size_t bit = 0; bit < names.size(); ++bit)
    if (!names[bit].empty())
      bits.push_back({{"bit", bit}, {"path", path + ".X" + std::to_string(bit)}, {"name", names[bit]}});
  return bits;
}

Json variable_json(const Project& project, const StudioUnits& units, const StudioProjectText& text,
                   const std::string& object, const Variable& variable) {
  const std::string pattern(variable.path);
  const std::string path = object + "." + pattern;
  std::string first = path;
  if (const std::size_t brackets = first.find("[]"); brackets != std::string::npos)
    first.insert(brackets + 1, "1");
  Json json = {{"path", path},
               {"type", type_name(variable.type)},
               {"text", variable.text},
               {"effect", kEffects[static_cast<std::size_t>(variable.effect)]},
               {"computed", variable.computed},
               {"default", value_json(variable.start_value(), variable.type)}};
  if (const FoundOperand found = project.names.find(first); found.place) {
    const Operand& place = *found.place;
    json["unit"] = units.of(NamedSignal{first, place.signal, place.unit, place.object, place.instance});
    const std::string reason = why_not_writable(place);
    json["writable"] = reason.empty();
    if (!reason.empty()) json["why_not_writable"] = reason;
  }
  if (const Json configured = text.configured(object, pattern); !configured.is_null())
    json["project"] = configured;
  add_range(json, variable.range, variable.choices);
  if (variable.count != 0) json["count"] = variable.count;
  if (variable.later) json["later"] = true;
  if (variable.bits != nullptr) json["bits"] = bits_json(path, *variable.bits);
  return json;
}

}  // namespace

Json tags_json(const Project& project) {
  const Controller& controller = *project.controller;
  const std::map<const void*, Json> addresses = modbus_addresses(project);
  Json tags = Json::array();
  const auto add = [&](Json json, const void* memory) {
    if (const auto found = addresses.find(memory); found != addresses.end()) json["modbus"] = found->second;
    tags.push_back(std::move(json));
  };
  for (const Tag& tag : controller.tags) {
    Json json = tag_json(tag.name, type_name(tag.type), tag.comment, tag.retain);
    json["init"] = value_json(tag.initial, tag.type);
    add(std::move(json), tag.signal.address);
  }
  for (const StringTag& tag : controller.strings) {
    Json json = tag_json(tag.name, text_type_name(tag.text.capacity), tag.comment, tag.retain);
    json["init"] = text_to_utf8(tag.initial);
    add(std::move(json), tag.text.characters);
  }
  for (const ArrayTag& tag : controller.arrays) {
    Json json = tag_json(tag.name, array_type_name(tag.array), tag.comment, false);
    json["lower"] = tag.array.lower;
    json["upper"] = tag.array.upper;
    add(std::move(json), tag.memory.data());
  }
  return {{"tags", tags}};
}

Json object_json(const Project& project, const StudioUnits& units, const StudioProjectText& text,
                 std::string_view name) {
  for (const auto& object : project.controller->objects) {
    if (!same_name(object->name, name)) continue;
    Json variables = Json::array();
    for (const std::span<const Variable> list : data_block_of(object->kind).lists())
      for (const Variable& variable : list)
        variables.push_back(variable_json(project, units, text, object->name, variable));
    return {{"name", object->name},
            {"type", kind_name(object->kind)},
            {"number", static_cast<std::uint64_t>(object->number)},
            {"variables", variables}};
  }
  throw BadRequest(404, "not_found", "there is no technology object '" + std::string(name) + "'");
}

Json instance_json(const Project& project, const StudioUnits& units, const StudioProjectText& text,
                   std::string_view name) {
  for (const Instance& instance : project.controller->instances) {
    if (!same_name(instance.name, name)) continue;
    Json pins = Json::array();
    for (const Pin& pin : instance.type->pins) {
      const std::string path = instance.name + "." + std::string(pin.name);
      Json json = {{"path", path},
                   {"pin", pin.name},
                   {"class", class_name(pin.pin_class)},
                   {"type", type_name(pin.type)},
                   {"text", pin.text}};
      if (const FoundOperand found = project.names.find(path); found.place)
        json["unit"] = units.of(
            NamedSignal{path, found.place->signal, found.place->unit, found.place->object, &instance});
      add_range(json, pin.range, pin.choices);
      if (const Json wired = text.wiring(instance.name, pin.name); !wired.is_null()) json.update(wired);
      pins.push_back(std::move(json));
    }
    return {{"name", instance.name},
            {"type", instance.type->name},
            {"text", instance.type->text},
            {"pins", pins}};
  }
  throw BadRequest(404, "not_found", "there is no instance '" + std::string(name) + "'");
}

Json problems_json(const std::vector<Problem>& problems) {
  return array_of(problems, [](const Problem& problem) {
    Json json = {{"place", problem.place}, {"text", problem.text}};
    if (!problem.file.empty()) json["file"] = problem.file;
    if (problem.line != 0) json["line"] = problem.line;
    if (!problem.owner.empty()) json["owner"] = problem.owner;
    return json;
  });
}

}  // namespace lockstep::studio_api
