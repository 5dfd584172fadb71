/// Couples one controller of a system to the others, in real time.
#pragma once

#include <cstddef>

#include "projects/system/system.hpp"

namespace lockstep {

/// Adds to the project of a controller what crosses from it to others and from others to it; areas of which
/// both ends are on it stay within it. Once for each controller, before it runs.
void couple(System& system, std::size_t controller);

}  // namespace lockstep
