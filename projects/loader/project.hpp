/// The project file: from JSON text to a controller that is ready to run.
/// @source contract of the project file, sections 1, 2, 5, 6
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/json/problem.hpp"
#include "projects/loader/project_contents.hpp"

namespace lockstep {

/// What loading gives: a project if there are no problems, else all problems. Warnings there may be either
/// way.
struct LoadedProject {
  std::optional<Project> project;
  std::vector<Problem> problems;
  std::vector<Problem> warnings;
};

/// What to do with a valid project before its objects take over their start values, such as giving kept
/// values back.
using Prepare = std::function<void(Project&)>;

/// Loads a project from its text. Never fails but through problems, and as `prepare` does. Allocates; not for
/// the thread of the cycle.
/// @param folder to which names of files in it are relative; empty: the current one
LoadedProject load_project(std::string_view text, const std::string& folder = "", const Prepare& prepare = {},
                           LoadedFor use = LoadedFor::running);

/// Loads a project from a file, of which it reads no more than `JsonDocument::kLongest` and a byte.
/// @throws UnreadableFile
LoadedProject load_project_file(const std::string& path, const Prepare& prepare = {},
                                LoadedFor use = LoadedFor::running, const UsedOutside& used_outside = {});

/// A valid project as the text of one file: what it includes and the instances of its templates are in their
/// places.
/// @throws UnreadableFile
std::string expanded_project(const std::string& path);

}  // namespace lockstep
