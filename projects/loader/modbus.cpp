// The Modbus servers of a project: their maps.
#include "projects/loader/modbus.hpp"

#include <algorithm>
#include <variant>

#include "projects/keys/modbus.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

/// A number of the run that a map may show, besides the counters of the server.
struct CycleDiagnostic {
  std::string_view name;
  std::uint64_t CycleCounters::*counter;
};
constexpr CycleDiagnostic kCycleDiagnostics[] = {{"ticks", &CycleCounters::ticks},
                                                 {"missed_ticks", &CycleCounters::missed_ticks},
                                                 {"overruns", &CycleCounters::overruns},
                                                 {"alarms", &CycleCounters::alarms}};

/// A part of the alarm that has come last.
struct AlarmDiagnostic {
  std::string_view name;
  std::variant<std::uint64_t NewestAlarm::*, std::int64_t NewestAlarm::*, double NewestAlarm::*> part;
  Type type;
};
constexpr AlarmDiagnostic kAlarmDiagnostics[] = {{"alarm_count", &NewestAlarm::count, Type::ULINT},
                                                 {"alarm_number", &NewestAlarm::number, Type::ULINT},
                                                 {"alarm_object", &NewestAlarm::object, Type::ULINT},
                                                 {"alarm_cause", &NewestAlarm::cause, Type::ULINT},
                                                 {"alarm_address", &NewestAlarm::address, Type::ULINT},
                                                 {"alarm_tick", &NewestAlarm::tick, Type::ULINT},
                                                 {"alarm_time", &NewestAlarm::time, Type::TIME},
                                                 {"alarm_clock", &NewestAlarm::clock, Type::LINT},
                                                 {"alarm_value", &NewestAlarm::value, Type::LREAL},
                                                 {"alarm_limit", &NewestAlarm::limit, Type::LREAL}};
constexpr std::size_t kCycleDiagnosticCount = std::size(kCycleDiagnostics) + std::size(kAlarmDiagnostics);

/// Reads maps, and tells at its place what they say of their entries.
class MapLoader {
 public:
  explicit MapLoader(const Loading& loading)
      : modbus_(loading.project.modbus), loading_(loading), problems_(loading.problems) {}

  /// The map, and what stands beside it; an empty one where there is none.
  void load(const Fields& fields, std::optional<std::size_t> server, std::optional<std::uint8_t> unit);
  /// The maps of unit ids.
  void load_units(const JsonValue* units, std::optional<std::size_t> server);
  /// Makes the maps, when all signals are known.
  void finish();

 private:
  struct Draft {
    std::optional<std::size_t> server;
    std::optional<std::uint8_t> unit;
    std::vector<ModbusEntry> entries;
    std::vector<const JsonValue*> places;  // of the entries in the file
    std::vector<ModbusArray> arrays;
    std::vector<ModbusText> texts;
    const JsonValue* watchdog;
    bool is_whole = true;  // nothing in it is faulty
    bool gaps_are_zero = false;
  };

  void load_line(const JsonValue& json, std::uint32_t line, Draft& draft);
  void load_entry(const Fields& fields, std::uint32_t line, Draft& draft);
  void load_tag(const Fields& fields, std::uint32_t line, Draft& draft);
  void load_text(const Fields& fields, const StringTag& tag, std::uint32_t line, Draft& draft);
  Signal cycle_diagnostic(std::size_t number) const;
  std::optional<ModbusEntry> load_diagnostic(const JsonValue& json, const Fields& fields);
  bool read_access(const JsonValue* json, const Operand& place, ModbusTable table);

  ModbusConfig& modbus_;
  const Loading& loading_;
  Problems& problems_;
  std::vector<Draft> drafts_;
};

void MapLoader::load(const Fields& fields, std::optional<std::size_t> server,
                     std::optional<std::uint8_t> unit) {
  const JsonValue* const map = fields["map"];
  Draft& draft = drafts_.emplace_back(Draft{server, unit, {}, {}, {}, {}, fields["watchdog"]});
  const auto gaps = read_value(fields["gaps"], keys::kGapsKey, loading_);
  draft.gaps_are_zero = gaps && gaps->integer == 1;
  const std::size_t before = problems_.count();
  if (read_array(map, problems_) != nullptr)
    for (std::uint32_t line = 0; line < map->elements.size(); ++line)
      load_line(*map->elements[line], line, draft);
  draft.is_whole = problems_.count() == before;
}

void MapLoader::load_units(const JsonValue* units, std::optional<std::size_t> server) {
  if (read_array(units, problems_) == nullptr) return;
  std::vector<std::int64_t> seen;
  for (const JsonValue* const json : units->elements) {
    const Fields fields(*json, keys::kUnit, problems_);
    if (!fields.usable()) continue;
    const auto read = read_value(fields, keys::kUnit["unit"], loading_);
    const std::int64_t unit = read ? read->integer : 0;
    if (read && std::find(seen.begin(), seen.end(), unit) != seen.end())
      problems_.report(*fields["unit"],
                       "unit " + std::to_string(unit) + " is there twice; each unit id is allowed once");
    if (read) seen.push_back(unit);
    load(fields, server, static_cast<std::uint8_t>(unit));
  }
}

void MapLoader::finish() {
  std::vector<Type> types;
  for (const NamedSignal& signal : modbus_.signals) types.push_back(signal.signal.value_type());
  for (Draft& draft : drafts_) {
    ModbusMapConfig& made = modbus_.maps.emplace_back(ModbusMapConfig{draft.server,
                                                                      draft.unit,
                                                                      {std::move(draft.entries), types},
                                                                      std::move(draft.arrays),
                                                                      std::move(draft.texts)});
    if (draft.gaps_are_zero) made.map.read_gaps_as_zero();
    report_modbus_problems(made.map, draft.places, problems_);
    if (draft.watchdog != nullptr)
      load_watchdogs(*draft.watchdog, draft.is_whole ? &made.map : nullptr, loading_);
  }
}

/// Whether a client may write: tags where the table allows it, a variable only if the entry asks for it.
bool MapLoader::read_access(const JsonValue* json, const Operand& place, ModbusTable table) {
  const auto access = read_value(json, keys::kMapEntry["access"], loading_);
  const bool tag = place.tag != nullptr || place.array != nullptr;
  if (!access) return tag && is_writable_table(table);
  if (access->integer == 0) return false;
  const std::string reason = why_not_writable(place);
  if (!reason.empty()) problems_.report(*json, reason);
  if (reason.empty()) expect_writes(place);
  return reason.empty();
}

/// Where a number of the run stands; no address: it is one of the server.
Signal MapLoader::cycle_diagnostic(std::size_t number) const {
  Controller& controller = loading_.controller();
  if (number < std::size(kCycleDiagnostics)) return controller.counter(kCycleDiagnostics[number].counter);
  if (number >= kCycleDiagnosticCount) return {nullptr, Type::ULINT, -1};
  const auto& [name, part, type] = kAlarmDiagnostics[number - std::size(kCycleDiagnostics)];
  return std::visit([&, wire = type](auto member) { return controller.newest_alarm(member, wire); }, part);
}

/// A number of the run or of the server.
std::optional<ModbusEntry> MapLoader::load_diagnostic(const JsonValue& json, const Fields& fields) {
  std::vector<std::string_view> names;
  for (const CycleDiagnostic& one : kCycleDiagnostics) names.push_back(one.name);
  for (const AlarmDiagnostic& one : kAlarmDiagnostics) names.push_back(one.name);
  for (const ModbusCounterName& one : kModbusCounters) names.push_back(one.name);
  const auto word = read_word(&json, names, problems_);
  const auto access = read_value(fields, keys::kMapEntry["access"], loading_);
  if (access && access->integer == 1)
    problems_.report(*fields["access"], "a diagnostic cannot be written; allowed: read");
  for (const char* const key : {"min", "max"})
    if (fields[key] != nullptr)
      problems_.report(*fields[key], "a diagnostic cannot be written and has no '" + std::string(key) + "'");
  if (!word) return std::nullopt;
  const Signal shown = cycle_diagnostic(*word);
  auto entry = read_modbus_shape(fields, shown.type, loading_);
  if (!entry) return std::nullopt;
  if (shown.address == nullptr) {
    entry->counter = kModbusCounters[*word - kCycleDiagnosticCount].counter;
    return entry;
  }
  entry->signal = static_cast<std::uint32_t>(modbus_.signals.size());
  modbus_.signals.push_back({"diagnostic." + std::string(names[*word]), shown, Unit::kNone});
  return entry;
}

void MapLoader::load_tag(const Fields& fields, std::uint32_t line, Draft& draft) {
  const std::size_t before = problems_.count();
  const JsonValue& tag = *fields["tag"];
  const auto path = read_string(&tag, problems_);
  if (const StringTag* const text = path ? loading_.names().find_string(*path) : nullptr)
    return load_text(fields, *text, line, draft);
  const auto source = path ? find_modbus_source(tag, *path, loading_) : std::nullopt;
  auto entry = read_modbus_shape(fields, source ? std::optional(source->type()) : std::nullopt, loading_);
  if (!source || !entry) return;
  entry->writable = read_access(fields["access"], source->place, entry->table);
  entry->range = written_range(source->place);
  entry->line = line;
  if (problems_.count() != before) return;
  read_modbus_limits(fields, *entry, source->type(), loading_);
  if (problems_.count() != before) return;
  if (source->elements) draft.arrays.push_back({*source->elements, draft.entries.size()});
  add_modbus_entries(*entry, *source, *path, fields, problems_, draft.entries, modbus_.signals);
}

void MapLoader::load_text(const Fields& fields, const StringTag& tag, std::uint32_t line, Draft& draft) {
  auto entry = read_modbus_text(fields, loading_);
  const auto access = read_value(fields, keys::kMapEntry["access"], loading_);
  if (!entry) return;
  entry->writable = access ? access->integer == 1 : is_writable_table(entry->table);
  entry->line = line;
  const std::size_t first = draft.entries.size();
  if (add_modbus_text(*entry, tag, fields, problems_, draft.entries, modbus_.signals) > 0)
    draft.texts.push_back({&tag, first});
}

void MapLoader::load_entry(const Fields& fields, std::uint32_t line, Draft& draft) {
  const JsonValue* const tag = fields["tag"];
  const JsonValue* const diagnostic = fields["diagnostic"];
  if (fields["object"] != nullptr || fields["content"] != nullptr)
    return add_device_content(fields, line, loading_, draft.entries, modbus_.signals);
  if (fields["table"] == nullptr) problems_.report(fields.value(), "the key 'table' is missing");
  if (tag != nullptr && diagnostic != nullptr)
    problems_.report(*diagnostic, "an entry shows a tag or a diagnostic; allowed: one of the two keys");
  if (tag == nullptr && diagnostic == nullptr)
    problems_.report(fields.value(),
                     "the key 'tag' is missing, or 'diagnostic' or 'object' with 'content' in its place");
  if (tag != nullptr && diagnostic == nullptr) return load_tag(fields, line, draft);
  if (tag != nullptr || diagnostic == nullptr) return;
  const std::size_t before = problems_.count();
  auto entry = load_diagnostic(*diagnostic, fields);
  if (!entry || problems_.count() != before) return;
  entry->line = line;
  draft.entries.push_back(*entry);
}

void MapLoader::load_line(const JsonValue& json, std::uint32_t line, Draft& draft) {
  const Fields fields(json, keys::kMapEntry, problems_);
  if (!fields.usable()) return;
  load_entry(fields, line, draft);
  draft.places.resize(draft.entries.size(), &json);
}

void load_server(const JsonValue& json, const Loading& loading, MapLoader& maps) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kServer, problems);
  if (!fields.usable()) return;
  std::vector<ModbusServerOptions>& servers = loading.project.modbus.servers;
  const std::size_t index = servers.size();
  servers.emplace_back();
  if (fields["map"] != nullptr) maps.load(fields, index, std::nullopt);
  if (fields["map"] == nullptr && fields["watchdog"] != nullptr)
    problems.report(*fields["watchdog"],
                    "this server has no map of its own; allowed: a watchdog beside the 'map' that has its "
                    "heartbeat");
  if (fields["map"] == nullptr && fields["gaps"] != nullptr)
    problems.report(*fields["gaps"], "this server has no map of its own; allowed: gaps beside its 'map'");
  maps.load_units(fields["units"], index);
  load_modbus_place(json, fields, loading);
}

void load_servers(const JsonValue& json, const Loading& loading, MapLoader& maps) {
  if (json.kind == JsonKind::object) {
    load_server(json, loading, maps);
  } else if (json.kind == JsonKind::array) {
    for (const JsonValue* const server : json.elements) load_server(*server, loading, maps);
  } else {
    report_kind(json, "an object, or an array of them", loading.problems);
  }
}

}  // namespace

void report_modbus_problems(const ModbusMap& map, std::span<const JsonValue* const> places,
                            Problems& problems) {
  const JsonValue* told = nullptr;
  for (const ModbusMapProblem& problem : map.problems()) {
    const JsonValue& entry = *places[problem.entry];
    const JsonValue* const field = entry.find(problem.key);
    const JsonValue& place = field == nullptr ? entry : *field;
    if (told == &place) continue;  // of the elements of an array the first one
    told = &place;
    problems.report(place, problem.text);
  }
}

std::vector<const ModbusMapConfig*> ModbusConfig::maps_of(std::optional<std::size_t> server) const {
  const auto is_own = [&](const ModbusMapConfig& map) { return map.server == server; };
  if (std::none_of(maps.begin(), maps.end(), is_own)) server.reset();
  std::vector<const ModbusMapConfig*> found;
  for (const ModbusMapConfig& map : maps)
    if (is_own(map)) found.push_back(&map);
  return found;
}

ModbusUnits ModbusConfig::units_of(std::size_t server) const {
  static const ModbusMap kEmpty({}, {});
  ModbusUnits units(kEmpty);
  for (const ModbusMapConfig* map : maps_of(server)) {
    if (map->unit)
      units.own[*map->unit] = &map->map;
    else
      units.every = &map->map;
  }
  return units;
}

NamedSignal ModbusConfig::signal_of(const ModbusEntry& entry) const {
  if (entry.counter == nullptr) return signals[entry.signal];
  for (const ModbusCounterName& one : kModbusCounters)
    if (one.counter == entry.counter) return {"diagnostic." + std::string(one.name), {}, Unit::kNone};
  return {};
}

void load_modbus(const JsonValue* modbus, const Loading& loading) {
  MapLoader maps(loading);
  JsonValue none;
  none.kind = JsonKind::object;
  const Fields fields(modbus == nullptr ? none : *modbus, modbus == nullptr ? Keys{} : keys::kModbus,
                      loading.problems);
  maps.load(fields, std::nullopt, std::nullopt);
  maps.load_units(fields["units"], std::nullopt);
  if (fields["server"] != nullptr) load_servers(*fields["server"], loading, maps);
  maps.finish();
  load_modbus_clients(fields["clients"], loading);
}

}  // namespace lockstep
