// lockstep cam convert: writes a cam in another format.
#include <CLI/App.hpp>

#include "cli/cam/cam_command.hpp"
#include "projects/cam_files/table.hpp"

namespace lockstep::cli {
namespace {

struct ConvertOptions {
  CamInput input;
  std::string form;
  std::string output;
  std::size_t count = 361;
  bool derivatives = false;
};

std::string converted(const ConvertOptions& options, const CamDefinition& definition) {
  const bool json = options.output.ends_with(".json");
  const bool tabs = options.output.ends_with(".txt");
  if (!json && !tabs && !options.output.ends_with(".csv"))
    throw CannotDo("-o: '" + options.output + "' has to end in .json, .csv (commas) or .txt (tabs)");
  const std::string form = options.form.empty() ? (json ? "design" : "data") : options.form;
  if (form == "design") {
    if (!json) throw CannotDo("--as design: a table has no elements; the file has to end in .json");
    return cam_document(definition, false);
  }
  if (form == "data")
    return json ? cam_document(definition, true) : cam_element_table(definition, tabs ? '\t' : ',');
  const CamFunction& cam = *definition.cam.function;
  const auto samples = sampled(cam, cam.start_leading_value(), cam.end_leading_value(), options.count);
  if (!json) return cam_point_table(samples, options.derivatives, tabs ? '\t' : ',');
  CamDefinition points = definition;
  points.designed = false;
  points.capacity = options.count > kCamPoints ? kCam10kPoints : kCamPoints;
  points.cam.points.clear();
  points.cam.segments.clear();
  for (const CamSample& sample : samples) points.cam.points.push_back({sample.x, sample.value.position});
  return cam_document(points, true);
}

}  // namespace

void add_cam_convert(CLI::App& cam, Action& action) {
  CLI::App* command = cam.add_subcommand("convert", "Write a cam in another format");
  auto options = std::make_shared<ConvertOptions>();
  add_cam_input(*command, options->input);
  command->add_option("-o,--output", options->output, "FILE.json, FILE.csv (commas) or FILE.txt (tabs)")
      ->required();
  command
      ->add_option(
          "--as", options->form,
          "design: the elements as they are (.json); data: the points and segments of the data block;\n"
          "points: points at equal distances. Without it: design for .json, data for tables")
      ->check(CLI::IsMember({"design", "data", "points"}));
  command->add_option("--count", options->count, "--as points: how many; without it: 361")
      ->check(CLI::Range(std::size_t{2}, kCam10kPoints));
  command->add_flag("--derivatives", options->derivatives,
                    "--as points: velocity, acceleration and jerk too");
  command->footer("Reading a design or data again gives the same cam, to the last bit.");
  command->callback([&action, options] {
    action = [options] {
      return with_cam(options->input, [&](const CamDefinition& definition) {
        write_output(options->output, converted(*options, definition));
        return static_cast<int>(kOk);
      });
    };
  });
}

}  // namespace lockstep::cli
