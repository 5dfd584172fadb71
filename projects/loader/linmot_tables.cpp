#include "projects/loader/linmot_tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "projects/json/named_file.hpp"
#include "projects/json/text_file.hpp"
#include "projects/keys/linmot.hpp"
#include "projects/loader/linmot_curves.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/linmot_catalogue/spelling.hpp"

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

/// A row by its number; nullptr: it is none.
linmot::StateRow* row_of(std::string_view number, linmot::StateTable& table) {
  int row = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), row);
  if (error != std::errc{} || end != number.data() + number.size() || row < 0 || row >= linmot::kStates)
    return nullptr;
  return &table.rows[static_cast<std::size_t>(row)];
}

/// Why a command may not stand in a cell; empty: it may.
std::string refusal_of(const linmot::MtRow& command) {
  if (command.scope == linmot::MtScope::linear_motor) return "";
  const bool magnets = command.scope == linmot::MtScope::magnet_only;
  const std::vector<std::string_view> names = command_names();
  return std::string(command.name) + (magnets ? " is one of magnets" : " is not built yet") +
         "; allowed: " + list_of(names);
}

std::string arguments_of(const linmot::MtRow& command) {
  std::string text;
  for (std::size_t i = 0; i < command.arity(); ++i) {
    const linmot::MtArgument& argument = command.arguments[i];
    text += (i == 0 ? "" : ", ") + std::string(argument.name);
    if (!argument.unit.empty()) text += " [" + std::string(argument.unit) + "]";
  }
  return std::string(command.name) + " takes [" + text + "]";
}

/// The curve that a cell calls and that is not there; 0: none.
std::size_t missing_curve(const linmot::MtRow& command, const linmot::Cell& cell,
                          const LinMotController& controller) {
  if (command.arguments[0].name != "Curve number") return 0;
  const auto number = static_cast<std::size_t>(cell.arguments[0]);
  return number != 0 && !controller.curves[number].exists() ? number : 0;
}

/// That the cell holds a position which protocols do not have; empty: they have it.
std::string reach_finding(const linmot::MtRow& command, const linmot::Cell& cell) {
  constexpr double kReach = linmot::kPositionReach * linmot::kPositionIncrement;
  if (command.arity() == 0 || command.arguments[0].name != "Position") return "";
  if (std::abs(cell.arguments[0]) <= kReach) return "";
  return decimal_text(cell.arguments[0]) + " mm lies outside of the positions that protocols have, ±630 mm";
}

std::string there_already(std::string_view row) {
  int number = 0;
  std::from_chars(row.data(), row.data() + row.size(), number);
  return "row " + std::to_string(number) + " is there already";
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
  if (json.elements.size() != command.arity()) return problems_.report(json, arguments_of(command));
  for (std::size_t i = 0; i < command.arity(); ++i) {
    const Range range = range_of_argument(command.arguments[i]);
    if (command.arguments[i].unit.empty()) {
      if (const auto number = read_integer(json.elements[i], static_cast<std::int64_t>(range.lowest),
                                           static_cast<std::int64_t>(range.highest), problems_))
        cell.arguments[i] = static_cast<double>(*number);
    } else if (const auto value = read_number(json.elements[i], range.lowest, range.highest, problems_)) {
      cell.arguments[i] = *value;
    }
  }
  if (const std::size_t number = missing_curve(command, cell, controller_); number != 0)
    problems_.report(json, "there is no curve " + std::to_string(number));
  if (const std::string finding = reach_finding(command, cell); !finding.empty())
    problems_.warn(*json.elements[0], finding);
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
  if (const std::string refusal = refusal_of(*command); !refusal.empty())
    return problems_.report_key(*arguments, refusal);
  row.cells[index].command = command->command;
  load_arguments(*arguments, *command, row.cells[index]);
}

void TableLoader::load_row(const std::string& name, const JsonValue& json) {
  linmot::StateRow* const row = row_of(name, controller_.table);
  if (row == nullptr)
    return problems_.report_key(json, quote(name) + " is no row; allowed: 0 to 63, or file");
  if (std::exchange(row->exists, true)) return problems_.report_key(json, there_already(name));
  if (read_object(&json, problems_) == nullptr) return;
  for (const auto& [motor, cell] : json.members) load_cell(motor, *cell, *row);
}

// ---- The same as a table in a file

/// A cell as it is written: a command and its arguments, with their units or without.
struct CellText {
  const linmot::MtRow* command = nullptr;
  std::vector<double> arguments;
};

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// The command whose name the text begins with, the longest of them, which is taken off.
const linmot::MtRow* take_command(std::string_view& text) {
  const linmot::MtRow* found = nullptr;
  for (const linmot::MtRow& row : linmot::mt_commands()) {
    const std::size_t length = row.name.size();
    if (text.size() < length || !linmot::same_spelling(text.substr(0, length), row.name)) continue;
    const bool ends = text.size() == length || text[length] == ' ';
    if (ends && (found == nullptr || length > found->name.size())) found = &row;
  }
  if (found != nullptr) text = trimmed(text.substr(found->name.size()));
  return found;
}

/// The command is nullptr where the text is no cell.
CellText cell_of(std::string_view text) {
  CellText cell{take_command(text), {}};
  for (std::size_t i = 0; cell.command != nullptr && !text.empty(); ++i) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || i >= cell.command->arity()) return {};
    text = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
    if (const std::string_view unit = cell.command->arguments[i].unit;
        !unit.empty() && text.starts_with(unit))
      text = trimmed(text.substr(unit.size()));
    if (!text.empty() && text[0] != ',') return {};
    text = text.empty() ? text : trimmed(text.substr(1));
    cell.arguments.push_back(value);
  }
  return cell;
}

/// state;A;B in its first line, then a row in each. Every fault names its line.
class TableFile {
 public:
  TableFile(std::string path, const JsonValue& json, LinMotController& controller, Problems& problems)
      : path_(std::move(path)), json_(json), controller_(controller), problems_(problems) {}

  void load() {
    const std::string text = read_text_file(path_, kLargestTable);
    if (text.size() > kLargestTable) return report("has more than 1 MiB");
    for (std::string_view rest = without_mark(text); !rest.empty();) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
      ++line_;
      if (trimmed(line).empty()) continue;
      if (motors_.empty() ? !take_heading(line) : !take_row(line)) return;
    }
  }

 private:
  static constexpr std::size_t kLargestTable = 1 << 20;

  void report(const std::string& text) {
    problems_.report(json_, path_ + ":" + std::to_string(line_) + ": " + text);
  }
  static std::vector<std::string_view> columns_of(std::string_view line) {
    std::vector<std::string_view> columns;
    for (;;) {
      const auto end = line.find(';');
      columns.push_back(trimmed(line.substr(0, end)));
      if (end == line.npos) return columns;
      line.remove_prefix(end + 1);
    }
  }
  bool take_heading(std::string_view line) {
    const std::vector<std::string_view> names = columns_of(line);
    for (std::size_t i = 1; i < names.size(); ++i) motors_.push_back(linmot_motor(names[i]));
    const bool good =
        names[0] == "state" && !motors_.empty() && std::ranges::none_of(motors_, [this](std::size_t motor) {
          return motor >= kMotors || std::ranges::count(motors_, motor) > 1;
        });
    if (!good) report("allowed as the first line: state;A;B;C;D, or some of these motors");
    return good;
  }
  bool take_row(std::string_view line) {
    const std::vector<std::string_view> cells = columns_of(line);
    linmot::StateRow* const row = row_of(cells[0], controller_.table);
    if (row == nullptr) report(quote(cells[0]) + " is no row; allowed: 0 to 63");
    if (cells.size() > motors_.size() + 1) report("has more cells than the first line");
    if (row == nullptr || cells.size() > motors_.size() + 1) return false;
    if (std::exchange(row->exists, true)) {
      report(there_already(cells[0]));
      return false;
    }
    for (std::size_t i = 1; i < cells.size(); ++i)
      if (!cells[i].empty()) take_cell(cells[i], motors_[i - 1], *row);
    return true;
  }
  void take_cell(std::string_view text, std::size_t motor, linmot::StateRow& row) {
    const CellText found = cell_of(text);
    const std::vector<std::string_view> names = command_names();
    if (found.command == nullptr)
      return report(quote(text) +
                    " is no command with its arguments, such as Abs. Position 5, 0.5, 10; "
                    "allowed: " +
                    list_of(names));
    if (const std::string refusal = refusal_of(*found.command); !refusal.empty()) return report(refusal);
    if (found.arguments.size() != found.command->arity()) return report(arguments_of(*found.command));
    if (controller_.data.Motors[motor].Parameters.type == linmot::kNoDrive &&
        found.command->command != linmot::MtCommand::no_operation)
      return report("Drive " + std::string(1, static_cast<char>('A' + motor)) +
                    " is 'No Drive' and does nothing");
    linmot::Cell& cell = row.cells[motor];
    cell.command = found.command->command;
    for (std::size_t i = 0; i < found.arguments.size(); ++i) {
      const Range range = range_of_argument(found.command->arguments[i]);
      const bool whole =
          !found.command->arguments[i].unit.empty() || found.arguments[i] == std::floor(found.arguments[i]);
      if (!range.allows(found.arguments[i]) || !whole)
        return report(quote(text) + ": " + std::string(found.command->arguments[i].name) +
                      " is allowed from " + decimal_text(range.lowest) + " to " +
                      decimal_text(range.highest));
      cell.arguments[i] = found.arguments[i];
    }
    if (const std::size_t number = missing_curve(*found.command, cell, controller_); number != 0)
      report("there is no curve " + std::to_string(number));
    if (const std::string finding = reach_finding(*found.command, cell); !finding.empty())
      problems_.warn(json_, path_ + ":" + std::to_string(line_) + ": " + finding);
  }

  std::string path_;
  const JsonValue& json_;
  LinMotController& controller_;
  Problems& problems_;
  std::vector<std::size_t> motors_;  // of the columns
  int line_ = 0;
};

void load_table_file(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  if (!read_string(&json, loading.problems)) return;
  try {
    if (const auto path = named_file(json, loading.folder, loading.folder, loading.problems))
      TableFile(*path, json, controller, loading.problems).load();
  } catch (const UnreadableFile& error) {
    loading.problems.report(json, error.what());
  }
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
  for (const auto& [name, row] : json.members) {
    if (name == "file")
      load_table_file(*row, controller, loading);
    else
      loader.load_row(name, *row);
  }
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

namespace {

/// Two hexadecimal figures, as the switches have them. EE is for a start without a bus: the motors repeat
/// their curves.
void load_bus_address(const JsonValue& json, LinMotController& controller, Problems& problems) {
  constexpr int kHighest = 125, kCommissioning = 0xEE;
  const auto text = read_string(&json, problems);
  if (!text) return;
  int address = -1;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), address, 16);
  const bool whole = error == std::errc{} && end == text->data() + text->size() && text->size() == 2;
  if (!whole || (address > kHighest && address != kCommissioning) || address < 0)
    return problems.report(json, json.shown() + " is no address; allowed: 00 to 7D, and EE to repeat curves");
  if (address != kCommissioning) return;
  for (LinMotMotorData& motor : controller.data.Motors)
    motor.Parameters.run_mode = static_cast<DINT>(linmot::RunMode::continuous_curve);
}

}  // namespace

void load_linmot_profibus(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  const Fields fields(json, keys::kLinMotProfibus, loading.problems);
  if (const JsonValue* const address = fields["address"])
    load_bus_address(*address, controller, loading.problems);
  const JsonValue* const modules = fields["modules"];
  if (read_array(modules, loading.problems) == nullptr) return;
  ModuleLoader loader(controller, loading);
  for (const JsonValue* const module : modules->elements) loader.add(*module);
  if (const JsonValue* const preset = fields["preset"]; read_object(preset, loading.problems) != nullptr)
    for (const auto& [name, value] : preset->members) loader.preset(name, *value);
}

}  // namespace lockstep
