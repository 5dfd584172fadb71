/// How much memory each thread of a run takes.
#pragma once

#include <cstddef>

namespace lockstep {

inline constexpr std::size_t kThreadStack = 1 << 20;  ///< [byte]

/// From here on each thread that is begun gets a stack of `kThreadStack`. Those of the system are eight times
/// as large, and a run locks them into memory whole, for each connection to a foreign device. Before the
/// first one.
void keep_stacks_small() noexcept;

}  // namespace lockstep
