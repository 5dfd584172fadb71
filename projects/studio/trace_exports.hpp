/// Traces as files: CSV, LCM logs, a page that needs no server.
#pragma once

#include <cstdint>
#include <string>

#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/trace_part.hpp"

namespace lockstep::studio_api {

inline constexpr std::uint64_t kExportValues = 5'000'000;  ///< of an export, times among them

/// `GET …/export?format=csv|lcm|html`. @param history of the trace @throws BadRequest
StudioAnswer export_answer(const StudioRequest& request, const TraceStore& store, const TracePart& part,
                           const StudioHistory& history);
/// The page itself with these rows, and the events and jobs of their time, in it; it opens without a server.
/// @param name of the trace
std::string trace_page(const TraceStore& store, const TracePart& part, const StudioHistory& history,
                       const std::string& name);

}  // namespace lockstep::studio_api
