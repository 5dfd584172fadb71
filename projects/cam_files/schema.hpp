/// The JSON Schema of cam files, for editors.
/// @source JSON Schema draft-07
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lockstep {

/// The schema as text, made from the members that the reader knows. What it accepts, the reader may still
/// refuse, never the other way round. `cam.schema.json` is this text; a test compares them.
std::string cam_schema();

/// What a cam is defined by, as members of an object: for cam files and for cams in projects. They refer to
/// `cam_schema_definitions`.
nlohmann::ordered_json cam_definition_schema();
nlohmann::ordered_json cam_schema_definitions();

}  // namespace lockstep
