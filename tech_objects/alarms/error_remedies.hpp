/// What helps against the error identifiers of blocks.
#pragma once

#include <string_view>

#include "tech_objects/alarms/alarms.hpp"

namespace lockstep {

/// What is to be done about an error identifier, or why nothing here reports it; empty for no error, and for
/// numbers that are none. Any thread.
std::string_view error_remedy(ErrorId id) noexcept;

}  // namespace lockstep
