// lockstep linmot tune: the currents that a load takes.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command/standard_streams.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/json/document.hpp"
#include "projects/json/text_file.hpp"
#include "projects/loader/linmot_changes.hpp"
#include "projects/system/apply_delays.hpp"
#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot/tuning.hpp"

namespace lockstep::cli {
namespace {

std::string tuning_text(const linmot::TuningResult& result) {
  return fmt::format(
      "mass per motor   {:.4g} kg\n"
      "FF Friction      {:.4f} A\n"
      "FF Acceleration  {:.3f} mA/(m/s²)\n"
      "FF Deceleration  {:.3f} mA/(m/s²)\n"
      "Current Offset   {:.5f} A\n",
      result.mass, result.ff_friction, result.ff_acceleration, result.ff_acceleration, result.current_offset);
}

/// A motor of a project, or one that the command line describes.
struct TuneOptions {
  linmot::TuningInput input;
  bool vertical = false;
  std::vector<std::string> motor;  // file, controller, letter
  bool apply = false;
};

const LinMotController* controller_of(const Project& project, const std::string& name) {
  for (const auto& object : project.controller->objects)
    if (object->kind == ObjectKind::LinMot_Controller && object->name == name)
      return static_cast<const LinMotController*>(object.get());
  return nullptr;
}

/// What a project says of the machine. @throws std::runtime_error if it has no such motor
linmot::TuningInput input_of(const LinMotController* controller, const TuneOptions& options) {
  if (controller == nullptr)
    throw std::runtime_error("there is no LinMot_Controller '" + options.motor[1] + "'");
  const std::string& letter = options.motor[2];
  const auto index = static_cast<std::size_t>(letter[0] - 'A');
  const linmot::MotorSettings& motor = controller->motor_settings[index];
  if (!motor.exists)
    throw std::runtime_error("'motors' of " + options.motor[1] + " does not describe " + letter +
                             "; allowed: a motor with its mass and force constant");
  linmot::TuningInput input;
  input.force_constant = motor.force_constant;
  input.slider_mass = motor.plant.slider_mass;
  input.load_mass = motor.plant.load_mass;
  input.friction = motor.plant.friction;
  input.inclination = motor.plant.inclination;
  input.external_force = options.input.external_force;
  return input;
}

/// Writes them into the file. @throws std::runtime_error where that cannot be
void apply_tuning(const linmot::TuningResult& result, const TuneOptions& options) {
  const std::string& file = options.motor[0];
  const std::array<ControlParameter, 4> parameters = {{{"FF Friction", result.ff_friction},
                                                       {"FF Acceleration", result.ff_acceleration},
                                                       {"FF Deceleration", result.ff_acceleration},
                                                       {"Current Offset", result.current_offset}}};
  const ChangedText changed =
      with_control_parameters(read_text_file(file, JsonDocument::kLongest), options.motor[1],
                              static_cast<std::size_t>(options.motor[2][0] - 'A'), parameters);
  const std::string folder = std::filesystem::path(file).parent_path().string();
  const LoadedProject loaded = load_project(changed.text, folder);
  if (!loaded.project)
    throw std::runtime_error("with these parameters the project would not be valid: " +
                             loaded.problems.front().text);
  replace_file(file, changed.text);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    write_data(fmt::format("{}:{}: {}\n", visible(file), changed.lines[i], parameters[i].name));
}

int tune_motor(const TuneOptions& options) {
  int status = kOk;
  const auto project = load_or_tell(options.motor[0], status);
  if (!project) return status;
  try {
    const linmot::TuningResult result =
        linmot::tune(input_of(controller_of(*project, options.motor[1]), options));
    write_data(tuning_text(result));
    if (options.apply) apply_tuning(result, options);
  } catch (const UnreadableFile& error) {
    tell(error.what(), Severity::error);
    return kCouldNotStart;
  } catch (const std::system_error& error) {
    tell(error.what(), Severity::error);
    return kCouldNotStart;
  } catch (const std::runtime_error& error) {
    tell(error.what(), Severity::error);
    return kNotValid;
  }
  return kOk;
}

int tell_tuning(const TuneOptions& options) {
  if (!options.motor.empty()) return tune_motor(options);
  write_data(tuning_text(linmot::tune(options.input)));
  return kOk;
}

/// Options that describe a motor, in place of a project.
void add_described_motor(CLI::App& command, TuneOptions& options, CLI::Option& motor) {
  linmot::TuningInput& input = options.input;
  const auto describes = [&motor](CLI::Option* option) {
    option->excludes(&motor);
    return option;
  };
  auto* const constant =
      describes(command.add_option("--force-constant", input.force_constant, "of the motor [N/A]"))
          ->check(CLI::Range(1e-3, 1e6));
  auto* const mass = describes(command.add_option("--slider-mass", input.slider_mass, "of each motor [kg]"))
                         ->check(CLI::Range(1e-6, 1e6));
  constant->needs(mass);
  mass->needs(constant);
  describes(command.add_option("--load-mass", input.load_mass, "of all motors together [kg]"))
      ->check(CLI::Range(0.0, 1e6));
  describes(command.add_option("--motors", input.motors, "in parallel"))->check(CLI::Range(1, 16));
  describes(command.add_option("--friction", input.friction, "of each motor [N]"))
      ->check(CLI::Range(0.0, 1e6));
  auto* const inclination =
      describes(command.add_option("--inclination", input.inclination, "90: out of the motor is upwards [°]"))
          ->check(CLI::Range(-90.0, 90.0));
  describes(command.add_flag("--vertical", options.vertical, "an inclination of 90°"))->excludes(inclination);
}

}  // namespace

void add_linmot_tune(CLI::App& linmot, Action& action) {
  CLI::App* command = linmot.add_subcommand("tune", "Calculate feed-forward and current offset of a load");
  auto options = std::make_shared<TuneOptions>();
  auto* const motor =
      command->add_option("MOTOR", options->motor, "project, LinMot controller and A to D: a motor in it")
          ->expected(1, 3)  // exactly three are asked for below, behind what each value is
          ->type_name("FILE CONTROLLER A");
  add_described_motor(*command, *options, *motor);
  command->add_option("--external-force", options->input.external_force, "out of each motor [N]")
      ->check(CLI::Range(-1e6, 1e6));
  command
      ->add_flag("--apply", options->apply,
                 "write them into the project file, no other byte of which changes")
      ->needs(motor);
  command->footer(
      "  lockstep linmot tune --force-constant 40 --slider-mass 0.829 --load-mass 1.2 --friction 10\n"
      "  lockstep linmot tune lid.json Lid B --apply\n"
      "Exit status: 0 told, 1 the project is not valid or has no such motor, 2 a file cannot be read or "
      "written, "
      "or the command line is wrong");
  command->callback([&action, options, command] {
    if (options->motor.empty() && command->count("--force-constant") == 0)
      throw CLI::RequiredError("FILE CONTROLLER A, or --force-constant and --slider-mass");
    if (!options->motor.empty() && options->motor.size() != 3)
      throw CLI::ArgumentMismatch("a motor of a project is named by FILE CONTROLLER A");
    if (!options->motor.empty() &&
        (options->motor[2].size() != 1 || options->motor[2][0] < 'A' || options->motor[2][0] > 'D'))
      throw CLI::ValidationError("MOTOR", "the motor is one of A, B, C, D");
    if (options->vertical) options->input.inclination = 90.0;
    action = [options] { return tell_tuning(*options); };
  });
}

}  // namespace lockstep::cli
