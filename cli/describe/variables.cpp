// lockstep describe: the variables of technology objects.
#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "projects/expressions/names.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

struct EffectText {
  std::string_view name, text;
};
constexpr EffectText kEffects[] = {
    {"DIR", "set by programs too; takes effect from the next MC_Servo"},
    {"CAL", "set by programs too; takes effect from the next call of the instruction concerned"},
    {"RES", "takes effect only with a restart of the object; set in the project's config"},
    {"RON", "read-only at run time"},
};

const EffectText& effect_of(const Variable& variable) {
  return kEffects[static_cast<std::size_t>(variable.effect)];
}

std::string access_text(const Variable& variable) {
  if (variable.computed) return "read-only, computed by the runtime";
  if (variable.effect == Effect::RON) return "read-only at run time, set in the project's config";
  return std::string(effect_of(variable).text);
}

/// The path as it is shown: `Sensor[1..4].Type`.
std::string shown_path(const Variable& variable) {
  std::string path(variable.path);
  const auto brackets = path.find("[]");
  if (brackets != path.npos) path.insert(brackets + 1, "1.." + std::to_string(variable.count));
  return path;
}

/// Start value of an element, counted from 0.
Value start_value(const Variable& variable, std::size_t element = 0) {
  return variable.type == Type::TAG ? Value{} : variable.start_value(element);
}

/// Elements whose start values have to be told: all of an array if they differ, else one.
std::size_t told_elements(const Variable& variable) {
  for (std::size_t i = 1; i < variable.count; ++i)
    if (literal(start_value(variable, i), variable.type) != literal(start_value(variable), variable.type))
      return variable.count;
  return 1;
}

std::string default_text(const Variable& variable) {
  std::string text;
  for (std::size_t i = 0; i < told_elements(variable); ++i)
    text += (i == 0 ? "" : ", ") + literal(start_value(variable, i), variable.type);
  return text;
}

nlohmann::ordered_json default_json(const Variable& variable) {
  if (told_elements(variable) == 1) return json_value(start_value(variable), variable.type);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < variable.count; ++i)
    list.push_back(json_value(start_value(variable, i), variable.type));
  return list;
}

std::string allowed_text(const Variable& variable) {
  const bool told = variable.choices.empty() && variable.type != Type::TAG;
  return told ? range_text(variable.type, variable.range) : "";
}

/// What a path names: variables, and a bit if it is one of a word.
struct Selection {
  std::vector<const Variable*> variables;
  int bit = -1;
  bool whole = false;     // a single variable, named in full
  ObjectKinds kinds = 0;  // of the objects that have them, where none is named
};

/// Takes the index out of a path, and the brackets with it. @return the index; 0 if there is none
std::size_t take_index(std::string& path) {
  const auto open = path.find('[');
  const auto close = path.find(']', open);
  if (open == path.npos || close == path.npos) return 0;
  std::size_t index = 0;
  std::from_chars(path.data() + open + 1, path.data() + close, index);
  path.erase(open, close + 1 - open);
  return index;
}

Selection select(ObjectKind kind, std::string_view path) {
  Selection selection;
  if (const VariableAddress place = find_variable(kind, path); place.variable != nullptr)
    return {{place.variable}, place.bit, true, 0};
  std::string wanted = fold(path);
  const std::size_t index = take_index(wanted);
  for (const auto list : data_block_of(kind).lists()) {
    for (const Variable& variable : list) {
      std::string name = fold(variable.path);
      take_index(name);
      if (name == wanted && index == 0) return {{&variable}, -1, true, 0};
      const bool below = wanted.empty() || name.starts_with(wanted + ".");
      if (below && index <= variable.count) selection.variables.push_back(&variable);
    }
  }
  return selection;
}

std::string bit_name(const Variable& variable, int bit) {
  const std::string_view name =
      variable.bits == nullptr ? std::string_view{} : (*variable.bits)[static_cast<std::size_t>(bit)];
  return name.empty() ? "reserved" : std::string(name);
}

/// What a path names in objects of any kind. The synchronous axis answers for those that have less of the
/// same.
Selection select(std::string_view path) {
  Selection selection;
  ObjectKinds kinds = 0;
  for (const ObjectKindText& known : kObjectKinds) {
    Selection found = select(known.kind, path);
    if (found.variables.empty()) continue;
    const bool reserved = found.bit >= 0 && bit_name(*found.variables.front(), found.bit) == "reserved";
    if (!reserved) kinds = kinds | known.kind;
    if (selection.variables.empty() || known.kind == ObjectKind::TO_SynchronousAxis)
      selection = std::move(found);
  }
  selection.kinds = kinds;
  return selection;
}

ObjectKind kind_called(std::string_view name) {
  for (const ObjectKindText& known : kObjectKinds)
    if (known.name == name) return known.kind;
  return ObjectKind::TO_SynchronousAxis;  // never: the name is one of the list
}

std::string_view group_of(const Variable& variable) {
  const auto end = variable.path.find_first_of(".[");
  return end == variable.path.npos ? std::string_view{} : variable.path.substr(0, end);
}

std::vector<std::string> bit_lines(const Variable& variable) {
  std::vector<std::string> lines;
  if (variable.bits == nullptr) return lines;
  for (int bit = 0; bit < 8 * size_of(variable.type); ++bit)
    if (const std::string name = bit_name(variable, bit); name != "reserved")
      lines.push_back("X" + std::to_string(bit) + " " + name);
  return lines;
}

constexpr std::string_view kLater = "declared; its function comes later";

void add_row(Table& table, const Variable& variable, std::size_t group_length) {
  table.row({shown_path(variable).substr(group_length),
             variable.type == Type::TAG ? "VREF" : std::string(type_name(variable.type)),
             literal(start_value(variable), variable.type), std::string(unit_text(variable.unit)),
             std::string(effect_of(variable).name), std::string(variable.text)});
  for (const std::string& line : choice_lines(variable.type, variable.choices)) table.note(line);
  if (const std::string allowed = allowed_text(variable); !allowed.empty()) table.note("allowed: " + allowed);
  std::string bits;
  for (const std::string& line : bit_lines(variable)) bits += (bits.empty() ? "" : ", ") + line;
  if (!bits.empty()) table.note(bits);
  if (variable.later) table.note("(" + std::string(kLater) + ")");
}

std::string list_text(const std::vector<const Variable*>& variables, std::size_t width) {
  std::string text;
  const std::string_view none = "\n";  // no group has this name
  std::string_view group = none;
  Table table({"", "", "", "", "", ""});
  const auto finish = [&] {
    if (!table.empty()) text += table.text(group.empty() ? 0 : 2, width);
    table = Table({"", "", "", "", "", ""});
  };
  for (const Variable* const variable : variables) {
    if (const std::string_view own = group_of(*variable); own != group) {
      finish();
      text += "\n" + (own.empty() ? "" : std::string(own) + "\n");
      group = own;
    }
    const bool array = variable->path.substr(group.size()).starts_with('[');
    add_row(table, *variable, group.empty() ? 0 : group.size() + (array ? 0 : 1));
  }
  finish();
  return text;
}

std::string legend(std::size_t width) {
  Table table({"", ""});
  table.row({"u", "unit of the axis, as mm or °; u (leading): that of the leading axis"});
  for (const EffectText& effect : kEffects) table.row({std::string(effect.name), std::string(effect.text)});
  table.row({"VREF", "takes the name of a BOOL tag"});
  return "\n" + table.text(0, width);
}

std::string single_text(const Variable& variable, std::size_t width) {
  Table table({"", ""});
  const auto add = [&table](const char* what, std::vector<std::string> lines) {
    std::erase(lines, "");
    if (lines.empty()) return;
    table.row({what, ""});
    for (std::string& line : lines) table.note(std::move(line));
  };
  add("Type", {variable.type == Type::TAG ? "VREF: takes the name of a BOOL tag"
                                          : std::string(type_name(variable.type))});
  add("Default", {default_text(variable)});
  add("Unit", {std::string(unit_text(variable.unit))});
  add("Allowed", {allowed_text(variable)});
  add("Values", choice_lines(variable.type, variable.choices));
  add("Effect", {std::string(effect_of(variable).name) + ": " + access_text(variable)});
  add("Bits", bit_lines(variable));
  add("Note", {variable.later ? std::string(kLater) : ""});
  return paragraph(variable.text, 2, width) + "\n" + table.text(2, width);
}

std::string selection_text(const std::string& title, const std::string& about, const Selection& selection,
                           std::size_t width) {
  std::string text = title + "\n";
  if (!about.empty()) text += paragraph(about, 2, width);
  if (selection.bit >= 0) {
    const Variable& word = *selection.variables.front();
    return text + paragraph(bit_name(word, selection.bit), 2, width) +
           paragraph("BOOL, a bit of " + shown_path(word) + ": " + std::string(word.text), 2, width);
  }
  if (selection.whole) return text + single_text(*selection.variables.front(), width);
  return text + list_text(selection.variables, width) + legend(width);
}

nlohmann::ordered_json variable_json(const Variable& variable) {
  nlohmann::ordered_json json{{"path", variable.path},
                              {"type", variable.type == Type::TAG ? "VREF" : type_name(variable.type)}};
  if (variable.count != 0) json["elements"] = variable.count;
  json["default"] = default_json(variable);
  add_declaration(json, variable.type, variable.unit, variable.range, variable.choices);
  json["effect"] = effect_of(variable).name;
  json["computed"] = variable.computed;
  if (variable.bits != nullptr) {
    auto& bits = json["bits"] = nlohmann::ordered_json::object();
    for (int bit = 0; bit < 8 * size_of(variable.type); ++bit)
      if (const std::string name = bit_name(variable, bit); name != "reserved")
        bits["X" + std::to_string(bit)] = name;
  }
  json["text"] = variable.text;
  json["later"] = variable.later;
  return json;
}

nlohmann::ordered_json selection_json(std::string_view object, const Selection& selection) {
  nlohmann::ordered_json json{{"kind", "variables"}};
  auto& objects = json["objects"] = nlohmann::ordered_json::array();
  for (const ObjectKindText& known : kObjectKinds)
    if (object.empty() ? among(known.kind, selection.kinds) : object == known.name)
      objects.push_back(known.name);
  if (selection.bit >= 0) {
    json["bit"] = "X" + std::to_string(selection.bit);
    json["name"] = bit_name(*selection.variables.front(), selection.bit);
  }
  auto& variables = json["variables"] = nlohmann::ordered_json::array();
  for (const Variable* const variable : selection.variables) variables.push_back(variable_json(*variable));
  return json;
}

}  // namespace

Subject variables_subject(std::string_view object, std::string_view path) {
  std::string about;
  for (const ObjectKindText& known : kObjectKinds)
    if (object == known.name) about = known.text;
  const Selection selection = object.empty() ? select(path) : select(kind_called(object), path);
  if (selection.variables.empty()) return {};
  std::string title(object);
  if (!path.empty()) {
    std::string name = selection.whole ? shown_path(*selection.variables.front()) : std::string(path);
    if (selection.bit >= 0) name += ".X" + std::to_string(selection.bit);
    title += (title.empty() ? "" : ".") + name;
    about = object.empty() ? "of every " + kind_names(selection.kinds) : "";
  }
  return {[=](std::size_t width) { return selection_text(title, about, selection, width); },
          [object = std::string(object), selection] { return selection_json(object, selection); }};
}

std::vector<std::string_view> variable_names() {
  std::vector<std::string_view> names;
  for (const ObjectKindText& known : kObjectKinds) {
    for (const Variable* const declared : select(known.kind, "").variables) {
      const Variable& variable = *declared;
      for (auto end = variable.path.find_first_of(".["); end != variable.path.npos;
           end = variable.path.find_first_of(".[", end + 1))
        if (const auto prefix = variable.path.substr(0, end); names.empty() || names.back() != prefix)
          names.push_back(prefix);
      names.push_back(variable.path);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace lockstep::cli
