// lockstep check: tells every problem of a project file.
#include <CLI/CLI.hpp>  // with the virtual tables of App, for programs that have other rooms but not main.cpp

#include "cli/command/command.hpp"
#include "cli/command/linmot_text.hpp"
#include "cli/command/shortage.hpp"
#include "cli/command/standard_streams.hpp"

namespace lockstep::cli {

namespace {

void tell_problems(const std::string& path, const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) tell_line(to_string(path, problem), Severity::error);
}

void tell_warnings(const std::string& path, std::vector<Problem> warnings) {
  for (Problem& warning : warnings) {
    warning.text = "warning: " + warning.text;
    tell_line(to_string(path, warning), Severity::warning);
  }
}

/// Who asks wants an answer; a program looks at the exit status.
int tell_valid(const std::string& file) {
  tell_line(file + ": valid", Severity::information);
  return kOk;
}

int check_system(const std::string& file, bool expanded) {
  if (expanded) {
    tell("--expanded is for a project; a system file has no parts", Severity::error);
    return kCouldNotStart;
  }
  int status = kOk;
  return load_system_or_tell(file, status, LoadedFor::looking) ? tell_valid(file) : status;
}

}  // namespace

std::optional<System> load_system_or_tell(const std::string& path, int& status, LoadedFor use,
                                          SeveralSources sources) {
  try {
    LoadedSystem loaded = load_system_file(path, use, sources);
    tell_problems(path, loaded.problems);
    tell_warnings(path, std::move(loaded.warnings));
    status = kNotValid;
    return std::move(loaded.system);
  } catch (const UnreadableFile& error) {
    tell(with_help(error.what()), Severity::error);
    status = kCouldNotStart;
    return std::nullopt;
  }
}

std::optional<Project> load_or_tell(const std::string& path, int& status, const Prepare& prepare,
                                    Warnings warnings, LoadedFor use) {
  try {
    LoadedProject loaded = load_project_file(path, prepare, use);
    tell_problems(path, loaded.problems);
    if (warnings == Warnings::told) tell_warnings(path, std::move(loaded.warnings));
    status = kNotValid;
    return std::move(loaded.project);
  } catch (const UnreadableFile& error) {
    tell(with_help(error.what()), Severity::error);
    status = kCouldNotStart;
    return std::nullopt;
  }
}

void add_check_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("check", "Validate a project or system file and tell every problem in it");
  auto file = std::make_shared<std::string>();
  auto expanded = std::make_shared<bool>(false);
  command->add_option("FILE", *file, "the project file, or that of a system of several controllers")
      ->required();
  command->add_flag(
      "--expanded", *expanded,
      "write a valid project to standard output as one file: what it includes, and instances of "
      "templates, in their places");
  auto verbose = std::make_shared<bool>(false);
  command->add_flag(
      "-v,--verbose", *verbose,
      "of a valid project, also what of LinMot controllers counts: limits and rows in whole increments");
  command->footer(
      "Problems go to standard error, one a line: FILE:/json/pointer: what is wrong, what is allowed (line, "
      "column,\n"
      "call or object, instance of a template); FILE is the file that is included where it is wrong there; "
      "FILE:\n"
      "valid, where there are none but warnings\n"
      "Exit status: 0 valid, 1 not valid, 2 cannot be read");
  command->callback([&action, file, expanded, verbose] {
    action = [file, expanded, verbose] {
      if (is_system_file(*file)) return check_system(*file, *expanded);
      int status = kOk;
      const auto project = load_or_tell(*file, status, {}, Warnings::told, LoadedFor::looking);
      if (!project) return status;
      if (*expanded) write_data(expanded_project(*file));
      if (*verbose) write_data(linmot_counting(*project));
      return tell_valid(*file);
    };
  });
}

}  // namespace lockstep::cli
