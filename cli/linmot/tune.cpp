// lockstep linmot tune: the currents that a load takes.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "cli/command/standard_streams.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "tech_objects/linmot/tuning.hpp"

namespace lockstep::cli {
namespace {

int tell_tuning(const linmot::TuningInput& input) {
  const linmot::TuningResult result = linmot::tune(input);
  write_data(
      fmt::format("mass per motor   {:.4g} kg\n"
                  "FF Friction      {:.4f} A\n"
                  "FF Acceleration  {:.3f} mA/(m/s²)\n"
                  "FF Deceleration  {:.3f} mA/(m/s²)\n"
                  "Current Offset   {:.5f} A\n",
                  result.mass, result.ff_friction, result.ff_acceleration, result.ff_acceleration,
                  result.current_offset));
  return kOk;
}

}  // namespace

void add_linmot_tune(CLI::App& linmot, Action& action) {
  CLI::App* command = linmot.add_subcommand("tune", "Calculate feed-forward and current offset of a load");
  auto input = std::make_shared<linmot::TuningInput>();
  auto vertical = std::make_shared<bool>(false);
  command->add_option("--force-constant", input->force_constant, "of the motor [N/A]")
      ->required()
      ->check(CLI::Range(1e-3, 1e6));
  command->add_option("--slider-mass", input->slider_mass, "of each motor [kg]")
      ->required()
      ->check(CLI::Range(1e-6, 1e6));
  command->add_option("--load-mass", input->load_mass, "of all motors together [kg]")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--motors", input->motors, "in parallel")->check(CLI::Range(1, 16));
  command->add_option("--friction", input->friction, "of each motor [N]")->check(CLI::Range(0.0, 1e6));
  auto* const inclination =
      command->add_option("--inclination", input->inclination, "90: out of the motor is upwards [°]")
          ->check(CLI::Range(-90.0, 90.0));
  command->add_flag("--vertical", *vertical, "an inclination of 90°")->excludes(inclination);
  command->add_option("--external-force", input->external_force, "out of each motor [N]")
      ->check(CLI::Range(-1e6, 1e6));
  command->callback([&action, input, vertical] {
    if (*vertical) input->inclination = 90.0;
    action = [input] { return tell_tuning(*input); };
  });
}

}  // namespace lockstep::cli
