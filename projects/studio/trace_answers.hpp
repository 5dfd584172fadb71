/// What may be asked of a trace, whichever it is.
#pragma once

#include <string_view>

#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/api.hpp"

namespace lockstep::studio_api {

inline constexpr std::size_t kWindowSignals = 512;  ///< of a window, statistics or an export
inline constexpr std::size_t kWindowPoints = 20'000;

/// Signals, times, rows and gaps.
Json trace_json(std::string_view id, const TraceStore& store);

/// What of a trace is asked for.
struct TracePart {
  std::vector<std::size_t> columns;
  std::uint64_t first = 0, behind = 0;  ///< rows
};
/// The rows that a request names by `from` and `to`, no columns. @throws BadRequest
TracePart trace_part(const StudioRequest& request, const TraceStore& store);

/// `window`, `statistics`, `spectrum` or `export` of the signals and the time that the request names.
/// @throws BadRequest
StudioAnswer trace_answer(const StudioRequest& request, std::string_view what, const TraceStore& store);

}  // namespace lockstep::studio_api
