/// The parts of `lockstep linmot`.
#pragma once

#include "cli/command/command.hpp"

namespace lockstep::cli {

/// As the other commands of `lockstep`; its parts are below.
void add_linmot_command(CLI::App& app, Action& action);

void add_linmot_curve(CLI::App& linmot, Action& action);
void add_linmot_table(CLI::App& linmot, Action& action);
void add_linmot_tune(CLI::App& linmot, Action& action);

}  // namespace lockstep::cli
