// lockstep linmot curve: what the curves of a project are, and what is wrong with them.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/command/standard_streams.hpp"
#include "cli/command/whole_file.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "cli/plot/picture.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/loader/linmot_curves.hpp"
#include "tech_objects/linmot/controller.hpp"

namespace lockstep::cli {
namespace {

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
  for (std::size_t motor = 0; motor < linmot::kMotors; ++motor)
    if (const std::string finding = force_finding(controller, motor, curve); !finding.empty())
      text += "  " + finding + "\n";
  if (const std::string finding = cyclic_finding(curve); !finding.empty())
    text += "  run cyclically: " + finding + "\n";
  return text;
}

constexpr int kCurveBins = 1300;  // about one a pixel

Diagram curve_diagram(const linmot::Curve& curve, int order) {
  constexpr const char* kLabels[] = {"position [mm]", "velocity [m/s]", "acceleration [m/s²]"};
  constexpr double kScales[] = {1.0, 1e-3, 1e-3};
  constexpr int kSamples = 3000;
  const CamFunction& function = curve.function();
  std::vector<Point> points;
  for (std::size_t piece = 0; piece < function.piece_count(); ++piece) {
    const double from = function.piece_start(piece), to = function.piece_start(piece + 1);
    const int samples = std::max(2, static_cast<int>(std::ceil(kSamples * (to - from) / curve.duration())));
    for (int k = 0; k <= samples; ++k) {
      const double time = from + (to - from) * k / samples;
      const CamDerivatives at = function.piece_value(piece, time);
      const double values[] = {at.position, at.first, at.second};
      points.emplace_back(time * 1e3, values[order] * kScales[order]);
    }
  }
  Diagram diagram;
  diagram.label = kLabels[order];
  Curve line;
  line.name = kLabels[order];
  line.color = order;
  line.pieces = {thinned(points, 0.0, curve.duration() * 1e3, kCurveBins)};
  diagram.curves = {std::move(line)};
  set_range(diagram);
  return diagram;
}

/// @throws std::runtime_error where it cannot be drawn or written
void draw_curve(const LinMotController& controller, std::size_t number, const std::string& path) {
  const linmot::Curve& curve = controller.curves[number];
  Picture picture;
  picture.title = fmt::format("{} curve {}", controller.name, number);
  picture.axis_label = "t [ms]";
  picture.begin = 0.0;
  picture.end = curve.duration() * 1e3;
  for (int order = 0; order < 3; ++order) picture.diagrams.push_back(curve_diagram(curve, order));
  const PictureFormat format = path.ends_with(".png") ? PictureFormat::png : PictureFormat::svg;
  write_whole_file(path, run_gnuplot(plot_script(picture, format)));
}

struct CurveOptions {
  std::string file;
  int number = 0;   // 0: all
  int samples = 0;  // 0: what they are
  std::string picture;
};

void tell_curve(const LinMotController& controller, std::size_t number, const CurveOptions& options) {
  const linmot::Curve& curve = controller.curves[number];
  if (!options.picture.empty()) return draw_curve(controller, number, options.picture);
  write_data(options.samples > 0 ? samples_of(curve, options.samples) : curve_text(controller, number));
}

int tell_curves(const CurveOptions& options) {
  int status = kOk;
  const auto project = load_or_tell(options.file, status);
  if (!project) return status;
  int told = 0;
  try {
    for (const auto& object : project->controller->objects) {
      if (object->kind != ObjectKind::LinMot_Controller) continue;
      const auto& controller = static_cast<const LinMotController&>(*object);
      for (std::size_t number = 1; number < controller.curves.size(); ++number) {
        if (!controller.curves[number].exists()) continue;
        if (options.number != 0 && static_cast<std::size_t>(options.number) != number) continue;
        tell_curve(controller, number, options);
        ++told;
      }
    }
  } catch (const std::runtime_error& error) {
    tell(error.what(), Severity::error);
    return kCouldNotStart;
  }
  if (told > 0) return kOk;
  tell(options.number != 0 ? fmt::format("there is no curve {}", options.number) : "there is no curve",
       Severity::error);
  return kNotValid;
}

}  // namespace

void add_linmot_curve(CLI::App& linmot, Action& action) {
  CLI::App* command = linmot.add_subcommand("curve", "Tell about the curves of a project");
  auto options = std::make_shared<CurveOptions>();
  command->add_option("FILE", options->file, "project")->required();
  auto* const number =
      command->add_option("--number", options->number, "that curve alone")->check(CLI::Range(1, 63));
  auto* const samples = command
                            ->add_option("--samples", options->samples,
                                         "ms;mm;m/s;m/s² at so many steps, in place of what it is")
                            ->check(CLI::Range(1, 1'000'000));
  command
      ->add_option("--plot", options->picture,
                   "draw position, velocity and acceleration over time: FILE.svg or FILE.png")
      ->needs(number)
      ->excludes(samples)
      ->check([](const std::string& name) {
        return name.ends_with(".svg") || name.ends_with(".png") ? "" : "has to end in .svg or .png";
      });
  command->footer(
      "Below each curve: what a motor could not follow, and what steps if the curve is run cyclically. Other "
      "findings are warnings.\n"
      "Exit status: 0 told, 1 the project is not valid or has no such curve, 2 a file cannot be read or "
      "written");
  command->callback([&action, options] { action = [options] { return tell_curves(*options); }; });
}

}  // namespace lockstep::cli
