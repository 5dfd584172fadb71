// Alarms as messages.
#include "cli/run/events.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "cli/command/command.hpp"
#include "hmi_bridge/network/visible_text.hpp"

namespace lockstep::cli {

void clear_line() noexcept {
  if (isatty(STDERR_FILENO) == 1) write_message("\r\033[K", 0);
}

void tell_alarm(const TraceEvent& event, int timeout) {
  std::string text;
  const double seconds = static_cast<double>(event.t) * 1e-9;
  if (event.kind == EventKind::alarm) {
    const std::string reaction = event.reaction == 0 ? "no reaction" : event.reaction_text;
    text = fmt::format("lockstep: {:.6f} s: {}: alarm {}: {} ({})\n", seconds, visible(event.source),
                       event.number, visible(event.text), reaction);
  } else if (event.kind == EventKind::acknowledged) {
    text = fmt::format("lockstep: {:.6f} s: {}: alarms acknowledged\n", seconds, visible(event.source));
  } else if (event.kind == EventKind::printed) {
    text = fmt::format("lockstep: {:.6f} s: {}: {}\n", seconds, visible(event.source), visible(event.text));
  } else if (event.kind == EventKind::program_error) {
    text = fmt::format("lockstep: {:.6f} s: {}: error {}: {}\n", seconds, visible(event.source), event.number,
                       visible(event.text));
  } else {
    return;
  }
  // On a terminal the line of live values stands where the message goes.
  write_message((isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") + text, timeout);
}

}  // namespace lockstep::cli
