/// What the schema has of LinMot controllers besides their keys.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lockstep {

/// Parameters in their directories, tables, points of curves.
void add_linmot_definitions(nlohmann::ordered_json& definitions);

}  // namespace lockstep
