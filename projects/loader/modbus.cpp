// The Modbus servers of a project: their maps.
#include "projects/loader/modbus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "projects/keys/modbus.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kAddresses = 65536;
constexpr std::size_t kMaximumSignals = 100'000;  // of arrays, so that no file takes the machine down

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

/// What a client may write besides what signal and registers hold.
void read_limits(const Fields& fields, ModbusEntry& entry, Type signal, const Loading& loading);

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
  read_limits(fields, *entry, source->type(), loading_);
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

/// What the registers of an entry can bring to its signal.
Range reachable_range(const ModbusEntry& entry, Type signal) {
  constexpr double kReal = std::numeric_limits<float>::max();
  if (is_real(signal) && !entry.is_scaled)
    return signal == Type::REAL || entry.type == Type::REAL ? Range{-kReal, kReal} : kAny;
  const Type wire = entry.type == Type::TIME ? Type::DINT : entry.type;
  const auto low = static_cast<double>(lowest(wire));
  const auto high = static_cast<double>(highest(wire));
  if (entry.type == Type::TIME) return {low * 1e-3, high * 1e-3};
  if (signal == Type::TIME) return {low * 1e-9, high * 1e-9};
  if (!entry.is_scaled)
    return {std::max(low, static_cast<double>(lowest(signal))),
            std::min(high, static_cast<double>(highest(signal)))};
  const auto [minimum, maximum] =
      std::minmax({low * entry.scale + entry.offset, high * entry.scale + entry.offset});
  return {minimum, maximum};
}

void read_limits(const Fields& fields, ModbusEntry& entry, Type signal, const Loading& loading) {
  Problems& problems = loading.problems;
  const Range reachable = reachable_range(entry, signal);
  const Range possible{std::max(reachable.lowest, entry.range.lowest),
                       std::min(reachable.highest, entry.range.highest)};
  // A scaled value is rounded; one that is written as the limit has to be allowed.
  const double rounding = entry.is_scaled ? 1e-6 * std::abs(entry.scale) : 0.0;
  const auto read = [&](const Key& key, double& bound, double slack) {
    const JsonValue* const json = fields[key.name];
    const auto value = read_value(json, key, loading);
    if (!value) return;
    const std::string name(key.name);
    if (!entry.writable)
      problems.report(*json, "no client may write this entry, so that it has no '" + name +
                                 R"('; allowed with: "access": "write", tags in holding registers)");
    else if (signal == Type::BOOL || is_bit_string(signal))
      problems.report(*json, "a value of type " + std::string(type_name(signal)) + " has no '" + name +
                                 "'; allowed: integers, REAL, LREAL, TIME");
    else if (!(value->number >= possible.lowest && value->number <= possible.highest))
      problems.report(*json, json->shown() + " can never be written here; allowed: " +
                                 fmt::format("{:.10g}", possible.lowest) + " to " +
                                 fmt::format("{:.10g}", possible.highest));
    else
      bound = value->number + slack;
  };
  double minimum = entry.range.lowest, maximum = entry.range.highest;
  read(keys::kMapEntry["min"], minimum, -rounding);
  read(keys::kMapEntry["max"], maximum, rounding);
  if (minimum > maximum)
    problems.report(*fields["min"], "min is above max; allowed: up to " + fmt::format("{:.10g}", maximum));
  entry.range.lowest = minimum;
  entry.range.highest = maximum;
}

/// The type on the wire: the one that is given, or the usual one of the signal.
Type read_type(const JsonValue* json, Type signal, bool is_scaled, Problems& problems) {
  constexpr Type kScaled[] = {Type::SINT,  Type::INT,  Type::DINT,  Type::LINT,
                              Type::USINT, Type::UINT, Type::UDINT, Type::ULINT};
  const auto types = is_scaled ? std::span<const Type>(kScaled) : modbus_types(signal);
  const Type usual = types.empty() ? signal : types.front();
  const auto text = read_string(json, problems);
  if (!text) return usual;
  if (const auto given = tag_type(*text)) return *given;
  std::vector<std::string_view> names;
  for (const Type allowed : types) names.push_back(type_name(allowed));
  problems.report(
      *json, "unknown type " + quote(*text) + did_you_mean(*text, names) + "; allowed: " + list_of(names));
  return usual;
}

/// value = integer · scale + offset
void read_scale(const Fields& fields, ModbusEntry& entry, Problems& problems) {
  entry.is_scaled = fields["scale"] != nullptr || fields["offset"] != nullptr;
  if (!entry.is_scaled) return;
  if (fields["type"] == nullptr)
    problems.report(fields.value(),
                    "the key 'type' is missing: a scaled value needs the integer that it has on "
                    "the wire, such as INT");
  if (!(std::abs(entry.scale) >= std::numeric_limits<double>::min()))
    problems.report(*fields["scale"], "a scale of 0 makes all values the same; allowed: any other number");
}

}  // namespace

Range written_range(const Operand& place) {
  if (place.variable == nullptr || place.signal.bit >= 0) return kAny;
  const Variable& variable = *place.variable;
  Range range = variable.range;
  if (variable.choices.empty() || variable.type == Type::BOOL) return range;
  const auto [minimum, maximum] =
      std::minmax_element(variable.choices.begin(), variable.choices.end(),
                          [](const Choice& a, const Choice& b) { return a.value < b.value; });
  range.lowest = std::max(range.lowest, static_cast<double>(minimum->value));
  range.highest = std::min(range.highest, static_cast<double>(maximum->value));
  return range;
}

std::optional<ModbusEntry> read_modbus_shape(const Fields& fields, std::optional<Type> signal,
                                             const Loading& loading) {
  Problems& problems = loading.problems;
  const std::size_t before = problems.count();
  ModbusEntry entry;
  read_keys(fields, keys::kEntryShape, entry, loading);
  read_scale(fields, entry, problems);
  if (!signal || fields["table"] == nullptr || fields["address"] == nullptr) return std::nullopt;
  entry.type = read_type(fields["type"], *signal, entry.is_scaled, problems);
  if (problems.count() != before) return std::nullopt;
  return entry;
}

std::optional<ModbusSource> find_modbus_source(const JsonValue& at, std::string_view path,
                                               const Loading& loading) {
  FoundElements found = find_several(loading.names(), path);
  if (!found.problem.empty()) {
    if (!found.known_problem) loading.problems.report(at, found.problem);
    return std::nullopt;
  }
  if (found.elements) return ModbusSource{found.elements->place, std::move(found.elements)};
  const auto place = loading.find(at, path);
  if (!place) return std::nullopt;
  return ModbusSource{*place, std::nullopt};
}

namespace {

/// Whether several elements fit behind the address of the first, and among the signals that there are.
bool has_capacity(const ModbusEntry& shape, std::size_t elements, std::uint64_t addresses,
                  std::string_view path, const Fields& fields, std::size_t signals, Problems& problems) {
  if (shape.address + addresses > kAddresses)
    problems.report(*fields["address"], std::to_string(elements) + " elements on " +
                                            std::to_string(addresses) + " addresses from " +
                                            std::to_string(shape.address) + " on go beyond 65535");
  else if (signals + elements > kMaximumSignals)
    problems.report(*fields["tag"], "with the " + std::to_string(elements) + " elements of " + quote(path) +
                                        " there are more than " + std::to_string(kMaximumSignals) +
                                        " values on Modbus; allowed are these");
  else
    return true;
  return false;
}

}  // namespace

std::size_t add_modbus_entries(const ModbusEntry& shape, const ModbusSource& source, std::string_view path,
                               const Fields& fields, Problems& problems, std::vector<ModbusEntry>& entries,
                               std::vector<NamedSignal>& signals) {
  ModbusEntry entry = shape;
  const auto add = [&](std::string name, const Signal& signal) {
    entry.signal = static_cast<std::uint32_t>(signals.size());
    entries.push_back(entry);
    signals.push_back(
        {std::move(name), signal, source.place.unit, source.place.object, source.place.instance});
  };
  if (!source.elements) {
    add(std::string(path), source.place.signal);
    return 1;
  }
  const ElementPath& elements = *source.elements;
  const bool is_bit = shape.bit >= 0;
  const std::uint64_t addresses = is_bit
                                      ? (static_cast<std::uint64_t>(shape.bit) + elements.count() + 15) / 16
                                      : elements.count() * modbus_span(shape);
  if (!has_capacity(shape, elements.count(), addresses, path, fields, signals.size(), problems)) return 0;
  for (std::int64_t index = elements.first; index <= elements.last; ++index) {
    add(elements.name_of(index), elements.signal_of(index));
    if (!is_bit) {
      entry.address += modbus_span(shape);
    } else if (++entry.bit > 15) {
      entry.bit = 0;
      ++entry.address;
    }
  }
  return elements.count();
}

std::optional<ModbusEntry> read_modbus_text(const Fields& fields, const Loading& loading) {
  Problems& problems = loading.problems;
  const std::size_t before = problems.count();
  for (const char* const key : {"type", "word_order", "bit", "scale", "offset", "min", "max"})
    if (const JsonValue* const field = fields[key])
      problems.report(*field,
                      "a text has no '" + std::string(key) + "'; allowed: table, address, byte_order");
  if (problems.count() != before) return std::nullopt;
  auto entry = read_modbus_shape(fields, Type::WORD, loading);
  if (!entry) return std::nullopt;
  if (is_bit_table(entry->table)) {
    problems.report(*fields["table"], "a text does not fit the one bit of the table " +
                                          std::string(modbus_table_name(entry->table)) +
                                          "; allowed: input_register, holding_register");
    return std::nullopt;
  }
  // In memory the first character of two is the low byte of a WORD.
  entry->byte_order = entry->byte_order == ByteOrder::big ? ByteOrder::little : ByteOrder::big;
  return entry;
}

std::size_t add_modbus_text(const ModbusEntry& shape, const StringTag& tag, const Fields& fields,
                            Problems& problems, std::vector<ModbusEntry>& entries,
                            std::vector<NamedSignal>& signals) {
  const std::vector<Signal> parts = text_signals(tag.text);
  if (!has_capacity(shape, parts.size(), parts.size(), tag.name, fields, signals.size(), problems)) return 0;
  ModbusEntry entry = shape;
  for (const Signal& part : parts) {
    entry.signal = static_cast<std::uint32_t>(signals.size());
    entry.type = part.type;
    entries.push_back(entry);
    signals.push_back({tag.name, part, Unit::kNone});
    ++entry.address;
  }
  return parts.size();
}

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
