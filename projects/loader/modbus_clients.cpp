// The Modbus clients of a project: foreign devices, and the tags that go to and fro.
#include <algorithm>
#include <set>
#include <utility>

#include "projects/json/addresses.hpp"
#include "projects/keys/modbus.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/loader/modbus.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr int kHighestUnit = 247;
constexpr int kTcpUnit = 255;

/// What devices fill, by address and bit; of a text, the text.
using Filled = std::set<std::pair<const void*, int>>;

/// Reads one client.
class ClientLoader {
 public:
  ClientLoader(ModbusClientConfig& client, const Loading& loading, Filled& filled)
      : client_(client), loading_(loading), problems_(loading.problems), filled_(filled) {}

  void load(const JsonValue& json);

 private:
  void load_device(const JsonValue& json);
  int read_unit(const JsonValue* json);
  std::vector<ModbusEntry> load_entries(const JsonValue* json, bool is_write, ModbusDevice& device);
  void load_entry(const JsonValue& json, ModbusLineState& state, std::vector<ModbusEntry>& entries);
  std::optional<std::uint32_t> load_tag(const JsonValue* json, Type type);
  std::uint32_t add_signal(std::string_view path, const Operand& place);
  void note_filled(const JsonValue& at, const ModbusSource& source);
  void note_filled(const JsonValue& at, const void* address, int bit);

  ModbusClientConfig& client_;
  const Loading& loading_;
  Problems& problems_;
  Filled& filled_;
};

void ClientLoader::load(const JsonValue& json) {
  const Fields fields(json, keys::kClient, problems_);
  if (!fields.usable()) return;
  ModbusClientOptions& options = client_.options;
  if ((fields["connect"] == nullptr) == (fields["serial"] == nullptr))
    problems_.report(json, "a client has one connection; allowed: one of the keys 'connect', 'serial'");
  options.connect = read_endpoint(fields["connect"], problems_);
  if (options.connect && options.connect->port == 0)
    problems_.report(*fields["connect"], "nobody can be reached at port 0; allowed: from 1 to 65535");
  read_keys(fields, keys::kClient, options, loading_);
  if (const JsonValue* const serial = fields["serial"])
    report_taken_line(*serial, loading_.project.modbus, options.serial.device, problems_);
  if (read_array(fields["devices"], problems_) == nullptr) return;
  for (const JsonValue* const device : fields["devices"]->elements) load_device(*device);
}

int ClientLoader::read_unit(const JsonValue* json) {
  Key key = keys::kDevice["unit"];
  const bool is_tcp = client_.options.connect.has_value();
  if (!is_tcp) key.range = {1, kHighestUnit};
  const auto unit = read_value(json, key, loading_);
  if (unit && unit->integer > kHighestUnit && unit->integer != kTcpUnit)
    problems_.report(*json, json->shown() + " is no unit id; allowed: from 0 to 247, 255");
  return unit ? static_cast<int>(unit->integer) : 1;
}

void ClientLoader::load_device(const JsonValue& json) {
  ModbusDevice device;
  const Fields fields = read_struct(json, keys::kDevice, device, loading_);
  if (!fields.usable()) return;
  device.unit = read_unit(fields["unit"]);
  device.quality = load_tag(fields["quality"], Type::BOOL);
  device.age = load_tag(fields["age"], Type::TIME);
  device.reads = load_entries(fields["read"], false, device);
  device.writes = load_entries(fields["write"], true, device);
  client_.options.devices.push_back(std::move(device));
}

std::uint32_t ClientLoader::add_signal(std::string_view path, const Operand& place) {
  client_.signals.push_back({std::string(path), place.signal, place.unit});
  return static_cast<std::uint32_t>(client_.signals.size() - 1);
}

/// A tag of a given type that the client writes.
std::optional<std::uint32_t> ClientLoader::load_tag(const JsonValue* json, Type type) {
  const auto path = read_string(json, problems_);
  if (!path) return std::nullopt;
  const auto place = loading_.find(*json, *path);
  if (!place) return std::nullopt;
  if ((place->tag == nullptr && place->array == nullptr) || place->signal.value_type() != type) {
    problems_.report(*json, quote(*path) + " is no tag of type " + std::string(type_name(type)) +
                                "; allowed: the name of one");
    return std::nullopt;
  }
  note_filled(*json, place->signal.address, place->signal.bit);
  return add_signal(*path, *place);
}

/// A quality that two devices share shows the last of them only.
void ClientLoader::note_filled(const JsonValue& at, const void* address, int bit) {
  if (!filled_.emplace(address, bit).second)
    problems_.warn(at, at.shown() + " is filled from several places; the last one counts");
}

void ClientLoader::note_filled(const JsonValue& at, const ModbusSource& source) {
  if (!source.elements) return note_filled(at, source.place.signal.address, source.place.signal.bit);
  const ElementPath& elements = *source.elements;
  bool is_new = true;
  for (std::int64_t index = elements.first; index <= elements.last; ++index) {
    const Signal signal = elements.signal_of(index);
    is_new &= filled_.emplace(signal.address, signal.bit).second;
  }
  if (!is_new) problems_.warn(at, at.shown() + " is filled from several places; the last one counts");
}

void ClientLoader::load_entry(const JsonValue& json, ModbusLineState& state,
                              std::vector<ModbusEntry>& entries) {
  const Fields fields(json, keys::kDeviceEntry, problems_);
  if (!fields.usable()) return;
  const bool is_write = state.is_write;
  const std::size_t before = problems_.count();
  const auto path = read_string(fields["tag"], problems_);
  const StringTag* const text = path ? loading_.names().find_string(*path) : nullptr;
  const auto source =
      path && text == nullptr ? find_modbus_source(*fields["tag"], *path, loading_) : std::nullopt;
  auto entry = text != nullptr ? read_modbus_text(fields, loading_)
                               : read_modbus_shape(
                                     fields, source ? std::optional(source->type()) : std::nullopt, loading_);
  if ((!source && text == nullptr) || !entry) return;
  if (source && !is_write) {
    if (const std::string reason = why_not_writable(source->place); !reason.empty())
      problems_.report(*fields["tag"], reason);
    else
      expect_writes(source->place);
    entry->range = written_range(source->place);
  }
  if (is_write && !is_writable_table(entry->table))
    problems_.report(*fields["table"],
                     fields["table"]->shown() + " cannot be written; allowed: coil, holding_register");
  state.quality = load_tag(fields["quality"], Type::BOOL);
  state.age = load_tag(fields["age"], Type::TIME);
  if (problems_.count() != before) return;
  if (text != nullptr && !is_write) note_filled(*fields["tag"], text, -1);
  if (text == nullptr && !is_write) note_filled(*fields["tag"], *source);
  if (text != nullptr)
    add_modbus_text(*entry, *text, fields, problems_, entries, client_.signals);
  else
    add_modbus_entries(*entry, *source, *path, fields, problems_, entries, client_.signals);
}

/// Entries that are good by themselves and together: the rules are those of a map.
std::vector<ModbusEntry> ClientLoader::load_entries(const JsonValue* json, bool is_write,
                                                    ModbusDevice& device) {
  if (read_array(json, problems_) == nullptr) return {};
  std::vector<ModbusEntry> entries;
  std::vector<const JsonValue*> places;
  for (std::uint32_t line = 0; line < json->elements.size(); ++line) {
    ModbusLineState state{.is_write = is_write, .line = line, .quality = {}, .age = {}};
    load_entry(*json->elements[line], state, entries);
    if (entries.size() > places.size() && (state.quality || state.age)) device.lines.push_back(state);
    for (std::size_t i = places.size(); i < entries.size(); ++i) entries[i].line = line;
    places.resize(entries.size(), json->elements[line]);
  }
  std::vector<Type> types;
  for (const NamedSignal& signal : client_.signals) types.push_back(signal.signal.value_type());
  report_modbus_problems(ModbusMap(entries, types), places, problems_);
  return entries;
}

}  // namespace

void load_modbus_clients(const JsonValue* clients, const Loading& loading) {
  if (read_array(clients, loading.problems) == nullptr) return;
  Filled filled;
  for (const JsonValue* const client : clients->elements)
    ClientLoader(loading.project.modbus.clients.emplace_back(), loading, filled).load(*client);
}

}  // namespace lockstep
