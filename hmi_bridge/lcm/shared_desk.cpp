#include "hmi_bridge/lcm/shared_desk.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "hmi_bridge/network/visible_text.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kLongestAxis = 128;  // of a name that is told

std::int64_t number_by_chance() {
  std::random_device chance;
  return static_cast<std::int64_t>(std::uint64_t{chance()} << 32 | chance());
}

}  // namespace

SharedDesk::SharedDesk(std::vector<CommandAxis> axes, ProcessImage& image, std::int64_t servo_cycle,
                       Answers answers)
    : image_(image),
      desk_(std::move(axes), image, number_by_chance()),
      servo_cycle_(servo_cycle),
      answers_(std::move(answers)) {}

AuditEntry SharedDesk::entry_of(const CommandDesk::Judged& judged) const {
  AuditEntry entry;
  entry.tick = image_.tick();
  entry.via = route_name_;
  entry.from = from_.empty() ? "this process" : std::string(from_);
  entry.source = entry.from.substr(0, entry.from.rfind(':'));
  entry.before = judged.before;
  entry.after = judged.after;
  entry.accepted = judged.reason.empty();
  entry.why = judged.reason;
  entry.action = "command";
  // Texts and numbers of a stranger are told, but what repeats is not parted by them.
  if (entry.accepted) entry.subject = judged.command->axis;
  for (const auto count : {&CommandCounters::malformed, &CommandCounters::stale, &CommandCounters::not_valid,
                           &CommandCounters::impossible, &CommandCounters::too_many})
    entry.subject += judged.count == count ? '1' : '0';
  if (judged.command != nullptr) {
    entry.who = "panel " + std::to_string(judged.command->sender);
    entry.target = judged.command->axis.substr(0, kLongestAxis);
    if (const auto action = action_text(judged.command->action); !action.empty()) entry.action = action;
  }
  return entry;
}

void SharedDesk::audit_to(AuditLog& log) {
  desk_.watch([this, &log](const CommandDesk::Judged& judged) { log.add(entry_of(judged)); });
}

void SharedDesk::take(std::span<const std::uint8_t> bytes, std::string_view sender) {
  const std::lock_guard lock(mutex_);
  from_ = sender;
  route_name_ = "lcm";
  const auto answer = desk_.accept(bytes, Clock::now());
  if (answer) tell(answer->accepted, answer->axis, answer->action, answer->reason, "");
}

CommandDesk::Verdict SharedDesk::give(const command_t& command, std::string_view address) {
  const std::lock_guard lock(mutex_);
  from_ = address;
  route_name_ = "studio";
  CommandDesk::Verdict verdict = desk_.give(command, Clock::now(), CommandRoute::studio);
  if (verdict.is_told)
    tell(verdict.accepted, command.axis.substr(0, kLongestAxis), action_text(command.action), verdict.reason,
         address);
  return verdict;
}

void SharedDesk::leave(std::int64_t sender) {
  const std::lock_guard lock(mutex_);
  desk_.leave(sender, Clock::now());
}

void SharedDesk::beat(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (now < next_beat_) return;
  next_beat_ = std::max(next_beat_ + kBeat, now);
  desk_.beat();
}

std::vector<SharedDesk::Panel> SharedDesk::panels(CommandRoute route) {
  const std::lock_guard lock(mutex_);
  image_.refresh();
  const auto now = Clock::now();
  std::vector<Panel> panels;
  for (std::size_t axis = 0; axis < desk_.axes().size(); ++axis) {
    if (!is_commanded_by(desk_.axes()[axis], route)) continue;
    Panel& panel =
        panels.emplace_back(desk_.panel(axis), desk_.axes()[axis].enabled_by, desk_.holder(axis, now));
    panel.stand.t = time();
  }
  return panels;
}

bool SharedDesk::has_axes(CommandRoute route) const noexcept {
  return std::ranges::any_of(desk_.axes(),
                             [route](const CommandAxis& axis) { return is_commanded_by(axis, route); });
}

std::string SharedDesk::axes_text(CommandRoute route) const {
  std::string text;
  for (const CommandAxis& axis : desk_.axes())
    if (is_commanded_by(axis, route)) text += (text.empty() ? "" : ", ") + axis.name;
  return text;
}

CommandCounters SharedDesk::counters() const {
  const std::lock_guard lock(mutex_);
  return desk_.counters();
}

std::int64_t SharedDesk::time() const noexcept {
  return std::max<std::int64_t>(image_.tick(), 0) * servo_cycle_;
}

void SharedDesk::tell(bool accepted, const std::string& axis, std::string_view action,
                      const std::string& reason, std::string_view address) {
  image_.refresh();
  TraceEvent event;
  event.kind = accepted ? EventKind::command_accepted : EventKind::command_refused;
  event.t = time();
  event.tick = static_cast<std::uint64_t>(std::max<std::int64_t>(image_.tick(), 0));
  event.source = visible(axis);  // it goes on to panels and logs
  event.type = action;
  event.text = reason;
  event.address = address;
  answers_(std::move(event));
}

}  // namespace lockstep
