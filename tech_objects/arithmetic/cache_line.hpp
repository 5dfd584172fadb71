/// How memory is laid out for the processor. What every cycle touches lies together, at the begin of a line:
/// with a thousand axes the memory that has to be fetched, not the arithmetic, decides how long a cycle
/// takes.
#pragma once

#include <cstddef>

namespace lockstep {

/// Bytes that the processor moves at a time.
inline constexpr std::size_t kCacheLine = 64;

}  // namespace lockstep
