/// What the schema has of calls besides their keys.
#pragma once

#include "projects/keys/schema.hpp"

namespace lockstep {

/// A call of any kind, the function blocks, and of each block what its inputs take.
void add_call_definitions(KeySchema& keys);

}  // namespace lockstep
