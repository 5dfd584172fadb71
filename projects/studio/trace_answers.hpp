/// What may be asked of a trace, whichever it is.
#pragma once

#include <string_view>

#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/history.hpp"

namespace lockstep::studio_api {

/// Signals, times, rows and gaps.
Json trace_json(std::string_view id, const TraceStore& store);

/// `window`, `statistics`, `spectrum` or `export` of the signals and the time that the request names.
/// @param history of the trace @throws BadRequest
StudioAnswer trace_answer(const StudioRequest& request, std::string_view what, const TraceStore& store,
                          const StudioHistory& history);

}  // namespace lockstep::studio_api
