// lockstep aposs: what its parts share.
#include "cli/aposs/aposs_command.hpp"

#include <CLI/App.hpp>

#include "projects/json/text_file.hpp"

namespace lockstep::cli {

void add_compiler_options(CLI::App& command, aposs::CompilerSettings& settings) {
  command
      .add_option("--max-variables", settings.maximum_variables,
                  "variables and arrays that a program may have (92)")
      ->check(CLI::Range(1, 20000));
  command
      .add_option_function<std::string>(
          "--firmware", [&settings](const std::string& word) { settings.later_edition = word == "5.00"; },
          "edition whose parameters and behaviour there are: 5.00 or <5.00 (5.00)")
      ->check(CLI::IsMember({"5.00", "<5.00"}));
}

std::optional<aposs::CompiledProgram> compile_or_tell(const std::string& path,
                                                      const aposs::CompilerSettings& settings, int& status) {
  try {
    aposs::CompiledProgram compiled = aposs::compile_file(path, settings);
    for (const aposs::Message& error : compiled.errors)
      tell_line(to_string(compiled.files, error), Severity::error);
    if (compiled.errors_found > compiled.errors.size())
      tell_line(path + ": " + std::to_string(compiled.errors_found - compiled.errors.size()) +
                    " further problems are not told",
                Severity::error);
    for (aposs::Message warning : compiled.warnings) {
      warning.text = "warning: " + warning.text;
      tell_line(to_string(compiled.files, warning), Severity::warning);
    }
    status = kNotValid;
    if (!compiled.image) return std::nullopt;
    return compiled;
  } catch (const UnreadableFile& error) {
    tell(error.what(), Severity::error);
    status = kCouldNotStart;
    return std::nullopt;
  }
}

void add_aposs_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("aposs", "Programs in APOSS, the language of the MCO 305");
  command->require_subcommand(1);
  command->footer(
      "A run is one device on the bench: a virtual axis whose actual position is its set position, or with "
      "--plant\n"
      "a simulated drive with its machine, and an encoder output of its own as master. In a project a device "
      "has\n"
      "drive, master, tags at its terminals. Commands of cams, recording and CAN are refused: those of CAN "
      "by check,\n"
      "the others when they run.\n"
      "  lockstep aposs check palletizer.m\n"
      "  lockstep aposs list palletizer.m\n"
      "  lockstep aposs run palletizer.m --duration 5s --in 1=0.5s:1\n"
      "Problems go to standard error, one a line: FILE:line:column: what is wrong, what is allowed\n"
      "Exit status: 0 done, 1 the program is not valid or ended by an error, 2 a file cannot be read, or the "
      "command\nline is wrong");
  add_aposs_check(*command, action);
  add_aposs_list(*command, action);
  add_aposs_run(*command, action);
}

}  // namespace lockstep::cli
