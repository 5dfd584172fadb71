/// Which signals and rows of a trace a request asks for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/api.hpp"

namespace lockstep::studio_api {

inline constexpr std::size_t kWindowSignals = 512;    ///< of a window, statistics or an export
inline constexpr std::size_t kWindowPoints = 20'000;  ///< of a window or a curve of XY

/// What of a trace is asked for.
struct TracePart {
  std::vector<std::size_t> columns;
  std::uint64_t first = 0, behind = 0;  ///< rows
};
/// The rows that a request names by `from` and `to`, no columns. @throws BadRequest
TracePart trace_part(const StudioRequest& request, const TraceStore& store);

}  // namespace lockstep::studio_api
