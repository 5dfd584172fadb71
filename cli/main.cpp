// The `lockstep` command.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "cli/command/command.hpp"

int main(int argc, char** argv) {
  using namespace lockstep::cli;
  CLI::App app("Lockstep runs machines of coupled axes from a project file.", "lockstep");
  app.set_version_flag("--version", "lockstep " LOCKSTEP_VERSION);
  app.require_subcommand(1);
  app.footer(
      "First steps:\n"
      "  lockstep check projects/02_rotary_knife/project.json\n"
      "  lockstep run projects/02_rotary_knife/project.json --simulate --duration 5s --trace knife.csv\n"
      "  lockstep run projects/02_rotary_knife/project.json\n"
      "Each command has a --help of its own.");
  Action action;
  add_check_command(app, action);
  add_run_command(app, action);
  add_describe_command(app, action);
  add_tags_command(app, action);
  add_read_command(app, action);
  add_write_command(app, action);
  add_plot_command(app, action);
  add_monitor_command(app, action);
  add_cam_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kCouldNotStart;  // CLI11's own exit statuses are not ours
  }
  try {
    return action();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lockstep: internal fault: %s\n", error.what());
    return kStoppedByFault;
  }
}
