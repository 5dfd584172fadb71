// What crosses to the outside: the trace.
#include <algorithm>
#include <unordered_set>

#include "hmi_bridge/lcm/commands.hpp"
#include "hmi_bridge/lcm/messages.hpp"
#include "hmi_bridge/lcm/url.hpp"
#include "projects/json/addresses.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

void load_lcm(const JsonValue& json, TraceConfig& trace, Problems& problems) {
  const Fields fields(json, keys::kLcm, problems);
  if (const auto url = read_form(fields["url"], kLcmUrlForm, problems)) trace.url = *url;
  if (const auto channel = read_title(fields["channel"], problems, keys::kChannel.longest))
    trace.channel = *channel;
}

void load_signals(const JsonValue& json, std::vector<NamedSignal>& signals, const Loading& loading) {
  if (read_array(&json, loading.problems) == nullptr) return;
  std::unordered_set<std::string> seen;
  for (const JsonValue* const element : json.elements) {
    const auto path = read_string(element, loading.problems);
    if (!path) continue;
    const auto place = loading.find(*element, *path);
    if (!place) continue;
    if (!seen.insert(fold(*path)).second) {
      loading.problems.report(*element, element->shown() + " is there twice; each signal is allowed once");
      continue;
    }
    signals.push_back({std::string(*path), place->signal, place->unit, place->object, place->instance});
  }
}

/// The signal of a trigger whose other keys have been read.
void load_occasion(const JsonValue& json, TraceChannelConfig& channel, const Loading& loading) {
  Problems& problems = loading.problems;
  const TraceSelection& selection = channel.selection;
  if (selection.trigger == TriggerKind::none) return;  // which is reported
  const JsonValue* const signal = json.find("signal");
  if (selection.trigger == TriggerKind::alarm) {
    for (const JsonValue* const other : {signal, json.find("level")})
      if (other != nullptr)
        problems.report(*other,
                        "an alarm has no signal and no level; allowed with: above, below, rising, falling");
    return;
  }
  if (signal == nullptr) {
    problems.report(json, "'signal' is missing; it is required with: above, below, rising, falling");
    return;
  }
  const auto path = read_string(signal, problems);
  const auto place = path ? loading.find(*signal, *path) : std::nullopt;
  if (!place) return;
  const Type type = place->signal.value_type();
  if (type == Type::AXIS || type == Type::TAG)
    return problems.report(*signal, signal->shown() + " has no value to look at");
  channel.occasion =
      NamedSignal{std::string(*path), place->signal, place->unit, place->object, place->instance};
}

/// Headers, events, commands and panels go out beside a channel, under names made of its own.
bool is_beside(std::string_view name, std::string_view channel) {
  if (!name.starts_with(channel)) return false;
  name.remove_prefix(channel.size());
  return name == kHeaderSuffix || name == kEventsSuffix || name == kDetailSuffix || name == kCommandSuffix ||
         name == kPanelSuffix;
}

/// @param other a channel that is there already
void report_same_channel(const JsonValue& at, std::string_view name, std::string_view other,
                         Problems& problems) {
  if (name == other)
    problems.report(at, at.shown() + " is there twice; each channel is allowed once");
  else if (is_beside(name, other) || is_beside(other, name))
    problems.report(at, at.shown() + " and " + quote(other) +
                            " collide: beside a channel there are others with its name and " +
                            std::string(kHeaderSuffix) + ", " + std::string(kEventsSuffix) + ", " +
                            std::string(kDetailSuffix) + ", " + std::string(kCommandSuffix) + ", " +
                            std::string(kPanelSuffix) + "; allowed: another name");
}

void load_channel(const JsonValue& json, TraceConfig& trace, const Loading& loading) {
  Problems& problems = loading.problems;
  TraceChannelConfig& channel = trace.channels.emplace_back();
  const Fields fields = read_struct(json, keys::kTraceChannel, channel.selection, loading);
  if (const auto name = read_title(fields["channel"], problems, keys::kChannel.longest)) {
    const JsonValue& at = *fields["channel"];
    if (!trace.channel.empty()) report_same_channel(at, *name, trace.channel, problems);
    for (const TraceChannelConfig& other : trace.channels)
      if (!other.channel.empty()) report_same_channel(at, *name, other.channel, problems);
    channel.channel = *name;
  }
  if (const JsonValue* const signals = fields["signals"]) load_signals(*signals, channel.signals, loading);
  if (const JsonValue* const trigger = fields["trigger"]) load_occasion(*trigger, channel, loading);
}

/// Whatever may change: tags, pins, and what the runtime computes of the objects.
std::vector<NamedSignal> all_signals(const Loading& loading) {
  std::vector<NamedSignal> all;
  const auto add = [&](const std::string& name) {
    const FoundOperand found = loading.names().find(name);
    if (!found.place) return;
    const Type type = found.place->signal.value_type();
    if (type != Type::AXIS && type != Type::TAG)
      all.push_back(
          {name, found.place->signal, found.place->unit, found.place->object, found.place->instance});
  };
  for (const Tag& tag : loading.controller().tags) add(tag.name);
  for (const Instance& instance : loading.controller().instances)
    for (const Pin& pin : instance.type->pins) add(instance.name + "." + std::string(pin.name));
  for (const auto& object : loading.controller().objects)
    for (const Variable& variable : data_block_of(object->kind).status)
      for (std::size_t i = 0; i < std::max<std::size_t>(variable.count, 1); ++i) {
        std::string path(variable.path);
        if (const auto open = path.find("[]"); open != path.npos)
          path.replace(open, 2, "[" + std::to_string(i + 1) + "]");
        if (!variable.later) add(object->name + "." + path);
      }
  return all;
}

}  // namespace

void load_trace(const JsonValue& trace, const Loading& loading) {
  const Fields fields(trace, keys::kTrace, loading.problems);
  TraceConfig& config = loading.project.trace;
  if (const JsonValue* const lcm = fields["lcm"]) {
    load_lcm(*lcm, config, loading.problems);
    if (const JsonValue* const commands = lcm->find("commands")) {
      load_commands(*commands, CommandRoute::lcm, loading);
      if (lcm_leaves_machine(config.url)) loading.problems.warn(*commands, std::string(kLcmCommandsWarning));
    }
  }
  if (const JsonValue* const signals = fields["signals"]) load_signals(*signals, config.signals, loading);
  const JsonValue* const channels = fields["channels"];
  if (read_array(channels, loading.problems) == nullptr) return;
  for (const JsonValue* const channel : channels->elements) load_channel(*channel, config, loading);
}

void load_flight_recorder(const JsonValue& json, const Loading& loading) {
  Problems& problems = loading.problems;
  FlightRecorderConfig config;
  const Fields fields = read_struct(json, keys::kFlightRecorder, config.options, loading);
  if (const std::string_view file = config.options.file; !file.empty()) {
    const std::string_view name = file.substr(file.find_last_of('/') + 1);  // npos + 1 is 0
    if (name.empty() || name == "." || name == "..")
      problems.report(*fields["file"],
                      fields["file"]->shown() + " is a folder; allowed: how the names of files in it begin");
  }
  if (const JsonValue* const signals = fields["signals"])
    load_signals(*signals, config.signals, loading);
  else
    config.signals = all_signals(loading);
  constexpr std::int64_t kMaximumValues = std::int64_t{1} << 26;  // 512 MiB
  const std::int64_t rows = config.options.before / loading.controller().clock.interpolator_cycle();
  const auto columns = static_cast<std::int64_t>(config.signals.size());
  if (const JsonValue* const before = fields["before"];
      before != nullptr && columns > 0 && rows > kMaximumValues / columns)
    problems.report(*before, std::to_string(columns) + " signals for " + before->shown() +
                                 " take more than 512 MiB; allowed: a shorter time or fewer 'signals'");
  loading.project.flight_recorder = std::move(config);
}

}  // namespace lockstep
