#include "projects/loader/linmot_changes.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "projects/json/document.hpp"
#include "projects/json/fields.hpp"

namespace lockstep {
namespace {

/// Names of parameters and directories may be spelled in small letters too.
const JsonValue* member_of(const JsonValue& json, std::string_view name) {
  if (json.kind != JsonKind::object) return nullptr;
  const auto found = std::ranges::find_if(
      json.members, [name](const JsonValue::Member& member) { return same_name(member.key, name); });
  return found == json.members.end() ? nullptr : found->value;
}

/// The drive of a motor in a text, nullptr: it is not there.
const JsonValue* drive_in(const JsonValue& root, std::string_view controller, std::size_t motor) {
  const JsonValue* const objects = root.find("technology_objects");
  const JsonValue* value = objects != nullptr ? objects->find(controller) : nullptr;
  const std::string drive = std::string("Drive ") + static_cast<char>('A' + motor);
  for (const std::string_view name :
       {std::string_view("config"), std::string_view("Drives"), std::string_view(drive)})
    if (value != nullptr) value = member_of(*value, name);
  return value;
}

/// Puts a number in its place. @return its line
std::size_t put(std::string& text, std::string_view controller, std::size_t motor,
                const ControlParameter& parameter) {
  const JsonDocument document(text);
  const JsonValue* value = document.usable() ? drive_in(document.root(), controller, motor) : nullptr;
  if (value == nullptr || value->kind != JsonKind::object)
    throw std::runtime_error(
        "the drive of that motor does not stand in this file itself; allowed: the file in "
        "which it stands");
  const std::array<std::string, 2> path = {"Control Parameters", std::string(parameter.name)};
  std::size_t depth = 0;
  for (const JsonValue* next = value; depth < path.size(); ++depth, value = next)
    if ((next = member_of(*value, path[depth])) == nullptr) break;
  const std::string number = decimal_text(parameter.value);
  if (depth == path.size()) {
    if (value->kind != JsonKind::number)
      throw std::runtime_error(path[1] + " is no number there; allowed: one that can give way");
    const std::size_t line = value->position().line;
    text.replace(value->begin(), value->text.size(), number);
    return line;
  }
  if (value->kind != JsonKind::object)
    throw std::runtime_error(path[0] + " is no directory there; allowed: one with parameters");
  std::string added = number;
  for (std::size_t i = path.size(); i-- > depth;) {
    added = "\"" + path[i] + "\": " + added;
    if (i > depth) added = "{ " + added + " }";
  }
  const std::size_t line = value->position().line;
  text.insert(value->begin() + 1, " " + added + (value->members.empty() ? " " : ","));
  return line;
}

}  // namespace

ChangedText with_control_parameters(std::string text, std::string_view controller, std::size_t motor,
                                    std::span<const ControlParameter> parameters) {
  ChangedText changed{std::move(text), {}};
  for (const ControlParameter& parameter : parameters)
    changed.lines.push_back(put(changed.text, controller, motor, parameter));
  return changed;
}

}  // namespace lockstep
