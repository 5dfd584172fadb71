// lockstep read: values of a running project by their names, over Modbus.
#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/describe/values.hpp"
#include "cli/panel/modbus_panel.hpp"
#include "hmi_bridge/traces/text_literal.hpp"

namespace lockstep::cli {
namespace {

nlohmann::ordered_json shown_json(const PanelName& name, const std::vector<Value>& values) {
  if (name.capacity > 0) return text_to_utf8(text_of(values, name.capacity));
  if (!name.is_list) return json_value(values.front(), name.type());
  auto list = nlohmann::ordered_json::array();
  for (const Value value : values) list.push_back(json_value(value, name.type()));
  return list;
}

/// As `lockstep write` takes it.
std::string shown_text(const PanelName& name, const std::vector<Value>& values) {
  if (name.capacity > 0) return text_literal(text_of(values, name.capacity));
  std::string text;
  for (const Value value : values) text += (text.empty() ? "" : ", ") + literal(value, name.type());
  return name.is_list ? "[" + text + "]" : text;
}

int read_values(const PanelOptions& options) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(options.project, status, {}, Warnings::kept);
  if (!project) return status;
  auto target = find_target(*project, options);
  if (!target) return kCouldNotStart;
  ModbusPanel panel(*project, options, std::move(*target));
  if (!panel.has_map()) return kNotValid;
  std::vector<PanelName> names;
  for (const std::string& name : options.names)
    if (auto found = panel.find(name, false)) names.push_back(std::move(*found));
  if (names.size() != options.names.size()) return kNotValid;
  if (options.names.empty()) names = panel.all();
  if (!panel.connect()) return kCouldNotStart;
  nlohmann::ordered_json json;
  for (const PanelName& name : names) {
    const auto values = panel.read(name);
    if (!values) return kCouldNotStart;
    if (options.json)
      json[name.name] = shown_json(name, *values);
    else
      write_data(name.name + " = " + shown_text(name, *values) + "\n");
  }
  if (options.json) write_data(json_text(json) + "\n");
  return kOk;
}

}  // namespace

void add_read_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("read", "Read values of a running project over Modbus, by name");
  auto options = std::make_shared<PanelOptions>();
  add_panel_options(*command, *options);
  command->add_option("NAMES", options->names,
                      "names in the project's map, such as speed, Knife.ActualPosition, diagnostic.ticks, "
                      "heights (an array), heights[3], heights[2..5]; all if there is none");
  command->add_flag("--json", options->json, "as JSON, for programs");
  command->footer(
      "Each name is one request, an array as many as its registers need, 125 in each; the values of a "
      "request\n"
      "are of one instant. The first place of a name in the map counts.\n"
      "Such as: lockstep read 127.0.0.1:1502 speed Knife.ActualPosition --project project.json\n"
      "Exit status: 0, 1 project not valid, without a map, or no such name, 2 nobody answers, or refuses");
  command->callback([&action, options] { action = [options] { return read_values(*options); }; });
}

}  // namespace lockstep::cli
