// What is done when a Modbus client falls silent.
#include "scheduler/watchdog.hpp"

#include <algorithm>

#include "projects/keys/modbus.hpp"
#include "projects/loader/modbus.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

/// Whether two places are one, or one is a bit of the other.
bool is_same(const Signal& a, const Signal& b) {
  return a.address == b.address && (a.bit == b.bit || a.bit < 0 || b.bit < 0);
}

/// Whether a client can write the variable of a signal over a map.
bool can_be_written(const ModbusMap& map, const Signal& signal, const ModbusConfig& modbus) {
  return std::any_of(map.entries().begin(), map.entries().end(), [&](const ModbusEntry& entry) {
    return entry.writable && entry.counter == nullptr &&
           modbus.signals[entry.signal].signal.address == signal.address;
  });
}

/// A tag that is one value, or none: then that is reported.
std::optional<Signal> find_tag(const JsonValue* json, const Loading& loading) {
  const auto path = read_string(json, loading.problems);
  const auto place = path ? loading.find(*json, *path) : std::nullopt;
  if (!place) return std::nullopt;
  if (place->tag != nullptr || place->array != nullptr) return place->signal;
  loading.problems.report(*json, json->shown() + " is no tag; allowed: a tag that is one value");
  return std::nullopt;
}

std::optional<Signal> find_heartbeat(const JsonValue* json, const ModbusMap* map, const Loading& loading) {
  const auto heartbeat = find_tag(json, loading);
  if (!heartbeat || map == nullptr || can_be_written(*map, *heartbeat, loading.project.modbus))
    return heartbeat;
  loading.problems.report(*json, json->shown() +
                                     " cannot be written by a client of this map, so that nothing "
                                     "would be a sign of life; allowed: a tag that the map "
                                     "has among its coils or holding registers");
  return std::nullopt;
}

std::optional<Signal> find_status(const JsonValue* json, const Loading& loading) {
  const auto status = json == nullptr ? std::nullopt : find_tag(json, loading);
  if (!status || status->value_type() == Type::BOOL) return status;
  loading.problems.report(*json, json->shown() + " is no BOOL; allowed: a tag of type BOOL");
  return std::nullopt;
}

/// What watchdogs have in their hands has one use, but for a heartbeat, at which several may look: two would
/// write against each other.
void claim(const JsonValue& json, const WatchdogTag& wanted, const Loading& loading) {
  constexpr std::string_view kUses[] = {"is the heartbeat of a watchdog", "is the status of a watchdog",
                                        "is set by a watchdog already"};
  std::vector<WatchdogTag>& tags = loading.project.modbus.watchdog_tags;
  for (const WatchdogTag& tag : tags) {
    const bool both_look = tag.role == WatchdogTag::Role::heartbeat && wanted.role == tag.role;
    if (both_look || !is_same(tag.signal, wanted.signal)) continue;
    loading.problems.report(json, json.shown() + ": this tag " +
                                      std::string(kUses[static_cast<std::size_t>(tag.role)]) +
                                      "; allowed: a tag of its own");
    return;
  }
  tags.push_back(wanted);
}

void claim_set(const JsonValue& set, const Loading& loading) {
  for (const auto& [path, value] : set.members) {
    if (const StringTag* const string = loading.names().find_string(path))
      claim(*value,
            {Signal{const_cast<char*>(string->memory.data()), Type::BYTE, -1}, WatchdogTag::Role::set},
            loading);
    else if (const auto place = loading.find(*value, path))
      claim(*value, {place->signal, WatchdogTag::Role::set}, loading);
  }
}

/// A silence cannot be shorter than the time after which it is looked for.
std::optional<KeyValue> read_timeout(const Fields& fields, const Loading& loading) {
  Key key = keys::kWatchdog["timeout"];
  key.range.lowest = static_cast<double>(loading.controller().clock.servo_cycle);
  return read_value(fields, key, loading);
}

void load_watchdog(const JsonValue& json, const ModbusMap* map, const Loading& loading) {
  Problems& problems = loading.problems;
  const std::size_t before = problems.count();
  const Fields fields(json, keys::kWatchdog, problems);
  if (!fields.usable()) return;
  const auto heartbeat = find_heartbeat(fields["tag"], map, loading);
  const std::int64_t cycle = loading.controller().clock.servo_cycle;
  const auto timeout = read_timeout(fields, loading);
  const auto status = find_status(fields["status"], loading);
  const JsonValue* const set = fields["set"];
  std::vector<Assignment> values;
  if (set != nullptr) values = read_assignments(set, "a watchdog", loading);
  if (!heartbeat || !timeout || problems.count() != before) return;
  if (fields["status"] == nullptr && (set == nullptr || set->members.empty()))
    return problems.report(json,
                           "a silence would have no effect; allowed: 'set' with tags and their values, "
                           "'status' with a BOOL tag, or both");
  claim(*fields["tag"], {*heartbeat, WatchdogTag::Role::heartbeat}, loading);
  if (status) claim(*fields["status"], {*status, WatchdogTag::Role::status}, loading);
  if (set != nullptr) claim_set(*set, loading);
  if (problems.count() != before) return;
  loading.controller().watchdogs.emplace_back(*heartbeat, (timeout->integer + cycle - 1) / cycle,
                                              std::move(values), status);
}

}  // namespace

void load_watchdogs(const JsonValue& json, const ModbusMap* map, const Loading& loading) {
  if (json.kind == JsonKind::object) {
    load_watchdog(json, map, loading);
  } else if (json.kind == JsonKind::array) {
    for (const JsonValue* const one : json.elements) load_watchdog(*one, map, loading);
  } else {
    report_kind(json, "an object, or an array of them", loading.problems);
  }
}

}  // namespace lockstep
