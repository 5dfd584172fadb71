/// The parts of `lockstep aposs`.
#pragma once

#include <optional>
#include <string>

#include "cli/command/command.hpp"
#include "projects/aposs/compiler.hpp"

namespace lockstep::cli {

/// Adds what all parts have: --max-variables, --firmware. @param settings live as long as the command
void add_compiler_options(CLI::App& command, aposs::CompilerSettings& settings);

/// Compiles a file and tells what is wrong with it on standard error; none if it cannot be compiled.
/// @param status the exit status then
std::optional<aposs::CompiledProgram> compile_or_tell(const std::string& path,
                                                      const aposs::CompilerSettings& settings, int& status);

/// As the other commands of `lockstep`; its parts are below.
void add_aposs_command(CLI::App& app, Action& action);

void add_aposs_check(CLI::App& aposs, Action& action);
void add_aposs_list(CLI::App& aposs, Action& action);
void add_aposs_run(CLI::App& aposs, Action& action);

}  // namespace lockstep::cli
