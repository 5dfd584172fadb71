#include "cli/monitor/panel.hpp"

#include <algorithm>
#include <iterator>

namespace lockstep::cli {

void Panel::accept(const std::string& channel, const panel_t& state, Clock::time_point now) {
  const std::pair key(channel, state.axis);
  if (!axes_.contains(key) && axes_.size() >= kMaximumAxes) return;
  axes_[key] = {channel, state, now};
}

const PanelAxis* Panel::chosen() const {
  const auto found = axes_.find(chosen_);
  if (found != axes_.end()) return &found->second;
  return axes_.empty() ? nullptr : &axes_.begin()->second;
}

void Panel::choose_next() {
  if (axes_.empty()) return;
  const PanelAxis* const now = chosen();
  auto next = std::next(axes_.find({now->channel, now->state.axis}));
  if (next == axes_.end()) next = axes_.begin();
  chosen_ = next->first;
}

void Panel::change_percent(int steps) noexcept {
  percent_ = std::clamp(percent_ + steps, 0, static_cast<int>(std::size(kPercents)) - 1);
}

std::optional<OutgoingCommand> Panel::command(std::int32_t action, double value, Clock::time_point now) {
  const PanelAxis* const axis = chosen();
  if (axis == nullptr || now - axis->heard > kSilent) return std::nullopt;
  const bool jog = action == command_t::JOG_FORWARD || action == command_t::JOG_BACKWARD;
  OutgoingCommand out;
  out.channel = axis->channel + std::string(kCommandSuffix);
  out.command.run = axis->state.run;
  out.command.beat = axis->state.beat;
  out.command.sender = sender_;
  out.command.sequence = ++sequence_;
  out.command.action = action;
  out.command.value = jog ? axis->state.jog_velocity * percent() / 100.0 : value;
  out.command.axis = axis->state.axis;
  return out;
}

}  // namespace lockstep::cli
