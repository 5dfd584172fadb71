/// The JSON Schema of the project file, for editors: structure, types, ranges, units and defaults.
/// @source JSON Schema draft-07
#pragma once

#include <string>

namespace lockstep {

/// The schema as text, made from the loader's keys and from the declarations of blocks and variables. It
/// knows no names and no expressions: what it accepts, the loader may still refuse, never the other way
/// round. `project.schema.json` is this text; a test compares them.
std::string project_schema();

}  // namespace lockstep
