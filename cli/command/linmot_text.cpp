#include "cli/command/linmot_text.hpp"

#include <fmt/format.h>

#include <string_view>

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

/// What the motors keep to.
std::string limits_text(const LinMotController& controller) {
  std::string text;
  for (std::size_t i = 0; i < linmot::kMotors; ++i) {
    const linmot::MotorParameters& motor = controller.data.Motors[i].Parameters;
    if (motor.type == linmot::kNoDrive) continue;
    text += fmt::format(
        "  {}  Max Speed {:.6g} m/s, Max Acceleration {:.6g} m/s², Init Speed {:.6g} m/s, in an emergency "
        "{:.6g} m/s, {:.6g} m/s²\n",
        static_cast<char>('A' + i), counting(motor.max_speed, "m/s"),
        counting(motor.max_acceleration, "m/s²"), counting(motor.init_speed, "m/s"),
        counting(motor.emergency_max_speed, "m/s"), counting(motor.emergency_max_acceleration, "m/s²"));
  }
  return text;
}

}  // namespace

std::string linmot_table_csv(const LinMotController& controller) {
  std::string text = "state;A;B;C;D\n";
  for (std::size_t number = 0; number < controller.table.rows.size(); ++number) {
    const linmot::StateRow& row = controller.table.rows[number];
    if (!row.exists) continue;
    text += std::to_string(number);
    for (const linmot::Cell& cell : row.cells)
      text += cell.command == linmot::MtCommand::no_operation ? ";" : ";" + cell_text(cell);
    text += "\n";
  }
  return text;
}

std::string linmot_table_text(const LinMotController& controller) {
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

std::string linmot_counting(const Project& project) {
  std::string text;
  for (const auto& object : project.controller->objects) {
    if (object->kind != ObjectKind::LinMot_Controller) continue;
    const auto& controller = static_cast<const LinMotController&>(*object);
    text += linmot_table_text(controller) + limits_text(controller);
  }
  return text;
}

}  // namespace lockstep::cli
