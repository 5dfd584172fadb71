// lockstep cam info: what a cam is made of, and its characteristic values.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/cam/cam_command.hpp"
#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "projects/cam_files/facts.hpp"

namespace lockstep::cli {
namespace {

constexpr const char* kQuantities[] = {"following value", "velocity", "acceleration", "jerk"};

std::string shown(double value) {
  if (std::isnan(value)) return "-";
  return fmt::format("{:.7g}", value == 0.0 ? 0.0 : value);
}

std::string_view continuity_name(Continuity continuity) {
  constexpr std::string_view kNames[] = {"nothing", "position", "velocity", "acceleration", "jerk"};
  return kNames[static_cast<std::size_t>(continuity)];
}

struct Figure {
  const char* name;
  double MotionPeaks::*member;
};
constexpr Figure kFigures[] = {{"Cv", &MotionPeaks::velocity},
                               {"Ca", &MotionPeaks::acceleration},
                               {"Ca*", &MotionPeaks::deceleration},
                               {"Cj", &MotionPeaks::jerk},
                               {"Cmdyn", &MotionPeaks::torque}};

std::string row_of(std::initializer_list<std::string> cells, std::size_t first_width) {
  std::string line;
  for (const std::string& cell : cells)
    line += line.empty() ? fmt::format("  {:<{}}", cell, first_width) : fmt::format(" {:>13}", cell);
  while (line.ends_with(' ')) line.pop_back();
  return line + "\n";
}

std::string overview(const CamDefinition& definition) {
  const DesignedCam& cam = definition.cam;
  constexpr const char* kModes[] = {"linear", "cubic splines", "Bézier splines"};
  std::string text;
  if (!definition.name.empty()) text += printable(definition.name) + "\n";
  if (!definition.description.empty()) text += printable(definition.description) + "\n";
  text += fmt::format("{}: {} of {} points, {} of {} segments, {}{}\n",
                      definition.capacity == kCamPoints ? "TO_Cam" : "TO_Cam_10k", cam.points.size(),
                      definition.capacity, cam.segments.size(), kCamSegments,
                      kModes[cam.interpolation.InterpolationMode],
                      cam.interpolation.BoundaryConditions == 1 ? ", equal slopes at both ends" : "");
  text += fmt::format("leading values from {} to {}\n\n", shown(cam.function->start_leading_value()),
                      shown(cam.function->end_leading_value()));
  return text;
}

std::string extremes(const CamFunction& cam) {
  const CamExtremes all = extremes_of(cam, cam.start_leading_value(), cam.end_leading_value());
  std::string text = row_of({"of the cam", "least", "greatest"}, 18);
  for (int order = 0; order < 4; ++order) {
    const auto rounded = [&](double value) {
      return std::abs(value) < 1e-12 * all.peak(order) ? 0.0 : value;
    };
    text += row_of(
        {kQuantities[order], shown(rounded(all.lowest[order])), shown(rounded(all.highest[order]))}, 18);
  }
  return text + "\n";
}

std::string joints(const CamFunction& cam) {
  std::string text;
  constexpr std::size_t kMaximum = 20;
  const std::vector<CamJoint> all = joints_of(cam, true);
  std::size_t told = 0, left_out = 0;
  for (const CamJoint& joint : all) {
    if (joint.keeps >= Continuity::acceleration) continue;  // steps of the jerk are usual
    if (++told > kMaximum) {
      ++left_out;
      continue;
    }
    text += fmt::format("  {}: the {} steps from {} to {}\n",
                        joint.wrap ? "from the end to the start" : "at " + shown(joint.x),
                        kQuantities[static_cast<int>(joint.keeps)], shown(joint.left), shown(joint.right));
  }
  if (left_out > 0) text += fmt::format("  and {} more\n", left_out);
  const double rise = cam.end_following_value() - cam.start_following_value();
  text += rise == 0.0 ? "  closed: ends where it starts\n"
                      : fmt::format("  open: ends {} beside its start\n", shown(rise));
  return "joints\n" + text + "\n";
}

std::string elements(const CamDefinition& definition) {
  if (!definition.designed) return "";
  std::size_t width = 20;
  for (const CamStretch& stretch : definition.cam.stretches)
    width = std::max(width, stretch_name(definition, stretch).size());
  std::string text = row_of({"elements", "from", "to", "points", "segments", "deviation"}, width);
  for (const CamStretch& stretch : definition.cam.stretches)
    text += row_of({stretch_name(definition, stretch), shown(stretch.from), shown(stretch.to),
                    std::to_string(stretch.points), std::to_string(stretch.segments),
                    stretch.curve ? shown(stretch.deviation) : "-"},
                   width);
  return text + "\n";
}

std::string transition(const CamDefinition& definition, const CamStretch& stretch) {
  const MotionPeaks law = stretch.law->normalised_peaks();
  const MotionPeaks cam = mapped_peaks(*definition.cam.function, stretch);
  const MotionPeaks absolute = stretch.law->peaks();
  std::string text =
      fmt::format("{} from {} to {}: continuous up to {} at the start, {} at the end\n",
                  stretch_name(definition, stretch), shown(stretch.from), shown(stretch.to),
                  continuity_name(stretch.start_continuity), continuity_name(stretch.end_continuity));
  text += row_of({"", "law", "in the cam", "law, absolute"}, 6);
  for (const Figure& figure : kFigures)
    text += row_of(
        {figure.name, shown(law.*figure.member), shown(cam.*figure.member), shown(absolute.*figure.member)},
        6);
  return text + "\n";
}

/// The figures of elements whose mapping changes them, such as a polynomial of degree 7.
std::string mapped_elements(const CamDefinition& definition) {
  std::string text;
  const CamFunction& cam = *definition.cam.function;
  const double rounding = 1e-9 * extremes_of(cam, cam.start_leading_value(), cam.end_leading_value()).peak(0);
  for (const CamStretch& stretch : definition.cam.stretches) {
    if (stretch.law || !stretch.curve || stretch.deviation <= rounding) continue;
    const CamExtremes before = extremes_of(stretch.curve, stretch.from, stretch.to);
    const CamExtremes after = extremes_of(cam, stretch.from, stretch.to);
    text += fmt::format("{} from {} to {}: differs from its curve by {} at most\n",
                        stretch_name(definition, stretch), shown(stretch.from), shown(stretch.to),
                        shown(stretch.deviation));
    text += row_of({"greatest", "curve", "in the cam"}, 16);
    for (int order = 1; order < 4; ++order)
      text += row_of({kQuantities[order], shown(before.peak(order)), shown(after.peak(order))}, 16);
    text += "\n";
  }
  return text;
}

std::string info_text(const CamDefinition& definition) {
  std::string text = overview(definition) + elements(definition) + extremes(*definition.cam.function) +
                     joints(*definition.cam.function);
  for (const CamStretch& stretch : definition.cam.stretches)
    if (stretch.law) text += transition(definition, stretch);
  text += mapped_elements(definition);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace

void add_cam_info(CLI::App& cam, Action& action) {
  CLI::App* command = cam.add_subcommand("info", "What the cam is made of, and its characteristic values");
  auto input = std::make_shared<CamInput>();
  auto json = std::make_shared<bool>(false);
  add_cam_input(*command, *input);
  command->add_flag("--json", *json, "for programs");
  command->footer(
      "Cv, Ca, Ca*, Cj, Cmdyn: greatest velocity, acceleration, deceleration, jerk and velocity · "
      "acceleration,\n"
      "normalised by stroke and length. 'law' is the law itself, 'in the cam' what the points and segments "
      "make of\n"
      "it. inf: the acceleration steps. R rest, G constant velocity, U reversal, B motion.");
  command->callback([&action, input, json] {
    action = [input, json] {
      return with_cam(*input, [&](const CamDefinition& definition) {
        write_output("", *json ? json_text(cam_facts(definition)) + "\n" : info_text(definition));
        return static_cast<int>(kOk);
      });
    };
  });
}

}  // namespace lockstep::cli
