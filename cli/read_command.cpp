// lockstep read: values of a running project by their names, over Modbus.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/describe_values.hpp"
#include "cli/modbus_panel.hpp"

namespace lockstep::cli {
namespace {

int read_values(const PanelOptions& options) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(options.project, status);
  if (!project) return status;
  ModbusPanel panel(*project, options);
  std::vector<PanelEntry> places;
  for (const std::string& name : options.names)
    if (const auto place = panel.find(name, false)) places.push_back(*place);
  if (places.size() != options.names.size()) return kNotValid;
  if (options.names.empty()) places = panel.all();
  if (!panel.connect()) return kCouldNotStart;
  nlohmann::ordered_json json;
  for (const PanelEntry& place : places) {
    const auto value = panel.read(place);
    if (!value) return kCouldNotStart;
    if (options.json)
      json[place.name] = json_value(*value, place.type());
    else
      std::printf("%s = %s\n", place.name.c_str(), literal(*value, place.type()).c_str());
  }
  if (options.json) std::printf("%s\n", json.dump(2).c_str());
  return kOk;
}

}  // namespace

void add_read_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("read", "Read values of a running project over Modbus, by name");
  auto options = std::make_shared<PanelOptions>();
  add_panel_options(*command, *options);
  command->add_option("NAMES", options->names,
                      "names in the project's map, such as speed, Knife.ActualPosition or "
                      "diagnostic.ticks; all if there is none");
  command->add_flag("--json", options->json, "as JSON, for programs");
  command->footer(
      "Each name is one request; the first place of a name in the map counts.\n"
      "Exit status: 0, 1 project not valid or no such name, 2 nobody answers, or refuses");
  command->callback([&action, options] { action = [options] { return read_values(*options); }; });
}

}  // namespace lockstep::cli
