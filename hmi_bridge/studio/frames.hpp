/// Values on their path to a page: dense columns that it looks at in place. STUDIO.md has the layout.
#pragma once

#include <cstdint>
#include <vector>

#include "hmi_bridge/traces/store.hpp"

namespace lockstep {

enum class StudioFrameKind : std::uint8_t {
  rows = 1,    ///< of a subscription
  coarse = 2,  ///< the same, several rows to a point
  window = 3   ///< of a trace, rows or points as it says itself
};

/// What stands before the values.
struct StudioFrameHead {
  StudioFrameKind kind = StudioFrameKind::rows;
  std::uint32_t subscription = 0;
  std::uint32_t frame = 0;    ///< number
  std::uint64_t dropped = 0;  ///< rows missing before the first one
};

/// All parts begin on 8 bytes, little-endian.
std::vector<std::uint8_t> encode_frame(const StudioFrameHead& head, const TraceWindow& window);

}  // namespace lockstep
