/// Commands of operators' panels.
#pragma once

#include <memory>
#include <string>

#include "hmi_bridge/lcm/command_listener.hpp"
#include "hmi_bridge/lcm/shared_desk.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/messages.hpp"

namespace lockstep {

/// Takes the commands of a project that allows them, over LCM and of pages of the studio. Tells at the end
/// what was refused.
class PanelCommands {
 public:
  /// The run must not have begun. @param answers go to the recorder; on the thread of whoever commands
  /// @param audit may be nullptr; it and `messages` outlive this
  PanelCommands(Project& project, SharedDesk::Answers answers, AuditLog* audit, Messages& messages);

  /// Joins a network to hear commands there. @throws as CommandListener
  void hear(const std::string& url, const LcmTraceIdentity& identity);
  /// For the pages of a studio.
  SharedDesk& desk() noexcept { return desk_; }
  /// Hears no more; before the recorder stops.
  void end() {
    if (listener_) listener_->stop();
  }
  void tell_counters();

 private:
  Messages& messages_;
  ProcessImage image_;
  SharedDesk desk_;
  std::unique_ptr<CommandListener> listener_;
};

}  // namespace lockstep
