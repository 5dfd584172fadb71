/// The JSON Schemas of the project file and of the files that it includes, for editors: structure, types,
/// ranges, units and defaults.
/// @source JSON Schema draft-07
#pragma once

#include <string>

namespace lockstep {

/// The schema as text, made from the loader's keys and from the declarations of blocks and variables. It
/// knows no names and no expressions: what it accepts, the loader may still refuse, never the other way
/// round. `project.schema.json` is this text; a test compares them.
std::string project_schema();

/// The schema of a file that a project includes, as text. `part.schema.json` is this text.
std::string part_schema();

/// The schema of a system file, as text. `system.schema.json` is this text.
std::string system_schema();

}  // namespace lockstep
