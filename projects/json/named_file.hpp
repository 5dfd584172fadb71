/// Files that a project names.
#pragma once

#include <optional>
#include <string>

#include "projects/json/problem.hpp"

namespace lockstep {

/// Whether a file is, or would be, in a folder or below it, symbolic links resolved.
/// @param folder empty: the current one
bool stays_within(const std::string& path, const std::string& folder);

/// Where the file is that a value names, relative to `folder`. A project that is copied is whole, and what it
/// tells of its files is of none of others: what leads out of its folder is reported, and has no path.
/// @param top folder of the project
std::optional<std::string> named_file(const JsonValue& name, const std::string& folder,
                                      const std::string& top, Problems& problems);

}  // namespace lockstep
