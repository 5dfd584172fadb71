// lockstep connections: which axis follows which, across the controllers of a system.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "cli/command/command.hpp"
#include "cli/command/shortage.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/command/whole_file.hpp"
#include "cli/connections/overview.hpp"
#include "cli/describe/table.hpp"
#include "projects/system/apply_delays.hpp"

namespace lockstep::cli {
namespace {

struct ConnectionsOptions {
  std::string file;
  OverviewOptions overview;
  bool json = false;
  bool apply = false;
  std::string svg;
};

/// Writes the computed delays into the projects, all of them or none.
int apply(const System& system, const Connections& connections) {
  const ChangedFiles changed = with_delays(system, connections);
  for (const std::string& problem : changed.problems) tell(problem, Severity::error);
  if (!changed.problems.empty()) return kNotValid;
  for (const ChangedFile& file : changed.files) require_writable(file.path);
  for (const ChangedFile& file : changed.files) {
    write_whole_file(file.path, file.text);
    tell(fmt::format("{}: {} delay{} written", file.path, file.delays, file.delays == 1 ? "" : "s"));
  }
  if (changed.files.empty())
    tell(std::ranges::all_of(connections.delays(), &DelayTime::is_current)
             ? "all delays are as computed; nothing to write"
             : "nothing to write");
  return kOk;
}

void tell_recursions(const Connections& connections) {
  if (!connections.recursive()) return;
  const bool open = std::ranges::any_of(connections.rows(),
                                        [](const Interconnection& row) { return row.recursive && !row.cut; });
  tell(fmt::format("warning: there are recursive interconnections{}; one that takes effect is not allowed",
                   open ? ", for which no delays can be computed" : ""),
       Severity::warning);
}

int show(const ConnectionsOptions& options) {
  if (!is_system_file(options.file)) {
    tell(quote(options.file) + " is no system file; allowed: a file with the key lockstep_system",
         Severity::error);
    return kCouldNotStart;
  }
  int status = kOk;
  const std::optional<System> system =
      load_system_or_tell(options.file, status, LoadedFor::looking, SeveralSources::kept);
  if (!system) return status;
  const Connections connections(*system);
  if (!options.overview.routes.empty()) {
    std::string problem;
    if (axis_of_routes(*system, options.overview.routes, problem) == nullptr) {
      tell("--routes: " + problem, Severity::error);
      return kNotValid;
    }
  }
  try {
    if (!options.svg.empty())
      write_whole_file(options.svg, overview_svg(*system, connections, options.overview));
    write_data(options.json ? overview_json(*system, connections, options.overview)
                            : overview_text(*system, connections, options.overview, output_width()));
    if (options.overview.computed) tell_recursions(connections);
    return options.apply ? apply(*system, connections) : static_cast<int>(kOk);
  } catch (const std::runtime_error& error) {
    tell(with_help(error.what()), Severity::error);
    return kCouldNotStart;
  }
}

}  // namespace

void add_connections_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("connections", "Show which axis follows which, across the controllers of a system");
  auto options = std::make_shared<ConnectionsOptions>();
  command->add_option("FILE", options->file, "the system file")->required();
  command->add_option("--filter", options->overview.filter, "only rows in which a name has this");
  command->add_flag("--local", options->overview.local, "couplings within a controller too");
  command->add_flag("!--no-delays", options->overview.delays, "without delay times");
  command->add_option("--routes", options->overview.routes,
                      "the routes by which this axis gets leading values: CONTROLLER.AXIS");
  auto* calculate = command->add_flag("--calculate", options->overview.computed,
                                      "compute delay times, and show them beside those that are configured");
  command
      ->add_flag("--apply", options->apply,
                 "write computed delay times into the project files, of which no other byte changes")
      ->needs(calculate);
  command->add_flag("--json", options->json, "as JSON");
  command->add_option("--svg", options->svg, "draw it into this file too")
      ->check([](const std::string& name) {
        return name.ends_with(".svg") ? "" : std::string("has to end in .svg");
      });
  command->footer(
      "A delay time is two application cycles of the controller of each proxy, and what is behind it; with\n"
      "it all axes see the same leading value at the same time, interpolated everywhere but where the\n"
      "application cycle of a source is longer than that. What \"delays\" of the system file names is left\n"
      "out.\n"
      "Exit status: 0 shown, 1 not valid, 2 cannot be read or written");
  command->callback([&action, options] { action = [options] { return show(*options); }; });
}

}  // namespace lockstep::cli
