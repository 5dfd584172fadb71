#include "cli/run/told.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "cli/command/command.hpp"
#include "tech_objects/alarms/alarms.hpp"

namespace lockstep::cli {

void ToldOnStandardError::inform(const std::string& text) noexcept {
  tell(controller_.empty() ? text : controller_ + ": " + text);
}

void ToldOnStandardError::warn(const std::string& text) noexcept {
  clear_line();
  tell("warning: " + (controller_.empty() ? text : controller_ + ": " + text), Severity::warning);
}

namespace {

bool is_warning(const TraceEvent& event) {
  const Alarm* const alarm = find_alarm(event.number);
  return event.reaction == 0 && alarm != nullptr && alarm->alarm_class == AlarmClass::warning;
}

}  // namespace

void ToldOnStandardError::event(const TraceEvent& event) {
  if (event.kind == EventKind::alarm) {
    ++(is_warning(event) ? warnings_ : alarms_);
    // Of the same once: objects and numbers have an end.
    texts_.insert_or_assign({event.source, event.number}, event.text);
  }
  if (event.kind == EventKind::job_failed) ++failed_jobs_;
  std::string text;
  if (controller_.empty()) {
    text = events_.of(event);
  } else {
    TraceEvent named = event;
    named.source = controller_ + "." + event.source;
    text = events_.of(named);
  }
  // On a terminal the line of live values stands where the message goes.
  if (!text.empty()) write_message((isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") + text, timeout_);
}

std::string ToldOnStandardError::alarm_text(const std::string& object, int number) const {
  const auto told = texts_.find({object, number});
  const Alarm* const alarm = find_alarm(number);
  const std::string_view published = alarm == nullptr ? "" : alarm->text;
  return fmt::format("alarm {} ({})", number, told == texts_.end() ? published : told->second);
}

void ToldOnStandardError::tell_rest() {
  if (const std::string text = events_.rest(); !text.empty()) write_message(text);
}

void tell_counters(const Controller& controller, const std::string& who, std::int64_t divided) {
  const std::string begin = "warning: " + who;
  if (const auto zero = controller.counters().evaluation.integer_divisions_by_zero; zero != 0)
    tell(begin + fmt::format("{} integer divisions by zero gave 0", zero) +
         (divided < 0 ? "" : fmt::format(", the first at {} s", static_cast<double>(divided) * 1e-9)));
  if (const auto outside = controller.counters().evaluation.indices_out_of_range; outside != 0)
    tell(begin + fmt::format("{} indices of arrays were out of range; what was read there counted as 0, what "
                             "was to be written is lost",
                             outside));
  std::uint64_t silences = 0;
  for (const Watchdog& watchdog : controller.watchdogs) silences += watchdog.silences();
  if (silences != 0)
    tell(begin + fmt::format("Modbus: a watchdog has found its client silent {} times", silences));
  std::uint64_t refused = 0;
  for (const Program& program : controller.programs) refused += program.refused_assignments();
  if (refused != 0)
    tell(begin + fmt::format("{} assignments of values that are not permitted were refused", refused));
}

int status_of(int status, const FailOn& fail_on, const ToldOnStandardError& told,
              const Controller& controller) {
  if (status != kOk || (!fail_on.alarm && !fail_on.warning && !fail_on.job)) return status;
  std::string reason;
  const auto count = [&reason](bool counts, std::uint64_t number, const char* what) {
    if (counts && number > 0) reason += fmt::format("{}{} {}", reason.empty() ? "" : ", ", number, what);
  };
  count(fail_on.alarm, told.alarms(), "alarms");
  count(fail_on.warning, told.warnings(), "warnings");
  count(fail_on.job, told.failed_jobs(), "failed jobs");
  if (const std::uint64_t lost = controller.events == nullptr ? 0 : controller.events->lost();
      reason.empty() && lost > 0)
    reason = fmt::format("{} events were lost, which may have been such ones", lost);
  if (reason.empty()) return status;
  tell("failed: " + reason + " (--fail-on)", Severity::error);
  return kFailedOn;
}

}  // namespace lockstep::cli
