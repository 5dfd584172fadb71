/// Commands of operators' panels.
#pragma once

#include <memory>
#include <string>

#include "hmi_bridge/lcm/command_listener.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/messages.hpp"

namespace lockstep {

/// Takes the commands of a project that allows them; their answers go to the recorder. Tells at the end what
/// was refused.
class PanelCommands {
 public:
  /// Joins the network; the run must not have begun. @throws as CommandListener
  /// @param audit may be nullptr; it, `recorder` and `messages` outlive this
  PanelCommands(Project& project, const std::string& url, const LcmTraceIdentity& identity,
                TraceRecorder& recorder, AuditLog* audit, Messages& messages);
  /// Hears no more; before the recorder stops.
  void end() { listener_.stop(); }
  void tell_counters();

 private:
  Messages& messages_;
  ProcessImage image_;
  CommandListener listener_;
};

}  // namespace lockstep
