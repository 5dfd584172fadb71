// What `lockstep run` shows while it runs and at its end.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "cli/command.hpp"
#include "cli/run_command.hpp"

namespace lockstep::cli {
namespace {

constexpr int kDefaultWidth = 100;  // columns, where the terminal does not tell
constexpr double kRest = 1e-12;     // [u] below it, what position control has left of a deviation: shown as 0

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kDefaultWidth;
}

std::string value_text(Value value, Type type) {
  if (type == Type::BOOL) return value.u != 0 ? "TRUE" : "FALSE";
  if (is_real(type)) return fmt::format("{:.3f}", value.r);
  if (is_signed_integer(type)) return fmt::format("{}", value.i);
  if (type == Type::TIME) return fmt::format("{:.3f}s", static_cast<double>(value.i) * 1e-9);
  return fmt::format("{}", value.u);
}

std::string state_text(const AxisSummary& axis) {
  if (axis.alarm != 0) {
    const Alarm* alarm = find_alarm(static_cast<int>(axis.alarm));
    return fmt::format("alarm {} ({})", axis.alarm, alarm == nullptr ? "" : alarm->text);
  }
  if (!has_bit(axis.status_word, StatusBit::Enable)) return "not enabled";
  if (has_bit(axis.status_word, StatusBit::Synchronous)) return "synchronous";
  if (has_bit(axis.status_word, StatusBit::Synchronizing)) return "synchronizing";
  return has_bit(axis.status_word, StatusBit::Standstill) ? "standing" : "moving";
}

/// Whether an axis was under way when its run ended and has been braked since.
bool brought_to_rest(const AxisSummary& end, const Axis& now) {
  const bool moved =
      has_bit(end.status_word, StatusBit::Enable) && !has_bit(end.status_word, StatusBit::Standstill);
  return moved && now.off();
}

}  // namespace

Display::Display(Project& project, const std::vector<NamedSignal>& signals, std::int64_t duration)
    : shown_(signals), duration_(duration), terminal_(isatty(STDERR_FILENO) == 1) {
  if (!terminal_) return;
  std::vector<Signal> places;
  for (const NamedSignal& signal : shown_) places.push_back(signal.signal);
  image_ = std::make_unique<ProcessImage>(std::move(places));
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
        fmt::format("  {} {}", shown_[i].name, value_text(image_->value(i), image_->type(i)));
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

void tell_axes(const Controller& controller) {
  std::size_t width = 4;
  for (const auto& axis : controller.axes) width = std::max(width, axis->name.size());
  for (std::size_t i = 0; i < controller.axes.size(); ++i) {
    const AxisSummary& axis = controller.summary()[i];
    std::string line = fmt::format("  {:<{}}  {:<14} at {:.6g}", controller.axes[i]->name, width,
                                   state_text(axis), std::abs(axis.position) < kRest ? 0.0 : axis.position);
    if (brought_to_rest(axis, *controller.axes[i]))
      line += fmt::format("; brought to rest at {:.6g}", controller.axes[i]->data.ActualPosition);
    const bool followed = controller.axes[i]->was_synchronous();
    if (followed) line += fmt::format("; largest deviation while synchronous {:.3g}", axis.largest_deviation);
    write_message(line + "\n");
  }
}

}  // namespace lockstep::cli
