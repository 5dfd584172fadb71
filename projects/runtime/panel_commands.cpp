#include "projects/runtime/panel_commands.hpp"

#include <fmt/format.h>

#include <utility>

namespace lockstep {
namespace {

std::vector<Signal> signals_of(const Project& project) {
  std::vector<Signal> signals;
  for (const CommandAxis& axis : project.commands.axes)
    signals.insert(signals.end(), axis.signals.begin(), axis.signals.end());
  return signals;
}

}  // namespace

PanelCommands::PanelCommands(Project& project, SharedDesk::Answers answers, AuditLog* audit,
                             Messages& messages)
    : messages_(messages),
      image_(signals_of(project)),
      desk_(project.commands.axes, image_, project.controller->clock.servo_cycle, std::move(answers)) {
  project.controller->images.push_back(&image_);
  if (audit != nullptr) desk_.audit_to(*audit);
}

void PanelCommands::hear(const std::string& url, const LcmTraceIdentity& identity) {
  auto listener = std::make_unique<CommandListener>(url, identity, desk_);
  messages_.inform(fmt::format("commands from panels on {}, channel {}{}: {}", url, identity.channel,
                               kCommandSuffix, desk_.axes_text(CommandRoute::lcm)));
  listener_ = std::move(listener);
  listener_->start();
}

void PanelCommands::tell_counters() {
  const CommandCounters counters = desk_.counters();
  if (counters.accepted != 0)
    messages_.inform(fmt::format("commands from panels: {} accepted", counters.accepted));
  const auto warn = [this](std::uint64_t count, std::string_view text) {
    if (count != 0) messages_.warn(fmt::format("commands from panels: {} {}", count, text));
  };
  warn(counters.malformed, "refused: not a command");
  warn(counters.stale, "refused: of another run, too old or repeated");
  warn(counters.not_valid, "refused: an axis, action or value that is not permitted");
  warn(counters.impossible, "refused: the axis is in other hands");
  warn(counters.too_many, "refused: too many commands or panels");
  if (listener_) warn(listener_->faults(), "internal faults survived");
}

}  // namespace lockstep
