// The `lockstep` command.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

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

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The nearest of some names; empty where a word is one of them.
std::string nearest(const std::string& word, const std::vector<std::string>& names) {
  if (std::ranges::find(names, word) != names.end()) return "";
  return lockstep::quote(word) +
         lockstep::did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end()));
}

/// What to say of a word that is no command, where one has to stand, or of an option that its command has
/// not; empty for any other mistake. @param words the command line
std::string mistaken_word(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string name = "lockstep";
  std::size_t at = 0;
  for (; at < words.size(); ++at) {
    const std::vector<std::string> commands = commands_of(*command);
    if (commands.empty() || words[at].starts_with('-')) break;
    if (const std::string near = nearest(words[at], commands); !near.empty()) {
      const std::vector<std::string_view> known(commands.begin(), commands.end());
      const std::string whose = command == &app ? "" : " of " + name;
      return "there is no command " + near + whose + "; commands: " + lockstep::list_of(known) +
             (command == &app ? "; lockstep describe tells what a name means" : "");
    }
    command = command->get_subcommand(words[at]);
    name += " " + words[at];
  }
  const std::vector<std::string> options = options_of(*command);
  for (; at < words.size() && words[at] != "--"; ++at) {
    if (!words[at].starts_with("--")) continue;
    if (const std::string near = nearest(words[at].substr(0, words[at].find('=')), options); !near.empty())
      return name + " has no option " + near + "; " + name + " --help lists what it has";
  }
  return "";
}

/// Where the examples are: those of the package in their folder, those of a checkout below it.
std::string examples() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed = program.parent_path().parent_path() / "share/lockstep/projects";
  return !program.empty() && std::filesystem::exists(installed, error) ? installed.string() : "projects";
}

/// The commands to begin with, as they can be typed on this machine.
std::string first_steps() {
  const std::string knife = examples() + "/02_rotary_knife/project.json";
  return "First steps:\n"
         "  lockstep check " +
         knife +
         "\n"
         "  lockstep run " +
         knife +
         " --simulate --duration 20s --trace knife.csv\n"
         "  lockstep plot knife.csv --project " +
         knife +
         " -o knife.svg\n"
         "  lockstep run " +
         knife +
         " --stimuli --no-retain --studio 127.0.0.1:8780\n"
         "  lockstep describe gear\n"
         "The last but one is in real time, until Ctrl-C, with a page for a browser; the last one looks for "
         "what has to\n"
         "do with a word: blocks, variables, alarms, functions, keys. Each command has a --help of its own.";
}

int carry_out(int argc, char** argv) {
  CLI::App app("Lockstep runs machines of coupled axes from a project file.", "lockstep");
  app.set_version_flag("--version", "lockstep " LOCKSTEP_VERSION);
  app.require_subcommand(1);
  app.footer(first_steps());
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
  refuse_empty_texts(app);
  const std::vector<std::string> words =
      with_empty_texts(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the end
  } catch (const CLI::ParseError& error) {
    // Help that was asked for is no mistake.
    if (const std::string mistake = mistaken_word(app, words);
        error.get_exit_code() != 0 && !mistake.empty()) {
      tell(mistake, Severity::error);
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
