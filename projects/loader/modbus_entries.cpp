// Entries of Modbus maps and devices: their shape, what may be written to them, and their signals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "projects/keys/modbus.hpp"
#include "projects/loader/modbus.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kAddresses = 65536;
constexpr std::size_t kMaximumSignals = 100'000;  // of arrays, so that no file takes the machine down

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

void read_modbus_limits(const Fields& fields, ModbusEntry& entry, Type signal, const Loading& loading) {
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

}  // namespace lockstep
