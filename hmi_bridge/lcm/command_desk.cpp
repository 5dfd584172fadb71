#include "hmi_bridge/lcm/command_desk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hmi_bridge/audit/entry.hpp"
#include "hmi_bridge/traces/csv_number.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr double kFarthest = 1e12;     // position of homing, as the pin has it [u]
constexpr double kHighestSpeed = 200;  // override [%]
constexpr double kHighestProgram = 127;
constexpr std::size_t kLongestName = 128;

std::string number_text(double number) {
  char text[kNumberLength];
  return {text, print_value(text, Value{.r = number}, Type::LREAL)};
}

bool is_jog(std::int32_t action) noexcept {
  return action == command_t::JOG_FORWARD || action == command_t::JOG_BACKWARD;
}

/// Bringing something to rest is never held back.
bool calms(std::int32_t action) noexcept {
  return action == command_t::STOP || action == command_t::DISABLE;
}

}  // namespace

CommandDesk::CommandDesk(std::vector<CommandAxis> axes, ProcessImage& image, std::int64_t run)
    : axes_(std::move(axes)),
      image_(image),
      run_(run),
      jogs_(axes_.size()),
      requests_(axes_.size() * kPanelSignals) {}

bool CommandDesk::Allowance::take(Clock::time_point now, int maximum) noexcept {
  if (now - second >= 1s) {
    second = now;
    used = 0;
  }
  return used++ < maximum;
}

Value CommandDesk::value(std::size_t axis, PanelSignal signal) const noexcept {
  return image_.value(axis * kPanelSignals + static_cast<std::size_t>(signal));
}

std::optional<std::size_t> CommandDesk::find(const std::string& axis, CommandRoute route) const {
  const auto same = [&](const CommandAxis& other) {
    return other.name == axis && is_commanded_by(other, route);
  };
  const auto found = std::find_if(axes_.begin(), axes_.end(), same);
  if (found == axes_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - axes_.begin());
}

std::optional<CommandDesk::Answer> CommandDesk::accept(std::span<const std::uint8_t> bytes,
                                                       Clock::time_point now) {
  const std::optional<command_t> command = decode_command(bytes);
  const Verdict verdict = command ? give(*command, now, CommandRoute::lcm)
                                  : refuse({&CommandCounters::malformed, "not a command"}, nullptr, now);
  if (!verdict.is_told) return std::nullopt;
  if (!command) return Answer{false, "", "", verdict.reason};
  return Answer{verdict.accepted, command->axis.substr(0, kLongestName),
                std::string(action_text(command->action)), verdict.reason};
}

CommandDesk::Verdict CommandDesk::give(const command_t& command, Clock::time_point now, CommandRoute route) {
  if (const auto refusal = judge(command, now, route)) return refuse(*refusal, &command, now);
  ++counters_.accepted;
  const std::size_t axis = *find(command.axis, route);
  if (watch_) tell_watch(command, axis);
  const Jog& jog = jogs_[axis];
  const bool goes_on = is_jog(command.action) && jog.action == command.action &&
                       jog.sender == command.sender && now < jog.until;
  replace_jog(command, axis, now);
  carry_out(command, axis);
  return {true, "", !goes_on};
}

/// A jog that its own panel has not stopped has ended for good, whatever of it is still under way.
void CommandDesk::replace_jog(const command_t& command, std::size_t axis, Clock::time_point now) {
  if (!is_jog(command.action) && !calms(command.action)) return;
  Jog& jog = jogs_[axis];
  if (is_jog(jog.action) && jog.sender != command.sender)
    if (const auto known = senders_.find(jog.sender); known != senders_.end())
      known->second.ended.insert(axis);
  jog = {};
  if (is_jog(command.action))
    jog = {command.sender, command.action, now + kHold};
  else if (const auto known = senders_.find(command.sender); known != senders_.end())
    known->second.ended.erase(axis);
}

void CommandDesk::leave(std::int64_t sender, Clock::time_point now) {
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    if (holder(axis, now) != sender) continue;
    jogs_[axis] = {};
    command_t stop{};
    stop.action = command_t::STOP;
    carry_out(stop, axis);
  }
}

std::int64_t CommandDesk::holder(std::size_t axis, Clock::time_point now) const noexcept {
  const Jog& jog = jogs_[axis];
  return is_jog(jog.action) && now < jog.until ? jog.sender : 0;
}

CommandDesk::Verdict CommandDesk::refuse(const Refusal& refusal, const command_t* command,
                                         Clock::time_point now) {
  ++(counters_.*refusal.count);
  if (watch_) watch_({command, refusal.count, refusal.reason, "", ""});
  return {false, refusal.reason, told_.take(now, kMaximumTold)};
}

std::optional<CommandDesk::Refusal> CommandDesk::judge(const command_t& command, Clock::time_point now,
                                                       CommandRoute route) {
  if (auto refusal = judge_sender(command, now)) return refusal;
  if (action_text(command.action).empty())
    return Refusal{&CommandCounters::not_valid,
                   "action " + std::to_string(command.action) + " is unknown; allowed: 0 to 8"};
  const std::optional<std::size_t> axis = find(command.axis, route);
  if (!axis)
    return Refusal{&CommandCounters::not_valid,
                   "no axis of this name takes " +
                       std::string(route == CommandRoute::lcm ? "commands" : "commands of the studio") +
                       " in this project"};
  if (auto refusal = judge_program(command, *axis)) return refusal;
  if (auto refusal = judge_value(command, *axis)) return refusal;
  const bool powers = command.action == command_t::ENABLE || command.action == command_t::DISABLE;
  if (powers && !axes_[*axis].enabled_by.empty())
    return Refusal{&CommandCounters::impossible,
                   "a program enables and disables this axis, by its instance " + axes_[*axis].enabled_by};
  return is_jog(command.action) ? judge_jog(command, *axis, now, route) : std::nullopt;
}

/// One panel jogs at a time. A page says stop when its button is let go; what comes of a held one behind a
/// silence, or behind the stop of somebody else, has hung under way or is not known to its operator. A panel
/// on LCM may have no key that is let go, as a terminal has none: there each command counts by itself.
std::optional<CommandDesk::Refusal> CommandDesk::judge_jog(const command_t& command, std::size_t axis,
                                                           Clock::time_point now, CommandRoute route) const {
  const Jog& jog = jogs_[axis];
  const bool is_own = jog.sender == command.sender;
  if (!is_own && now < jog.until)
    return Refusal{&CommandCounters::impossible, "another panel is jogging this axis"};
  if (route == CommandRoute::lcm) return std::nullopt;
  if (is_own && is_jog(jog.action) && now >= jog.until)
    return Refusal{&CommandCounters::impossible,
                   std::to_string(kHold.count()) +
                       " ms of silence have ended this motion; let the button go, and press it anew"};
  const auto known = senders_.find(command.sender);
  if (known != senders_.end() && known->second.ended.contains(axis))
    return Refusal{&CommandCounters::impossible,
                   "somebody else has stopped this motion; let the button go, and press it anew"};
  return std::nullopt;
}

/// Whether it is meant for this run, of this moment and new. So a log that is played or a message that hung
/// under way moves nothing. What stops or disables is carried out whatever its sequence: anybody can forge a
/// high one in the name of a panel, and that must not take its stop away.
std::optional<CommandDesk::Refusal> CommandDesk::judge_sender(const command_t& command,
                                                              Clock::time_point now) {
  if (command.run != run_) return Refusal{&CommandCounters::stale, "meant for another run"};
  if (command.beat > beat_ || command.beat < beat_ - kOldestBeat)
    return Refusal{&CommandCounters::stale,
                   "too old: beat " + std::to_string(command.beat) + " of " + std::to_string(beat_)};
  const auto known = senders_.find(command.sender);
  const bool behind = known != senders_.end() && command.sequence <= known->second.sequence;
  if (behind && !calms(command.action))
    return Refusal{&CommandCounters::stale, "repeated, or overtaken by a later one"};
  if (known == senders_.end() && senders_.size() >= kMaximumSenders)
    // What a forgotten one has sent is too old by then.
    std::erase_if(senders_, [&](const auto& sender) { return now - sender.second.last > 2s; });
  const bool capacity = known != senders_.end() || senders_.size() < kMaximumSenders;
  if (!capacity && !calms(command.action))
    return Refusal{&CommandCounters::too_many,
                   "too many panels; allowed: " + std::to_string(kMaximumSenders)};
  if (capacity && !behind) {
    Sender& sender = senders_[command.sender];
    sender.sequence = command.sequence;
    sender.last = now;
  }
  if (!commands_.take(now, kMaximumPerSecond) && !calms(command.action))
    return Refusal{&CommandCounters::too_many,
                   "too many commands; allowed: " + std::to_string(kMaximumPerSecond) + " in a second"};
  return std::nullopt;
}

/// What an axis takes and what a device with programs does.
std::optional<CommandDesk::Refusal> CommandDesk::judge_program(const command_t& command,
                                                               std::size_t axis) const {
  const bool starts = command.action == command_t::START_PROGRAM;
  if (!axes_[axis].has_programs) {
    if (!starts) return std::nullopt;
    return Refusal{&CommandCounters::not_valid, "a " + axes_[axis].type + " has no programs"};
  }
  if (!starts && command.action != command_t::STOP && command.action != command_t::RESET)
    return Refusal{&CommandCounters::not_valid,
                   "its program moves a " + axes_[axis].type + "; allowed: stop, reset, start program"};
  if (starts && !(command.value >= -1.0 && command.value <= kHighestProgram &&
                  command.value == std::floor(command.value)))
    return Refusal{&CommandCounters::not_valid,
                   "program " + number_text(command.value) +
                       " is not permitted; allowed: whole numbers from 0 to 127, "
                       "-1 for the one that starts by itself"};
  return std::nullopt;
}

std::optional<CommandDesk::Refusal> CommandDesk::judge_value(const command_t& command,
                                                             std::size_t axis) const {
  const auto outside = [&](const std::string& what, const std::string& allowed) {
    return Refusal{&CommandCounters::not_valid,
                   what + " " + number_text(command.value) + " is not permitted; allowed: " + allowed};
  };
  if (command.action == command_t::HOME && !axes_[axis].has_position)
    return Refusal{
        &CommandCounters::not_valid,
        "a " + axes_[axis].type +
            " has no position that could be set; allowed: enable, disable, stop, jog, reset, override"};
  const double highest = axes_[axis].jog_velocity;
  if (is_jog(command.action) && !(command.value > 0.0 && command.value <= highest))
    return outside("velocity", "above 0, up to " + number_text(highest));
  if (command.action == command_t::HOME && !(std::abs(command.value) <= kFarthest))
    return outside("position", "from -1e12 to 1e12");
  if (command.action == command_t::OVERRIDE && !(command.value >= 0.0 && command.value <= kHighestSpeed))
    return outside("override", "from 0 to 200");
  return std::nullopt;
}

/// What is accepted, with the value that it changes.
void CommandDesk::tell_watch(const command_t& command, std::size_t axis) const {
  Judged judged{&command, &CommandCounters::accepted, "", "", ""};
  const auto change = [&](PanelSignal before, Value now, Type type) {
    judged.before = audit_value(value(axis, before), type);
    judged.after = audit_value(now, type);
  };
  const bool enables = command.action == command_t::ENABLE;
  if (enables || command.action == command_t::DISABLE)
    change(PanelSignal::kEnable, Value{.u = enables ? 1u : 0u}, Type::BOOL);
  if (is_jog(command.action)) change(PanelSignal::kVelocity, Value{.r = command.value}, Type::LREAL);
  if (command.action == command_t::HOME)
    change(PanelSignal::kPosition, Value{.r = command.value}, Type::LREAL);
  if (command.action == command_t::OVERRIDE)
    change(PanelSignal::kSpeed, Value{.r = command.value}, Type::LREAL);
  if (command.action == command_t::START_PROGRAM)
    change(PanelSignal::kProgram, Value{.r = command.value}, Type::LREAL);
  watch_(judged);
}

/// What belongs together enters the cycle in one tick.
void CommandDesk::carry_out(const command_t& command, std::size_t axis) {
  std::vector<SignalWrite> batch;
  const auto write = [&](PanelSignal signal, Value value) {
    batch.push_back(
        {static_cast<std::uint32_t>(axis * kPanelSignals + static_cast<std::size_t>(signal)), value, ~0ULL});
  };
  const auto flag = [&](PanelSignal signal, bool on) { write(signal, Value{.u = on ? 1u : 0u}); };
  const auto number = [&](PanelSignal signal, double real) { write(signal, Value{.r = real}); };
  const auto ask = [&](PanelSignal signal) {
    write(signal, Value{.u = ++requests_[axis * kPanelSignals + static_cast<std::size_t>(signal)]});
  };
  const bool jog = is_jog(command.action);
  if (jog || calms(command.action)) {
    flag(PanelSignal::kForward, command.action == command_t::JOG_FORWARD);
    flag(PanelSignal::kBackward, command.action == command_t::JOG_BACKWARD);
  }
  if (jog) {
    number(PanelSignal::kJogVelocity, command.value);
    ask(PanelSignal::kBeat);
  }
  if (command.action == command_t::ENABLE || command.action == command_t::DISABLE)
    flag(PanelSignal::kEnable, command.action == command_t::ENABLE);
  if (command.action == command_t::HOME) {
    number(PanelSignal::kHomePosition, command.value);
    ask(PanelSignal::kHomings);
  }
  if (command.action == command_t::RESET) ask(PanelSignal::kResets);
  if (command.action == command_t::OVERRIDE) {
    number(PanelSignal::kOverride, command.value);
    ask(PanelSignal::kOverrides);
  }
  if (axes_[axis].has_programs && command.action == command_t::STOP) ask(PanelSignal::kStops);
  if (command.action == command_t::START_PROGRAM) {
    number(PanelSignal::kProgram, command.value);
    ask(PanelSignal::kStarts);
  }
  image_.post(batch);
}

panel_t CommandDesk::panel(std::size_t axis) const {
  panel_t panel{};
  panel.run = run_;
  panel.beat = beat_;
  panel.status_word = static_cast<std::int64_t>(value(axis, PanelSignal::kStatusWord).u);
  panel.alarm = static_cast<std::int32_t>(value(axis, PanelSignal::kAlarm).u);
  panel.enables = axes_[axis].enabled_by.empty() ? 1 : 0;
  panel.position = value(axis, PanelSignal::kPosition).r;
  panel.velocity = value(axis, PanelSignal::kVelocity).r;
  panel.speed = value(axis, PanelSignal::kSpeed).r;
  panel.jog_velocity = axes_[axis].jog_velocity;
  panel.axis = axes_[axis].name;
  panel.type = axes_[axis].type;
  panel.velocity_unit = axes_[axis].velocity_unit;
  panel.has_position = axes_[axis].has_position ? 1 : 0;
  return panel;
}

}  // namespace lockstep
