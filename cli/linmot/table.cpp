// lockstep linmot table: the state table of a project, as it counts.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "cli/command/standard_streams.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"

namespace lockstep::cli {
namespace {

/// Positions, speeds and accelerations count in whole increments.
double counting(double value, std::string_view unit) {
  if (unit == "mm") return linmot::in_whole_increments(value, linmot::kPositionIncrement);
  if (unit == "m/s") return linmot::in_whole_increments(value, linmot::kVelocityIncrement);
  if (unit == "m/s²") return linmot::in_whole_increments(value, linmot::kAccelerationIncrement);
  return value;
}

std::string cell_text(const linmot::Cell& cell) {
  const linmot::MtRow& row = linmot::mt_commands()[static_cast<std::size_t>(cell.command)];
  std::string text(row.name);
  for (std::size_t i = 0; i < row.arity(); ++i) {
    const linmot::MtArgument& argument = row.arguments[i];
    text += fmt::format("{} {:.6g}", i == 0 ? "" : ",", counting(cell.arguments[i], argument.unit));
    if (!argument.unit.empty()) text += " " + std::string(argument.unit);
  }
  return text;
}

std::string table_text(const LinMotController& controller) {
  std::string text = visible(controller.name) + "\n";
  for (std::size_t number = 0; number < controller.table.rows.size(); ++number) {
    const linmot::StateRow& row = controller.table.rows[number];
    if (!row.exists) continue;
    std::string cells;
    for (std::size_t motor = 0; motor < linmot::kMotors; ++motor)
      if (row.cells[motor].command != linmot::MtCommand::no_operation)
        cells += fmt::format("{}{}: {}", cells.empty() ? "" : "; ", static_cast<char>('A' + motor),
                             cell_text(row.cells[motor]));
    text += fmt::format("  row {:2}  {}\n", number, cells.empty() ? "No Operation" : cells);
  }
  for (std::size_t code = 0; code < controller.table.codes.size(); ++code) {
    const linmot::CodeEntry& entry = controller.table.codes[code];
    if (entry.command == linmot::InputCommand::no_operation) continue;
    text += fmt::format("  code {:04b}  {}", code,
                        linmot::input_commands()[static_cast<std::size_t>(entry.command)].name);
    text += entry.command == linmot::InputCommand::go_to ? fmt::format(" {}\n", entry.row) : "\n";
  }
  return text;
}

int tell_tables(const std::string& file) {
  int status = kOk;
  const auto project = load_or_tell(file, status);
  if (!project) return status;
  for (const auto& object : project->controller->objects)
    if (object->kind == ObjectKind::LinMot_Controller)
      write_data(table_text(static_cast<const LinMotController&>(*object)));
  return kOk;
}

}  // namespace

void add_linmot_table(CLI::App& linmot, Action& action) {
  CLI::App* command = linmot.add_subcommand("table", "Tell the state tables of a project, as they count");
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "project")->required();
  command->callback([&action, file] { action = [file] { return tell_tables(*file); }; });
}

}  // namespace lockstep::cli
