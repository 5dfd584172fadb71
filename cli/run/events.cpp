// Alarms and failed jobs as messages.
#include "cli/run/events.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "cli/command/command.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "tech_objects/alarms/alarms.hpp"

namespace lockstep::cli {
namespace {

constexpr std::int64_t kWindow = 10'000'000'000;  // [ns] in which the same is not told again and again
constexpr int kAlarmsInWindow = 3;  // of one number: an operator may acknowledge, and see that it comes again
constexpr int kInSecond = 20;       // messages in a second of the run
constexpr std::size_t kMaximumKinds = 256;  // that are counted one by one

std::string head(const TraceEvent& event) {
  return fmt::format("lockstep: {:.6f} s: {}", static_cast<double>(event.t) * 1e-9, visible(event.source));
}

/// When it was, for a log book: the tick, and where the run follows it the clock on the wall.
std::string moment(const TraceEvent& event) {
  std::string text = fmt::format("tick {}", event.tick);
  if (event.utime == 0) return text;
  const std::time_t seconds = event.utime / 1'000'000;
  return text +
         fmt::format(", {:%Y-%m-%d %H:%M:%S}.{:06} UTC", fmt::gmtime(seconds), event.utime % 1'000'000);
}

std::string alarm_message(const TraceEvent& event) {
  const std::string reaction = event.reaction == 0 ? "no reaction" : event.reaction_text;
  std::string text =
      head(event) + fmt::format(": alarm {}: {} ({})\n", event.number, visible(event.text), reaction);
  text += "  " + moment(event) + "\n";
  for (const std::string& line : detail_lines(event)) text += "  " + visible(line) + "\n";
  return text;
}

std::string job_text(const TraceEvent& event) {
  std::string text = " (" + visible(event.type);
  if (!event.object.empty()) text += " of " + visible(event.object);
  return text + ")";
}

/// What is told without its time.
std::string what_of(const TraceEvent& event) {
  switch (event.kind) {
    case EventKind::alarm:
      return fmt::format(": alarm {}", event.number);
    case EventKind::acknowledged:
      return ": alarms acknowledged";
    case EventKind::printed:
      return ": " + visible(event.text);
    case EventKind::program_error:
      return fmt::format(": error {}: {}", event.number, visible(event.text));
    case EventKind::job_failed:
      return job_text(event) + fmt::format(": failed, ErrorID 16#{:04X}: {}",
                                           static_cast<unsigned>(event.number), visible(event.text));
    default:
      return job_text(event) + ": aborted " + visible(event.text);
  }
}

/// Jobs are aborted all the time; that a shift has not been made to its end is easily overlooked.
bool is_told(const TraceEvent& event) {
  switch (event.kind) {
    case EventKind::alarm:
    case EventKind::acknowledged:
    case EventKind::job_failed:
    case EventKind::printed:
    case EventKind::program_error:
      return true;
    case EventKind::job_aborted:
      return event.type.starts_with("MC_Offset") || event.type.starts_with("MC_Phasing");
    default:
      return false;
  }
}

}  // namespace

void clear_line() noexcept {
  if (isatty(STDERR_FILENO) == 1) write_message("\r\033[K", 0);
}

/// Whether an event gets a message of its own; if not it is counted.
bool EventMessages::may_tell(const TraceEvent& event) {
  const bool of_alarms = of_object(event.kind);
  const Key key{event.kind, event.source, event.number};
  if (!seen_.contains(key) && seen_.size() == kMaximumKinds) {
    ++more_;
    return false;
  }
  Seen& seen = seen_[key];
  if (seen.told > 0 && event.t - seen.since > kWindow) {
    if (seen.more > 0)
      folded_ += fmt::format("lockstep: {}{}: {} more times\n", visible(event.source), seen.what, seen.more);
    seen = {};
  }
  const std::int64_t second = event.t / 1'000'000'000;
  if (second != second_) in_second_ = 0;
  second_ = second;
  if (seen.told >= (of_alarms ? kAlarmsInWindow : 1) || in_second_ >= kInSecond) {
    ++seen.more;
    seen.what = what_of(event);
    return false;
  }
  if (seen.told++ == 0) seen.since = event.t;
  ++in_second_;
  return true;
}

std::string EventMessages::of(const TraceEvent& event) {
  if (!is_told(event)) return "";
  // What a program prints is its output, of which nothing is left out.
  const bool told = event.kind == EventKind::printed || may_tell(event);
  std::string text = std::move(folded_);
  folded_.clear();
  if (!told) return text;
  if (event.kind == EventKind::alarm) return text + alarm_message(event);
  text += head(event) + what_of(event) + "\n";
  // What helps against an alarm stands with the alarm.
  const bool by_alarm = event.number == static_cast<int>(ErrorId::technology_alarm);
  if (event.kind == EventKind::job_failed && !by_alarm)
    for (const std::string& line : detail_lines(event)) text += "  " + visible(line) + "\n";
  return text;
}

std::string EventMessages::rest() {
  std::string text = std::move(folded_);
  for (const auto& [key, seen] : seen_)
    if (seen.more > 0)
      text += fmt::format("lockstep: {}{}: {} more times\n", visible(std::get<1>(key)), seen.what, seen.more);
  if (more_ > 0) text += fmt::format("lockstep: {} more alarms and failed jobs were not told\n", more_);
  seen_.clear();
  more_ = 0;
  return text;
}

}  // namespace lockstep::cli
