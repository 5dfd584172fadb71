// lockstep cam: what its commands share.
#include "cli/cam/cam_command.hpp"

#include <CLI/App.hpp>

#include "cli/command/standard_streams.hpp"
#include "cli/command/whole_file.hpp"
#include "projects/cam_files/file.hpp"

namespace lockstep::cli {

void add_cam_input(CLI::App& command, CamInput& input) {
  command
      .add_option("FILE", input.file,
                  "a cam: JSON, or a table (.csv, .txt) of points or elements; or a project")
      ->required();
  command.add_option("--cam", input.name, "the cam of a project, by its name");
  command.add_flag("--10k", input.large, "a table may have 10,000 points (TO_Cam_10k)");
}

std::optional<CamDefinition> load_cam_or_tell(const CamInput& input, int& status) {
  try {
    LoadedCam loaded = load_cam_file(input.file, input.name, input.large ? kCam10kPoints : kCamPoints);
    for (const Problem& problem : loaded.problems) tell_line(to_string(input.file, problem), Severity::error);
    for (Problem warning : loaded.warnings) {
      warning.text = "warning: " + warning.text;
      tell_line(to_string(input.file, warning), Severity::warning);
    }
    status = kNotValid;
    return std::move(loaded.definition);
  } catch (const UnreadableFile& error) {
    tell(error.what(), Severity::error);
    status = kCouldNotStart;
    return std::nullopt;
  }
}

void write_output(const std::string& path, const std::string& text) {
  if (path.empty()) return write_data(text);
  write_whole_file(path, text);
}

void add_cam_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("cam", "Design cams: figures, samples, checks, conversion, pictures");
  command->require_subcommand(1);
  command->footer(
      "A cam gives a following value for each leading value. A cam file has elements (points, point groups, "
      "lines,\n"
      "sines, polynomials, inverse sines) with transitions by motion laws of VDI 2143 between them; or it "
      "has the\n"
      "points and segments of a TO_Cam as such. A table (commas or tabs) has rows x,y or rows P,x,y and "
      "S,xmin,….\n"
      "projects/CAMS.md describes all of them, projects/cams has examples:\n"
      "  lockstep cam info projects/cams/feeder.cam.json\n"
      "  lockstep cam check projects/cams/feeder.cam.json\n"
      "  lockstep cam plot projects/cams/feeder.cam.json -o feeder.svg\n"
      "  lockstep cam sample projects/cams/feeder.cam.json --count 361 --derivatives -o feeder.csv\n"
      "  lockstep cam convert projects/cams/feeder.cam.json --as data -o feeder_data.json\n"
      "Problems of a file go to standard error, one a line: FILE:place: what is wrong, what is allowed\n"
      "Exit status: 0 done, 1 the cam is not valid, 2 a file cannot be read or written, or the command line "
      "is wrong");
  add_cam_info(*command, action);
  add_cam_sample(*command, action);
  add_cam_check(*command, action);
  add_cam_convert(*command, action);
  add_cam_plot(*command, action);
}

}  // namespace lockstep::cli
