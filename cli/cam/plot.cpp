// lockstep cam plot: four diagrams over the leading value.
#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/cam/cam_command.hpp"

namespace lockstep::cli {
namespace {

constexpr int kSamples = 3000;    // over the cam
constexpr int kCurveBins = 1300;  // about one a pixel

struct CurveOptions {
  CamInput input;
  std::string picture;
  std::string title;
};

/// Samples of one formula, so that steps between two stay steps.
std::vector<Point> piece_points(const CamFunction& cam, std::size_t piece, int order) {
  const double from = cam.piece_start(piece);
  const double to = cam.piece_start(piece + 1);
  const double whole = cam.end_leading_value() - cam.start_leading_value();
  const int samples = std::max(2, static_cast<int>(std::ceil(kSamples * (to - from) / whole)));
  std::vector<Point> points;
  for (int k = 0; k <= samples; ++k) {
    const double x = k < samples ? from + (to - from) * k / samples : to;
    const CamDerivatives v = cam.piece_value(piece, x);
    const double values[] = {v.position, v.first, v.second, v.third};
    points.emplace_back(x, values[order]);
  }
  return points;
}

/// One curve; a step is drawn as a vertical stroke.
Curve curve_of(const CamFunction& cam, const std::string& name, int order) {
  std::vector<Point> points;
  for (std::size_t piece = 0; piece < cam.piece_count(); ++piece) {
    const std::vector<Point> more = piece_points(cam, piece, order);
    points.insert(points.end(), more.begin(), more.end());
  }
  Curve curve;
  curve.name = name;
  curve.color = order;
  curve.pieces = {thinned(points, cam.start_leading_value(), cam.end_leading_value(), kCurveBins)};
  return curve;
}

/// Where elements and transitions by a law are, below the diagrams.
std::vector<Lane> lanes_of(const CamDefinition& definition) {
  Lane elements{"elements", true, {}}, laws{"transitions by a law", true, {}};
  for (const CamStretch& stretch : definition.cam.stretches)
    if (stretch.from < stretch.to)
      (stretch.transition ? laws : elements).intervals.push_back({stretch.from, stretch.to, 1.0});
  std::vector<Lane> lanes;
  for (Lane* const lane : {&elements, &laws})
    if (!lane->intervals.empty()) lanes.push_back(std::move(*lane));
  return lanes;
}

PictureFormat picture_format(const std::string& path) {
  if (path.ends_with(".svg")) return PictureFormat::svg;
  if (path.ends_with(".png")) return PictureFormat::png;
  throw CannotDo("-o: '" + path + "' has to end in .svg or .png");
}

}  // namespace

Picture cam_picture(const CamDefinition& definition, const std::string& title) {
  const CamFunction& cam = *definition.cam.function;
  Picture picture;
  picture.title = title;
  picture.axis_label = "leading value";
  picture.begin = cam.start_leading_value();
  picture.end = cam.end_leading_value();
  constexpr const char* kNames[] = {"following value", "velocity", "acceleration", "jerk"};
  constexpr const char* kLabels[] = {"following value", "velocity (1st deriv.)", "acceleration (2nd)",
                                     "jerk (3rd)"};
  for (int order = 0; order < 4; ++order) {
    Diagram diagram;
    diagram.label = kLabels[order];
    diagram.curves = {curve_of(cam, kNames[order], order)};
    set_range(diagram);
    picture.diagrams.push_back(std::move(diagram));
  }
  picture.lanes = lanes_of(definition);
  return picture;
}

void add_cam_plot(CLI::App& cam, Action& action) {
  CLI::App* command = cam.add_subcommand("plot", "Draw following value, velocity, acceleration and jerk");
  auto options = std::make_shared<CurveOptions>();
  add_cam_input(*command, options->input);
  command->add_option("-o,--output", options->picture, "the picture: FILE.svg or FILE.png")->required();
  command->add_option("--title", options->title, "title; without it: the name of the cam or of the file");
  command->footer(
      "Four diagrams above one axis of leading values; below, where elements and transitions by a law are.");
  command->callback([&action, options] {
    action = [options] {
      return with_cam(options->input, [&](const CamDefinition& definition) {
        const PictureFormat format = picture_format(options->picture);
        std::string title = options->title.empty() ? definition.name : options->title;
        if (title.empty()) title = std::filesystem::path(options->input.file).filename().string();
        write_output(options->picture, run_gnuplot(plot_script(cam_picture(definition, title), format)));
        return static_cast<int>(kOk);
      });
    };
  });
}

}  // namespace lockstep::cli
