/// Cam files of every format.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/cam_files/definition.hpp"
#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"
#include "projects/json/text_file.hpp"

namespace lockstep {

/// What reading gives: a cam if there are no problems, else all problems. Warnings there may be either way.
struct LoadedCam {
  std::optional<CamDefinition> definition;
  std::vector<Problem> problems;
  std::vector<Problem> warnings;
};

/// Reads a cam from a text: JSON if it begins with a brace, a cam file or the cam `name` of a project; else a
/// table of points or elements.
/// @param folder of the text, for the files that a project names
/// @param name of the technology object, for a project; else empty
/// @param capacity points that a table may have; JSON says it itself
LoadedCam load_cam(std::string_view text, const std::string& folder, const std::string& name,
                   std::size_t capacity);

/// `load_cam` from a file. @throws UnreadableFile
LoadedCam load_cam_file(const std::string& path, const std::string& name, std::size_t capacity);

/// Reads what defines a cam: `elements`, with `optimization` for their transitions by a law; or `points` and
/// `segments` of the data block; or `file`, a cam file beside the project. The keys are keys::kCamDefinition;
/// other members of `object` are not looked at. For the loader of projects: every problem is reported where
/// it stands, and without one `definition.cam` has points and segments for the data block.
/// @param folder of the document, for `file`
/// @param top folder of the project, out of which no file leads
/// @param definition with capacity and design.interpolation as they are known so far; a file brings its own
///     interpolation
void read_cam_definition(const JsonValue& object, const std::string& folder, const std::string& top,
                         CamWithoutCurve without_curve, CamDefinition& definition, Problems& problems);

}  // namespace lockstep
