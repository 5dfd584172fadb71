/// What the schema says of constant values.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A value of an elementary type as `read_plain_constant` takes it, or a text, which may be an expression.
nlohmann::ordered_json constant_schema(Type type);

}  // namespace lockstep
