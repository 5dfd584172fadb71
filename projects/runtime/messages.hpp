/// What a run has to say.
#pragma once

#include <string>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Hears what a run tells; whoever starts one decides where that goes. Texts are single lines, parts of which
/// may come from files and networks: `visible` shows what a terminal would obey. What
/// waits for long here holds up what is told next.
class Messages {
 public:
  virtual ~Messages() = default;

  /// How things are: where a server listens, what is kept. One thread at a time.
  virtual void inform(const std::string& text) noexcept = 0;
  /// What somebody has to look at. One thread at a time.
  virtual void warn(const std::string& text) noexcept = 0;
  /// Alarms and their acknowledgement, in their order; jobs where a trace has them. Thread: the recorder's,
  /// beside those above; what is thrown here counts as a loss of the trace.
  virtual void event(const TraceEvent& /*event*/) {}
};

}  // namespace lockstep
