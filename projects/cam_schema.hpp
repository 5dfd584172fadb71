/// The JSON Schema of cam files, for editors.
/// @source JSON Schema draft-07
#pragma once

#include <string>

namespace lockstep {

/// The schema as text, made from the members that the reader knows. What it accepts, the reader may still
/// refuse, never the other way round. `cam.schema.json` is this text; a test compares them.
std::string cam_schema();

}  // namespace lockstep
