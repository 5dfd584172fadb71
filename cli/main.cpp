// The `lockstep` command.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <sstream>

#include "cli/aposs/aposs_command.hpp"
#include "cli/command/command.hpp"
#include "cli/command/shortage.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/json/problem.hpp"

namespace {

using namespace lockstep::cli;

// [byte] for tables that are made when first asked for, by what cannot refuse
constexpr std::size_t kTables = std::size_t{4} << 20;
constexpr std::size_t kDescriptors = 4;  // that the shortest command opens at once

/// What CLI11 says, with the command line in it, which may have names of strangers' files.
std::string lines_shown(const std::string& text) {
  std::string result, line;
  for (std::istringstream lines(text); std::getline(lines, line);) result += lockstep::visible(line) + "\n";
  return result;
}

/// What to say of a first word that is no command and no option; empty for any other mistake.
std::string nearest_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return "";
  const std::vector<std::string_view> known(names.begin(), names.end());
  return "there is no command " + lockstep::quote(word) + lockstep::did_you_mean(word, known) +
         "; commands: " + lockstep::list_of(known) + "; lockstep describe tells what a name means";
}

int carry_out(int argc, char** argv) {
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
  add_test_command(app, action);
  add_studio_command(app, action);
  add_connections_command(app, action);
  add_describe_command(app, action);
  add_tags_command(app, action);
  add_read_command(app, action);
  add_write_command(app, action);
  add_plot_command(app, action);
  add_monitor_command(app, action);
  add_cam_command(app, action);
  add_doctor_command(app, action);
  add_aposs_command(app, action);
  add_linmot_command(app, action);
  add_completion_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string near = nearest_command(app, argc, argv); !near.empty()) {
      tell(near, Severity::error);
      return kCouldNotStart;
    }
    std::ostringstream data, messages;
    const int status = app.exit(error, data, messages);
    write_data(data.str());
    write_message(lines_shown(messages.str()));
    return status == 0 ? kOk : kCouldNotStart;  // CLI11's own exit statuses are not ours
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  open_missing_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may grow no further is a write that fails, and is told
  try {
    require_descriptors(kDescriptors);
    require_memory(kTables);
    const int status = carry_out(argc, argv);
    finish_output();
    return status;
  } catch (const OutputFailed& error) {
    tell(error.what(), Severity::error);
  } catch (const std::exception& error) {
    return tell_failure(error);
  }
  return kCouldNotStart;
}
