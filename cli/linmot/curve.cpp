// lockstep linmot curve: what the curves of a project are, and what is wrong with them.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "cli/command/standard_streams.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "tech_objects/linmot/controller.hpp"

namespace lockstep::cli {
namespace {

/// Largest acceleration that a motor can make [m/s²]; 0: it is not known.
double possible_acceleration(const LinMotController& controller, std::size_t index) {
  const linmot::MotorSettings& motor = controller.motor_settings[index];
  if (!motor.exists) return 0.0;
  const double force = motor.force_constant * controller.data.Motors[index].Parameters.maximal_current;
  const double mass = motor.plant.slider_mass + motor.plant.load_mass;
  return (force - motor.plant.friction) / mass;
}

std::string samples_of(const linmot::Curve& curve, int samples) {
  std::string text;
  for (int i = 0; i <= samples; ++i) {
    const double time = curve.duration() * i / samples;
    const CamValue at = curve.function().value(time);
    text += fmt::format("{:.6f};{:.9f};{:.9f};{:.6f}\n", time * 1e3, at.position, at.first_derivative * 1e-3,
                        at.second_derivative * 1e-3);
  }
  return text;
}

std::string curve_text(const LinMotController& controller, std::size_t number) {
  const linmot::Curve& curve = controller.curves[number];
  const linmot::CurvePeaks peaks = curve.peaks();
  std::string text = fmt::format(
      "{} curve {}: {:g} mm to {:g} mm in {:g} ms, at most {:.6g} m/s, {:.6g} m/s², {:.6g} m/s³\n",
      visible(controller.name), number, curve.start(), curve.end(), curve.duration() * 1e3, peaks.velocity,
      peaks.acceleration, peaks.jerk);
  for (std::size_t motor = 0; motor < linmot::kMotors; ++motor) {
    const double possible = possible_acceleration(controller, motor);
    if (possible > 0.0 && peaks.acceleration > possible)
      text += fmt::format("  motor {} makes at most {:.6g} m/s²\n", static_cast<char>('A' + motor), possible);
  }
  return text;
}

int tell_curves(const std::string& file, int wanted, int samples) {
  int status = kOk;
  const auto project = load_or_tell(file, status);
  if (!project) return status;
  for (const auto& object : project->controller->objects) {
    if (object->kind != ObjectKind::LinMot_Controller) continue;
    const auto& controller = static_cast<const LinMotController&>(*object);
    for (std::size_t number = 1; number < controller.curves.size(); ++number) {
      if (!controller.curves[number].exists() || (wanted != 0 && static_cast<std::size_t>(wanted) != number))
        continue;
      write_data(samples > 0 ? samples_of(controller.curves[number], samples)
                             : curve_text(controller, number));
    }
  }
  return kOk;
}

}  // namespace

void add_linmot_curve(CLI::App& linmot, Action& action) {
  CLI::App* command = linmot.add_subcommand("curve", "Tell about the curves of a project");
  auto file = std::make_shared<std::string>();
  auto number = std::make_shared<int>(0);
  auto samples = std::make_shared<int>(0);
  command->add_option("FILE", *file, "project")->required();
  command->add_option("--number", *number, "that curve alone")->check(CLI::Range(1, 63));
  command->add_option("--samples", *samples, "ms;mm;m/s;m/s² at so many steps, in place of what it is")
      ->check(CLI::Range(1, 1'000'000));
  command->callback([&action, file, number, samples] {
    action = [file, number, samples] { return tell_curves(*file, *number, *samples); };
  });
}

}  // namespace lockstep::cli
