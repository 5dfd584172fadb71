// lockstep describe: function blocks and their pins.
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"

namespace lockstep::cli {
namespace {

std::vector<std::string> accepted_kinds(const Pin& pin) {
  std::vector<std::string> names;
  for (const ObjectKindText& known : kObjectKinds)
    if (among(known.kind, pin.objects)) names.emplace_back(known.name);
  return names;
}

/// The value that a newly made block holds.
Value start_value(const Pin& pin, Block& block) {
  return pin.type >= Type::AXIS ? Value{} : pin.signal(block).load();
}

std::string type_text(const Pin& pin) {
  if (pin.type == Type::AXIS) return "object";
  return std::string(type_name(pin.type));
}

std::string class_text(PinClass pin_class) {
  switch (pin_class) {
    case PinClass::input:
      return "input";
    case PinClass::output:
      return "output";
    case PinClass::in_out:
      break;
  }
  return "in_out";
}

void add_notes(Table& table, const Pin& pin) {
  std::string otherwise;
  if (pin.error != ErrorId::none)
    otherwise = "; else ErrorID " + error_literal(static_cast<unsigned>(pin.error));
  if (pin.type == Type::AXIS) {
    std::string names;
    for (const std::string& name : accepted_kinds(pin)) names += (names.empty() ? "" : " or ") + name;
    table.note("takes a " + names + otherwise);
    return;
  }
  if (pin.type == Type::ARRAY) return table.note("takes an ARRAY[*] OF " + std::string(pin.element->name));
  for (const std::string& line : choice_lines(pin.type, pin.choices)) table.note(line);
  std::string allowed = range_text(pin.type, pin.range);
  if (!pin.choices.empty()) allowed = "these values";
  if (allowed.empty() && is_real(pin.type) && pin.pin_class == PinClass::input) allowed = "any finite number";
  if (!allowed.empty()) table.note("allowed: " + allowed + otherwise);
}

std::string pins_text(const BlockType& type, PinClass pin_class, const Pin* only, std::size_t width) {
  const auto block = type.create();
  const char* const title = pin_class == PinClass::input    ? "Input"
                            : pin_class == PinClass::output ? "Output"
                                                            : "In and out";
  Table table({title, "Type", "Default", "Unit", "Meaning"});
  for (const Pin& pin : type.pins) {
    if (pin.pin_class != pin_class || (only != nullptr && only != &pin)) continue;
    table.row({std::string(pin.name), type_text(pin), literal(start_value(pin, *block), pin.type),
               std::string(unit_text(pin.unit)), std::string(pin.text)});
    add_notes(table, pin);
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string block_text(const BlockType& type, const Pin* only, std::size_t width) {
  std::string text = std::string(type.name) + "\n";
  text += paragraph(type.text, 2, width);
  text += paragraph("Source: " + std::string(type.source), 2, width);
  text += pins_text(type, PinClass::input, only, width);
  text += pins_text(type, PinClass::in_out, only, width);
  return text + pins_text(type, PinClass::output, only, width);
}

nlohmann::ordered_json pin_json(const Pin& pin, Block& block) {
  nlohmann::ordered_json json{{"name", pin.name},
                              {"class", class_text(pin.pin_class)},
                              {"type", type_text(pin)},
                              {"default", json_value(start_value(pin, block), pin.type)}};
  add_declaration(json, pin.type, pin.unit, pin.range, pin.choices);
  if (pin.type == Type::AXIS) json["objects"] = accepted_kinds(pin);
  if (pin.type == Type::ARRAY) json["of"] = pin.element->name;
  if (pin.error != ErrorId::none) json["error"] = error_literal(static_cast<unsigned>(pin.error));
  json["text"] = pin.text;
  return json;
}

nlohmann::ordered_json block_json(const BlockType& type, const Pin* only) {
  const auto block = type.create();
  nlohmann::ordered_json json{
      {"kind", "function_block"}, {"name", type.name}, {"text", type.text}, {"source", type.source}};
  auto& pins = json["pins"] = nlohmann::ordered_json::array();
  for (const Pin& pin : type.pins)
    if (only == nullptr || only == &pin) pins.push_back(pin_json(pin, *block));
  return json;
}

}  // namespace

Subject block_subject(const BlockType& type, const Pin* pin) {
  return {[&type, pin](std::size_t width) { return block_text(type, pin, width); },
          [&type, pin] { return block_json(type, pin); }};
}

}  // namespace lockstep::cli
