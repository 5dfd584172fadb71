// lockstep check: tells every problem of a project file.
#include <CLI/CLI.hpp>  // with the virtual tables of App, for programs that have other rooms but not main.cpp

#include "cli/command/command.hpp"
#include "cli/command/shortage.hpp"

namespace lockstep::cli {

std::optional<Project> load_or_tell(const std::string& path, int& status, const Prepare& prepare,
                                    Warnings warnings, LoadedFor use) {
  try {
    LoadedProject loaded = load_project_file(path, prepare, use);
    for (const Problem& problem : loaded.problems) tell_line(to_string(path, problem), Severity::error);
    if (warnings == Warnings::kept) loaded.warnings.clear();
    for (Problem warning : loaded.warnings) {
      warning.text = "warning: " + warning.text;
      tell_line(to_string(path, warning), Severity::warning);
    }
    status = kNotValid;
    return std::move(loaded.project);
  } catch (const UnreadableFile& error) {
    tell(with_help(error.what()), Severity::error);
    status = kCouldNotStart;
    return std::nullopt;
  }
}

void add_check_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("check", "Validate a project file and tell every problem in it");
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "the project file")->required();
  command->footer(
      "Problems go to standard error, one a line: FILE:/json/pointer: what is wrong, what is allowed\n"
      "Exit status: 0 valid, 1 not valid, 2 cannot be read");
  command->callback([&action, file] {
    action = [file] {
      int status = kOk;
      const bool valid = load_or_tell(*file, status, {}, Warnings::told, LoadedFor::looking).has_value();
      return valid ? static_cast<int>(kOk) : status;
    };
  });
}

}  // namespace lockstep::cli
