// What `lockstep run` shows while it runs and at its end.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "cli/command/command.hpp"
#include "cli/run/run_command.hpp"
#include "cli/run/told.hpp"
#include "scheduler/units.hpp"

namespace lockstep::cli {
namespace {

constexpr int kDefaultWidth = 100;  // columns, where the terminal does not tell
constexpr double kRest = 1e-12;     // [u] below it, what position control has left of a deviation: shown as 0
constexpr double kTurns = 1e-6;     // [1/min] below it, what a drive has left of a velocity: standing

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kDefaultWidth;
}

std::string shown_value(Value value, Type type) {
  if (type == Type::BOOL) return value.u != 0 ? "TRUE" : "FALSE";
  if (is_real(type)) return fmt::format("{:.3f}", value.r);
  if (is_signed_integer(type)) return fmt::format("{}", value.i);
  if (type == Type::TIME) return fmt::format("{:.3f}s", static_cast<double>(value.i) * 1e-9);
  return fmt::format("{}", value.u);
}

std::string state_text(const AxisSummary& axis, bool has_position) {
  if (!has_bit(axis.status_word, StatusBit::Enable)) return "not enabled";
  if (has_bit(axis.status_word, StatusBit::Synchronous)) return "synchronous";
  if (has_bit(axis.status_word, StatusBit::Synchronizing)) return "synchronizing";
  if (!has_position) return std::abs(axis.position) < kTurns ? "standing" : "turning";
  return has_bit(axis.status_word, StatusBit::Standstill) ? "standing" : "moving";
}

/// Whether an axis was under way when its run ended and has been braked since.
bool brought_to_rest(const AxisSummary& end, const Axis& now) {
  const bool stood =
      now.has_position() ? has_bit(end.status_word, StatusBit::Standstill) : std::abs(end.position) < kTurns;
  return has_bit(end.status_word, StatusBit::Enable) && !stood && now.off();
}

/// Where an axis was, and where it is; of a speed axis how fast.
std::string place_text(const AxisSummary& end, const Axis& now) {
  const bool braked = brought_to_rest(end, now);
  if (!now.has_position()) {
    const double velocity = std::abs(end.position) < kTurns ? 0.0 : end.position;
    return fmt::format("at {:.6g} {}", velocity, unit_of(Unit::kVelocity, now)) +
           (braked ? "; brought to rest" : "");
  }
  const std::string unit = unit_of(Unit::kPosition, now);
  const double position = std::abs(end.position) < kRest ? 0.0 : end.position;
  const std::string place = fmt::format("at {:.6g} {}", position, unit);
  return braked ? place + fmt::format("; brought to rest at {:.6g} {}", now.data.ActualPosition, unit)
                : place;
}

}  // namespace

Display::Display(Project& project, const std::vector<NamedSignal>& signals, std::int64_t duration, bool alone)
    : shown_(signals), duration_(duration), terminal_(alone && isatty(STDERR_FILENO) == 1) {
  if (!terminal_) return;
  image_ = std::make_unique<ProcessImage>(places_of(shown_));
  project.controller->images.push_back(image_.get());
}

void Display::show(std::int64_t time, const std::string& note) {
  if (!terminal_) return;
  image_->refresh();
  std::string line = fmt::format("{:8.2f} s", static_cast<double>(time) * 1e-9);
  if (duration_ > 0)
    line += fmt::format(" {:3.0f} %", 100.0 * static_cast<double>(time) / static_cast<double>(duration_));
  line += note;
  const auto width = static_cast<std::size_t>(terminal_width() - 1);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const std::string part =
        fmt::format("  {} {}", shown_[i].name, shown_value(image_->value(i), image_->type(i)));
    if (line.size() + part.size() > width) break;
    line += part;
  }
  line.resize(std::min(line.size(), width));
  write_message("\r\033[K" + line, 0);
  open_ = true;
}

void Display::close() {
  if (open_) write_message("\n");
  open_ = false;
}

void tell_proxies(const Controller& controller) {
  for (const auto& object : controller.objects) {
    if (object->kind != ObjectKind::TO_LeadingAxisProxy) continue;
    const auto& proxy = static_cast<const LeadingAxisProxy&>(*object);
    const TelegramCounters& counts = proxy.counters();
    const int alarm = static_cast<int>(proxy.data.ErrorDetail.Number);
    write_message(fmt::format(
        "  {}  {} telegrams, {} missing, {} late, {} doubled, {} refused; {} by {:.3f} ms{}\n", proxy.name,
        counts.received, counts.missing, counts.late, counts.doubled, counts.refused,
        proxy.data.StatusExternalLeadingValue.AdjustmentTime > 0.0 ? "extrapolated" : "interpolated",
        std::abs(proxy.data.StatusExternalLeadingValue.AdjustmentTime) * 1e3,
        alarm == 0 ? "" : fmt::format("; alarm {}", alarm)));
  }
}

void tell_axes(const Controller& controller, const ToldOnStandardError& told) {
  std::size_t width = 4;
  for (const auto& axis : controller.axes) width = std::max(width, axis->name.size());
  for (std::size_t i = 0; i < controller.axes.size(); ++i) {
    const AxisSummary& end = controller.summary()[i];
    const Axis& axis = *controller.axes[i];
    const std::string state = end.alarm == 0 ? state_text(end, axis.has_position())
                                             : told.alarm_text(axis.name, static_cast<int>(end.alarm));
    std::string line = fmt::format("  {:<{}}  {:<14} {}", axis.name, width, state, place_text(end, axis));
    if (axis.was_synchronous())
      line += fmt::format("; largest deviation while synchronous {:.3g} {}", end.largest_deviation,
                          unit_of(Unit::kPosition, axis));
    write_message(line + "\n");
  }
}

}  // namespace lockstep::cli
