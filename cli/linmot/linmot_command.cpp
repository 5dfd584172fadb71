// lockstep linmot: what its parts share.
#include "cli/linmot/linmot_command.hpp"

#include <CLI/App.hpp>

namespace lockstep::cli {

void add_linmot_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("linmot", "Servo controllers LinMot: curves, state tables, tuning");
  command->require_subcommand(1);
  command->footer(
      "  lockstep linmot curve lid.json\n"
      "  lockstep linmot table lid.json\n"
      "  lockstep linmot tune --force-constant 40 --slider-mass 0.829 --load-mass 1.2 --friction 10\n"
      "Exit status: 0 done, 1 the project is not valid, 2 a file cannot be read, or the command line is "
      "wrong");
  add_linmot_curve(*command, action);
  add_linmot_table(*command, action);
  add_linmot_tune(*command, action);
}

}  // namespace lockstep::cli
