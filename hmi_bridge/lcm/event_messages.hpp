/// Events of a trace, back from their LCM messages; LCM.md describes them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hmi_bridge/traces/event.hpp"

namespace lockstep {

/// @param bytes any, such as a stranger's; nothing: they are no `event_t`, or one of a kind that is not known
std::optional<TraceEvent> event_of(std::span<const std::uint8_t> bytes);

/// Adds what an `event_detail_t` knows of an event besides.
/// @return false: the bytes are none, or tell of another event
bool add_detail(TraceEvent& event, std::span<const std::uint8_t> bytes);

}  // namespace lockstep
