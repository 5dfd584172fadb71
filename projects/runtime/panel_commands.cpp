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

PanelCommands::PanelCommands(Project& project, const std::string& url, const LcmTraceIdentity& identity,
                             TraceRecorder& recorder, AuditLog* audit, Messages& messages)
    : messages_(messages),
      image_(signals_of(project)),
      listener_(url, identity, project.commands.axes, image_, project.controller->clock.servo_cycle,
                [&recorder](TraceEvent answer) { recorder.tell(std::move(answer)); }) {
  project.controller->images.push_back(&image_);
  std::string axes;
  for (const CommandAxis& axis : project.commands.axes) axes += (axes.empty() ? "" : ", ") + axis.name;
  messages_.inform(fmt::format("commands from panels on {}, channel {}{}: {}", url, identity.channel,
                               kCommandSuffix, axes));
  if (audit != nullptr) listener_.audit_to(*audit);
  listener_.start();
}

void PanelCommands::tell_counters() {
  const CommandCounters& counters = listener_.counters();
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
  warn(listener_.faults(), "internal faults survived");
}

}  // namespace lockstep
