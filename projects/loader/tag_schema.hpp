/// What the schema has of tags besides their keys.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lockstep {

/// The type of a tag, and its value at the start, which depends on that. `definitions` has "tags", as their
/// keys make it.
void add_tag_definitions(nlohmann::ordered_json& definitions);

}  // namespace lockstep
