// lockstep write: values of a running project by their names, over Modbus.
#include "cli/command.hpp"
#include "cli/modbus_panel.hpp"
#include "projects/constant.hpp"

namespace lockstep::cli {
namespace {

/// What is to be written where.
struct Assignment {
  PanelEntry place;
  Value value;
};

/// Reads "NAME=VALUE", or tells what is wrong with it.
std::optional<Assignment> assignment(const ModbusPanel& panel, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == text.npos || equals == 0) {
    tell(quote(text) + " is not NAME=VALUE");
    return std::nullopt;
  }
  const auto place = panel.find(text.substr(0, equals), true);
  if (!place) return std::nullopt;
  JsonValue json;
  json.kind = JsonKind::string;
  json.text = text.substr(equals + 1);
  Problems problems;
  const auto value = read_constant(json, place->type(), problems);
  for (const Problem& problem : problems.take_errors()) tell(place->name + ": " + problem.text);
  if (!value) return std::nullopt;
  if (const std::string problem = write_problem(*place, *value); !problem.empty()) {
    tell(problem);
    return std::nullopt;
  }
  return Assignment{*place, *value};
}

int write_values(const PanelOptions& options) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(options.project, status);
  if (!project) return status;
  ModbusPanel panel(*project, options);
  std::vector<Assignment> assignments;
  for (const std::string& text : options.names)
    if (const auto one = assignment(panel, text)) assignments.push_back(*one);
  if (assignments.size() != options.names.size()) return kNotValid;
  if (!panel.connect()) return kCouldNotStart;
  for (const Assignment& one : assignments)
    if (!panel.write(one.place, one.value)) return kCouldNotStart;
  return kOk;
}

}  // namespace

void add_write_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("write", "Write values of a running project over Modbus, by name");
  auto options = std::make_shared<PanelOptions>();
  add_panel_options(*command, *options);
  command
      ->add_option("VALUES", options->names, "NAME=VALUE, such as speed=250 start=TRUE wait=1.5s mask=16#FF")
      ->required();
  command->footer(
      "Nothing is written unless every name and value is good; then they go out in their order, each in a\n"
      "request of its own.\n"
      "Exit status: 0, 1 project not valid, no such name or value, 2 nobody answers, or refuses");
  command->callback([&action, options] { action = [options] { return write_values(*options); }; });
}

}  // namespace lockstep::cli
