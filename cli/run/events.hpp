/// lockstep run: alarms as messages.
#pragma once

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep::cli {

/// On a terminal, takes the line of live values away that stands where a message goes.
void clear_line() noexcept;

/// Tells an alarm or its acknowledgement on standard error; nothing of other events.
/// @param timeout how long the message waits for a reader [ms]
void tell_alarm(const TraceEvent& event, int timeout);

}  // namespace lockstep::cli
