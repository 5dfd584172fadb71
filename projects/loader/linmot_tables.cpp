#include "projects/loader/linmot_tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "projects/keys/linmot.hpp"
#include "projects/loader/linmot_curves.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

using linmot::kMotors;

std::vector<std::string_view> command_names() {
  std::vector<std::string_view> names;
  for (const linmot::MtRow& row : linmot::mt_commands())
    if (row.scope == linmot::MtScope::linear_motor) names.push_back(row.name);
  return names;
}

Range range_of_argument(const linmot::MtArgument& argument) {
  if (argument.unit == "mm") return {-2520.0, 2520.0};
  if (argument.unit == "m/s") return {0.0001, 4.6875};
  if (argument.unit == "m/s²") return {0.2, 366.2109375};
  if (argument.unit == "A") return argument.name == "Current offset" ? Range{-6.0, 6.0} : Range{0.0, 6.0};
  if (argument.unit == "%") return {0.0, 100.0};
  if (argument.unit == "A/mm") return {0.0, 76.5};
  if (argument.unit == "A/(mm s)") return {0.0, 1491.648};
  if (argument.unit == "A/(m/s)") return {0.0, 489.6};
  return argument.unit.empty() ? Range{0.0, 63.0} : Range{0.0, 3264.0};
}

class TableLoader {
 public:
  TableLoader(LinMotController& controller, const Loading& loading)
      : controller_(controller), problems_(loading.problems) {}

  void load_row(const std::string& name, const JsonValue& json);

 private:
  void load_cell(const std::string& motor, const JsonValue& json, linmot::StateRow& row);
  void load_arguments(const JsonValue& json, const linmot::MtRow& command, linmot::Cell& cell);

  LinMotController& controller_;
  Problems& problems_;
};

void TableLoader::load_arguments(const JsonValue& json, const linmot::MtRow& command, linmot::Cell& cell) {
  if (read_array(&json, problems_) == nullptr) return;
  std::string wanted;
  for (std::size_t i = 0; i < command.arity(); ++i) {
    const linmot::MtArgument& argument = command.arguments[i];
    wanted += (i == 0 ? "" : ", ") + std::string(argument.name);
    if (!argument.unit.empty()) wanted += " [" + std::string(argument.unit) + "]";
  }
  if (json.elements.size() != command.arity())
    return problems_.report(json, std::string(command.name) + " takes [" + wanted + "]");
  for (std::size_t i = 0; i < command.arity(); ++i) {
    const Range range = range_of_argument(command.arguments[i]);
    if (const auto value = read_number(json.elements[i], range.lowest, range.highest, problems_))
      cell.arguments[i] = *value;
  }
  const bool curve = command.arguments[0].name == "Curve number";
  const auto number = static_cast<std::size_t>(cell.arguments[0]);
  if (curve && number != 0 && !controller_.curves[number].exists())
    problems_.report(json, "there is no curve " + std::to_string(number));
}

void TableLoader::load_cell(const std::string& motor, const JsonValue& json, linmot::StateRow& row) {
  const std::size_t index = linmot_motor(motor);
  if (index >= kMotors)
    return problems_.report_key(json, "there is no motor " + quote(motor) + "; allowed: A, B, C, D");
  if (controller_.data.Motors[index].Parameters.type == linmot::kNoDrive)
    return problems_.report_key(json, "Drive " + motor + " is 'No Drive' and does nothing");
  if (read_object(&json, problems_) == nullptr) return;
  if (json.members.size() != 1)
    return problems_.report(json, "a motor does one thing in a row; allowed: one command with its arguments");
  const auto& [name, arguments] = json.members.front();
  const linmot::MtRow* const command = linmot::find_mt_command(name);
  const std::vector<std::string_view> names = command_names();
  if (command == nullptr)
    return problems_.report_key(*arguments, "there is no command " + quote(name) + did_you_mean(name, names) +
                                                "; allowed: " + list_of(names));
  if (command->scope != linmot::MtScope::linear_motor)
    return problems_.report_key(
        *arguments,
        std::string(command->name) +
            (command->scope == linmot::MtScope::magnet_only ? " is one of magnets" : " is not built yet") +
            "; allowed: " + list_of(names));
  row.cells[index].command = command->command;
  load_arguments(*arguments, *command, row.cells[index]);
}

void TableLoader::load_row(const std::string& name, const JsonValue& json) {
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size() || number < 0 || number >= linmot::kStates)
    return problems_.report_key(json, quote(name) + " is no row; allowed: 0 to 63");
  linmot::StateRow& row = controller_.table.rows[static_cast<std::size_t>(number)];
  row.exists = true;
  if (read_object(&json, problems_) == nullptr) return;
  for (const auto& [motor, cell] : json.members) load_cell(motor, *cell, row);
}

std::uint8_t read_inputs(const JsonValue* json, Problems& problems) {
  const auto text = read_string(json, problems);
  if (!text) return 0;
  std::uint8_t bits = 0;
  for (const char c : *text) {
    if (c < 'A' || c > 'D') {
      problems.report(*json, json->shown() + " are no inputs; allowed: some of ABCD");
      return 0;
    }
    bits |= static_cast<std::uint8_t>(1u << (c - 'A'));
  }
  return bits;
}

/// Such as 0010, the inputs from D to A.
std::optional<std::uint8_t> code_of(const std::string& text) {
  if (text.size() != kMotors) return std::nullopt;
  std::uint8_t code = 0;
  for (const char c : text) {
    if (c != '0' && c != '1') return std::nullopt;
    code = static_cast<std::uint8_t>(code * 2 + (c - '0'));
  }
  return code;
}

void load_code(const std::string& name, const JsonValue& json, LinMotController& controller,
               Problems& problems) {
  const auto code = code_of(name);
  if (!code)
    return problems.report_key(json, quote(name) +
                                         " is no code; allowed: four of 0 and 1, inputs D to A, or "
                                         "active_inputs, active_triggers");
  if ((*code & ~controller.table.active) != 0)
    return problems.report_key(json, "the code " + name + " needs an input that is not among active_inputs");
  linmot::CodeEntry& entry = controller.table.codes[*code];
  const bool to_row = json.kind == JsonKind::array && json.elements.size() == 2;
  const JsonValue& word = to_row ? *json.elements[0] : json;
  std::vector<std::string_view> names;
  for (const linmot::InputRow& row : linmot::input_commands()) names.push_back(row.name);
  const auto command = read_word(&word, names, problems);
  if (!command) return;
  entry.command = linmot::input_commands()[*command].command;
  if ((entry.command == linmot::InputCommand::go_to) != to_row)
    return problems.report(json, R"(allowed: ["Goto state", row], and other commands without a row)");
  if (!to_row) return;
  const auto row = read_integer(json.elements[1], 0, linmot::kStates - 1, problems);
  if (!row) return;
  entry.row = static_cast<int>(*row);
  if (!controller.table.rows[static_cast<std::size_t>(*row)].exists)
    problems.report(*json.elements[1], "there is no row " + std::to_string(*row) + " in state_table");
}

// ---- PROFIBUS

class ModuleLoader {
 public:
  ModuleLoader(LinMotController& controller, const Loading& loading)
      : controller_(controller), problems_(loading.problems) {}

  void add(const JsonValue& json) {
    const auto name = read_string(&json, problems_);
    if (!name) return;
    const linmot::ModuleRow* const row = linmot::find_module(*name);
    std::vector<std::string_view> names;
    for (const linmot::ModuleRow& one : linmot::modules()) names.push_back(one.name);
    if (row == nullptr)
      return problems_.report(
          json, json.shown() + " is no module" + did_you_mean(*name, names) + "; allowed: " + list_of(names));
    auto& image = controller_.image;
    const bool status = row->module == linmot::Module::control_status;
    if (image.places.empty() != status && (image.places.empty() || !status)) {
      if (image.places.empty()) return problems_.report(json, "Control/Status is the first module");
    }
    const bool next = row->module == linmot::Module::next_drive || (status && !image.places.empty());
    if (next && ++motor_ >= kMotors) return problems_.report(json, "there is no motor behind D");
    if (!next && is_there(row->module)) return problems_.report(json, json.shown() + " is there already");
    if (image.out_words + row->out_words > static_cast<int>(LinMotData::kWords)) return;
    image.places.push_back({row->module, static_cast<std::uint8_t>(std::min(motor_, kMotors - 1)),
                            image.out_words, image.in_words});
    image.out_words = static_cast<std::uint8_t>(image.out_words + row->out_words);
    image.in_words = static_cast<std::uint8_t>(image.in_words + row->in_words);
  }

  void preset(const std::string& name, const JsonValue& json) {
    const linmot::ModuleRow* const row = linmot::find_module(name);
    if (row == nullptr || row->lowest == row->highest || row->out_words == 0)
      return problems_.report_key(json, quote(name) + " is no module with a value");
    const auto value = read_integer(&json, row->lowest, row->highest, problems_);
    if (!value) return;
    for (const linmot::ModulePlace& place : controller_.image.places)
      if (place.module == row->module)
        controller_.data.ProfibusOut[place.out] = WORD{static_cast<std::uint16_t>(*value & 0xFFFF)};
  }

 private:
  /// Command once in all, others once for each motor.
  bool is_there(linmot::Module module) const {
    return std::ranges::any_of(controller_.image.places, [&](const linmot::ModulePlace& place) {
      return place.module == module && (place.motor == motor_ || module == linmot::Module::command);
    });
  }

  LinMotController& controller_;
  Problems& problems_;
  std::size_t motor_ = 0;
};

}  // namespace

void load_state_table(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  if (read_object(&json, loading.problems) == nullptr) return;
  TableLoader loader(controller, loading);
  for (const auto& [name, row] : json.members) loader.load_row(name, *row);
}

void load_input_table(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  if (read_object(&json, loading.problems) == nullptr) return;
  controller.table.active = 0xF;
  if (const JsonValue* const active = json.find("active_inputs"))
    controller.table.active = read_inputs(active, loading.problems);
  controller.table.triggers = controller.table.active;
  if (const JsonValue* const triggers = json.find("active_triggers"))
    controller.table.triggers = read_inputs(triggers, loading.problems);
  for (const auto& [name, code] : json.members)
    if (name != "active_inputs" && name != "active_triggers")
      load_code(name, *code, controller, loading.problems);
}

void load_linmot_profibus(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  const Fields fields(json, keys::kLinMotProfibus, loading.problems);
  const JsonValue* const modules = fields["modules"];
  if (read_array(modules, loading.problems) == nullptr) return;
  ModuleLoader loader(controller, loading);
  for (const JsonValue* const module : modules->elements) loader.add(*module);
  if (const JsonValue* const preset = fields["preset"]; read_object(preset, loading.problems) != nullptr)
    for (const auto& [name, value] : preset->members) loader.preset(name, *value);
}

}  // namespace lockstep
