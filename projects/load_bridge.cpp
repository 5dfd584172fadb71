// What crosses to the outside: the Modbus map and the trace.
#include <algorithm>
#include <charconv>
#include <unordered_set>

#include "hmi_bridge/lcm_messages.hpp"
#include "projects/loader.hpp"

namespace lockstep {
namespace {

/// Reads a decimal number without sign; none if the text is something else or too large.
std::optional<std::uint32_t> number_of(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return number;
}

bool host_characters(std::string_view host) {
  return std::all_of(host.begin(), host.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
  });
}

/// The first number of an IPv4 address; none if it is no address.
std::optional<std::uint32_t> first_of_address(std::string_view address) {
  std::optional<std::uint32_t> first;
  for (int part = 0; part < 4; ++part) {
    const auto point = part < 3 ? address.find('.') : address.size();
    if (point == address.npos) return std::nullopt;
    const auto number = number_of(address.substr(0, point));
    if (!number || *number > 255) return std::nullopt;
    if (!first) first = number;
    address.remove_prefix(part < 3 ? point + 1 : point);
  }
  return first;
}

/// What a client may write to a variable: its range, which for an enumeration goes from its first to its last
/// value.
Range written_range(const Variable& variable) {
  Range range = variable.range;
  if (variable.choices.empty() || variable.type == Type::BOOL) return range;
  const auto [least, most] =
      std::minmax_element(variable.choices.begin(), variable.choices.end(),
                          [](const Choice& a, const Choice& b) { return a.value < b.value; });
  range.lowest = std::max(range.lowest, static_cast<double>(least->value));
  range.highest = std::min(range.highest, static_cast<double>(most->value));
  return range;
}

/// Reads the entries of the map, and tells at its place what the map says of them.
class MapLoader {
 public:
  MapLoader(ModbusConfig& modbus, const Loading& loading)
      : modbus_(modbus), loading_(loading), problems_(loading.problems) {}

  void load(const JsonValue& map);

 private:
  void load_entry(const JsonValue& json);
  Type read_type(const JsonValue* json, const Place& place);
  bool read_access(const JsonValue* json, const Place& place, ModbusTable table);

  ModbusConfig& modbus_;
  const Loading& loading_;
  Problems& problems_;
  std::vector<ModbusEntry> entries_;
  std::vector<Type> types_;
  std::vector<const JsonValue*> places_;  // of the entries in the file
};

void MapLoader::load(const JsonValue& map) {
  if (read_array(&map, problems_) != nullptr)
    for (const JsonValue* const entry : map.elements) load_entry(*entry);
  modbus_.map.emplace(std::move(entries_), types_);
  for (const ModbusMapProblem& problem : modbus_.map->problems()) {
    const JsonValue& entry = *places_[problem.entry];
    const JsonValue* const field = entry.find(problem.key);
    problems_.report(field == nullptr ? entry : *field, problem.text);
  }
}

/// The type on the wire: the one that is given, or the usual one of the signal.
Type MapLoader::read_type(const JsonValue* json, const Place& place) {
  const Type type = place.signal.value_type();
  const auto types = modbus_types(type);
  const Type usual = types.empty() ? type : types.front();
  const auto text = read_string(json, problems_);
  if (!text) return usual;
  if (const auto given = tag_type(*text)) return *given;
  std::vector<std::string_view> names;
  for (const Type allowed : types) names.push_back(type_name(allowed));
  problems_.report(
      *json, "unknown type " + quote(*text) + did_you_mean(*text, names) + "; allowed: " + list_of(names));
  return usual;
}

/// Whether a client may write: tags where the table allows it, a variable only if the entry asks for it.
bool MapLoader::read_access(const JsonValue* json, const Place& place, ModbusTable table) {
  const auto word = read_word(json, words::kAccesses, problems_);
  if (!word) return place.tag != nullptr && is_writable_table(table);
  if (*word == 0) return false;
  const std::string reason = why_not_writable(place);
  if (!reason.empty()) problems_.report(*json, reason);
  return reason.empty();
}

void MapLoader::load_entry(const JsonValue& json) {
  const Fields fields(json, keys::kMapEntry, problems_);
  const std::size_t before = problems_.count();
  const auto path = read_string(fields["tag"], problems_);
  const auto place = path ? loading_.find(*fields["tag"], *path) : std::nullopt;
  const auto table = read_word(fields["table"], words::kTables, problems_);
  const auto address = read_integer(fields["address"], 0, 65535, problems_);
  const auto order = read_word(fields["word_order"], words::kWordOrders, problems_);
  if (!place || !table || !address) return;
  ModbusEntry entry{.signal = static_cast<std::uint32_t>(types_.size()),
                    .table = *modbus_table(words::kTables[*table]),
                    .address = static_cast<std::uint32_t>(*address),
                    .type = read_type(fields["type"], *place),
                    .word_order = order.value_or(0) == 0 ? WordOrder::big : WordOrder::little};
  entry.writable = read_access(fields["access"], *place, entry.table);
  if (place->variable != nullptr && place->signal.bit < 0) entry.range = written_range(*place->variable);
  if (problems_.count() != before) return;
  entries_.push_back(entry);
  types_.push_back(place->signal.value_type());
  places_.push_back(&json);
  modbus_.signals.push_back({std::string(*path), place->signal, place->unit});
}

void load_server(const JsonValue& json, ModbusConfig& modbus, Problems& problems) {
  const Fields fields(json, keys::kServer, problems);
  const auto listen = read_string(fields["listen"], problems);
  if (!listen) return;
  std::string problem;
  modbus.listen = parse_endpoint(*listen, problem);
  if (!modbus.listen) problems.report(*fields["listen"], problem);
}

void load_lcm(const JsonValue& json, TraceConfig& trace, Problems& problems) {
  const Fields fields(json, keys::kLcm, problems);
  if (const auto url = read_string(fields["url"], problems)) {
    trace.url = *url;
    if (const std::string problem = lcm_url_problem(*url); !problem.empty())
      problems.report(*fields["url"], problem);
  }
  if (const auto channel = read_title(fields["channel"], problems)) {
    trace.channel = *channel;
    if (channel->size() > kLongestTraceChannel)
      problems.report(*fields["channel"], fields["channel"]->shown() + " is too long; allowed: up to " +
                                              std::to_string(kLongestTraceChannel) + " characters");
  }
}

void load_signals(const JsonValue& json, TraceConfig& trace, const Loading& loading) {
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
    trace.signals.push_back({std::string(*path), place->signal, place->unit});
  }
}

}  // namespace

std::optional<Endpoint> parse_endpoint(std::string_view text, std::string& problem) {
  const auto colon = text.rfind(':');
  const auto port = colon == text.npos ? std::nullopt : number_of(text.substr(colon + 1));
  const std::string_view host = text.substr(0, colon);
  constexpr std::size_t kLongestHost = 253;
  if (port && *port <= 65535 && !host.empty() && host.size() <= kLongestHost && host_characters(host))
    return Endpoint{std::string(host), static_cast<std::uint16_t>(*port)};
  problem = quote(text) +
            " is not HOST:PORT; allowed: an IPv4 address or a name, a colon and a port from 0 to 65535, "
            "as in 127.0.0.1:1502";
  return std::nullopt;
}

std::string lcm_url_problem(std::string_view url) {
  const std::string problem = quote(url) +
                              " is no address of an LCM network; allowed: udpm://ADDRESS:PORT?ttl=N with "
                              "a multicast address (224.0.0.0 to 239.255.255.255), memq://";
  if (url == "memq://") return "";
  constexpr std::string_view kScheme = "udpm://";
  if (!url.starts_with(kScheme)) return problem;
  url.remove_prefix(kScheme.size());
  const auto question = url.find('?');
  const std::string_view network = url.substr(0, question);
  if (question != url.npos) {
    const std::string_view option = url.substr(question + 1);
    const auto ttl = option.starts_with("ttl=") ? number_of(option.substr(4)) : std::nullopt;
    if (!ttl || *ttl > 255) return problem;
  }
  if (network.empty()) return "";
  const auto colon = network.find(':');
  if (colon != network.npos) {
    const auto port = number_of(network.substr(colon + 1));
    if (!port || *port == 0 || *port > 65535) return problem;
  }
  const auto first = first_of_address(network.substr(0, colon));
  return first && *first >= 224 && *first <= 239 ? "" : problem;
}

void load_modbus(const JsonValue* modbus, const Loading& loading) {
  ModbusConfig& config = loading.project.modbus;
  config.map.emplace(std::vector<ModbusEntry>{}, std::span<const Type>{});
  if (modbus == nullptr) return;
  const Fields fields(*modbus, keys::kModbus, loading.problems);
  if (const JsonValue* const server = fields["server"]) load_server(*server, config, loading.problems);
  if (const JsonValue* const map = fields["map"]) MapLoader(config, loading).load(*map);
}

void load_trace(const JsonValue& trace, const Loading& loading) {
  const Fields fields(trace, keys::kTrace, loading.problems);
  TraceConfig& config = loading.project.trace;
  if (const JsonValue* const lcm = fields["lcm"]) load_lcm(*lcm, config, loading.problems);
  if (const JsonValue* const signals = fields["signals"]) load_signals(*signals, config, loading);
}

}  // namespace lockstep
