// The names of a project's Modbus map over the network.
#include "cli/panel/modbus_panel.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_set>

#include "cli/describe/values.hpp"
#include "projects/expressions/constant.hpp"

namespace lockstep::cli {
namespace {

constexpr int kHighestUnit = 247;
constexpr int kDecimalDigits = std::numeric_limits<double>::digits10;  // that a double keeps of any number

/// A scaled value as a person writes it: 0.7, where 7 · 0.1 of a computer is 0.7000000000000001.
double as_written(double value) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, kDecimalDigits).ptr;
  std::from_chars(text, end, value);
  return value;
}

/// The unit id by which maps for every unit id are reached: the one asked for, unless it has a map of its
/// own.
int unit_of_common(const std::vector<const ModbusMapConfig*>& maps, int asked) {
  const auto is_taken = [&](int unit) {
    return std::any_of(maps.begin(), maps.end(), [&](const auto* map) { return map->unit == unit; });
  };
  if (!is_taken(asked)) return asked;
  int unit = 1;
  while (unit < kHighestUnit && is_taken(unit)) ++unit;
  return unit;
}

}  // namespace

void add_panel_options(CLI::App& command, PanelOptions& options) {
  command.add_option("ADDRESS", options.place, "HOST:PORT where the project runs")->required();
  command.add_option("--project", options.project, "the project file, whose map says where the names stand")
      ->required();
  command.add_option(
      "--server", options.server,
      "number of the server, as lockstep tags shows it, where ADDRESS is none at which it listens");
  command.add_option("--unit", options.unit, "unit id, where the map is for all of them (1)")
      ->check(CLI::Range(0, kHighestUnit));
  command.add_option("--timeout", options.timeout, "seconds to wait for an answer (2)")
      ->check(CLI::Range(0.001, 3600.0));
}

ModbusPanel::ModbusPanel(const Project& project, const PanelOptions& options, PanelTarget target)
    : project_(project),
      options_(options),
      target_(std::move(target)),
      common_unit_(unit_of_common(target_.maps, options.unit)) {
  for (const ModbusMapConfig* map : target_.maps)
    for (const ModbusEntry& entry : map->map.entries()) {
      const PanelEntry place = place_of(*map, entry);
      Places& known = places_.try_emplace(fold(place.name), Places{place, std::nullopt}).first->second;
      if (entry.writable && !known.writable) known.writable = place;
    }
}

PanelEntry ModbusPanel::place_of(const ModbusMapConfig& map, const ModbusEntry& entry) const {
  return {project_.modbus.signal_of(entry).name, map.unit ? int{*map.unit} : common_unit_, &map.map, &entry};
}

bool ModbusPanel::has_map() const {
  if (!places_.empty()) return true;
  tell(
      "the project has no Modbus map, so that no value has an address; its \"modbus\" takes one: \"map\": [ "
      "{ "
      "\"tag\": \"speed\", \"table\": \"holding_register\", \"address\": 0 } ]; lockstep describe keys "
      "modbus.map "
      "tells more");
  return false;
}

std::vector<PanelName> ModbusPanel::all() const {
  std::vector<PanelName> names;
  std::unordered_set<std::string> known;
  const auto add = [&](PanelName name) {
    if (known.insert(fold(name.name)).second) names.push_back(std::move(name));
  };
  for (const ModbusMapConfig* map : target_.maps) {
    auto array = map->arrays.begin();
    auto text = map->texts.begin();
    const auto& entries = map->map.entries();
    for (std::size_t i = 0; i < entries.size();) {
      if (text != map->texts.end() && text->first == i) {
        i += text->count();
        add(name_of(*map, *text++));
        continue;
      }
      const bool is_array = array != map->arrays.end() && array->first == i;
      const std::size_t end = i + (is_array ? array->elements.count() : 1);
      PanelName name{is_array ? array->elements.name : "", {}, is_array};
      for (; i < end; ++i) name.entries.push_back(place_of(*map, entries[i]));
      if (!is_array) name.name = name.entries.front().name;
      if (is_array) ++array;
      add(std::move(name));
    }
  }
  return names;
}

PanelName ModbusPanel::name_of(const ModbusMapConfig& map, const ModbusText& text) const {
  PanelName name{text.tag->name, {}, false, text.tag->text.capacity};
  for (std::size_t i = 0; i < text.count(); ++i)
    name.entries.push_back(place_of(map, map.map.entries()[text.first + i]));
  return name;
}

/// The first address of a text in the maps.
std::optional<PanelName> ModbusPanel::find_text(const StringTag& tag, bool to_write) const {
  for (const ModbusMapConfig* map : target_.maps)
    for (const ModbusText& text : map->texts)
      if (text.tag == &tag && (!to_write || map->map.entries()[text.first].writable))
        return name_of(*map, text);
  tell_unknown(tag.name);
  return std::nullopt;
}

std::optional<PanelEntry> ModbusPanel::place_of(const std::string& name, bool to_write) const {
  const auto known = places_.find(fold(name));
  if (known == places_.end()) return std::nullopt;
  return to_write ? known->second.writable : known->second.first;
}

bool ModbusPanel::tell_unknown(const std::string& name) const {
  if (places_.contains(fold(name))) {
    tell(quote(name) + " is read-only on Modbus");
    return false;
  }
  // An index that is out of bounds, say.
  if (const FoundOperand found = project_.names.find(name); name.find('[') != name.npos && !found.place) {
    tell("the Modbus map has no " + quote(name) + ": " + found.problem);
    return false;
  }
  std::vector<std::string> names;
  for (const PanelName& one : all()) names.push_back(one.name);
  const std::vector<std::string_view> views(names.begin(), names.end());
  tell("the Modbus map has no " + quote(name) + did_you_mean(name, views) + "; it has: " + list_of(views));
  return false;
}

std::optional<PanelName> ModbusPanel::find(const std::string& name, bool to_write) const {
  if (const StringTag* const text = project_.names.find_string(name)) return find_text(*text, to_write);
  const FoundElements found = find_several(project_.names, name);
  if (!found.problem.empty()) {
    tell(found.problem);
    return std::nullopt;
  }
  if (!found.elements) {
    const auto place = place_of(name, to_write);
    if (!place && !tell_unknown(name)) return std::nullopt;
    return PanelName{place->name, {*place}, false};
  }
  const ElementPath& elements = *found.elements;
  PanelName result{name, {}, true};
  std::optional<std::string> missing;
  for (std::int64_t index = elements.first; index <= elements.last; ++index) {
    const auto place = place_of(elements.name_of(index), to_write);
    if (place)
      result.entries.push_back(*place);
    else if (!missing)
      missing = elements.name_of(index);
  }
  const bool is_enough = elements.is_all ? !result.entries.empty() : !missing.has_value();
  if (!is_enough && !tell_unknown(*missing)) return std::nullopt;
  return result;
}

bool ModbusPanel::connect() {
  master_.emplace(target_.endpoint, std::chrono::milliseconds(static_cast<int>(options_.timeout * 1000.0)));
  if (master_->connect()) return true;
  tell(options_.place + ": " + master_->problem());
  return false;
}

bool ModbusPanel::tell_failure(const PanelEntry& place) const {
  tell(place.name + ": " + master_->problem());
  return false;
}

/// Entries for one request; of bits of a register, those of this register.
struct ModbusPanel::Block {
  std::uint32_t address;
  std::uint32_t count;
  std::size_t begin, end;  // of the entries
};

std::vector<ModbusPanel::Block> ModbusPanel::blocks_of(std::span<const PanelEntry> entries, bool to_write) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const ModbusEntry& entry = *entries[i].entry;
    const std::uint32_t span = modbus_span(entry);
    const std::uint32_t maximum = is_bit_table(entry.table)
                                      ? (to_write ? kMaximumBitsWritten : kMaximumBitsRead)
                                      : (to_write ? kMaximumRegistersWritten : kMaximumRegistersRead);
    if (i > 0 && entries[i - 1].unit == entries[i].unit && entries[i - 1].entry->table == entry.table &&
        (entries[i - 1].entry->bit >= 0) == (entry.bit >= 0)) {
      Block& block = blocks.back();
      const std::uint32_t end = block.address + block.count;
      const bool is_same = entry.bit >= 0 && entry.address + 1 == end;
      const bool is_next = entry.address == end && (entry.bit < 0 || !to_write);
      if (is_same || (is_next && block.count + span <= maximum)) {
        block.count = entry.address + span - block.address;
        block.end = i + 1;
        continue;
      }
    }
    blocks.push_back({entry.address, span, i, i + 1});
  }
  return blocks;
}

std::optional<std::vector<Value>> ModbusPanel::read(const PanelName& name) {
  std::vector<Value> values;
  std::array<std::uint16_t, kMaximumBitsRead> words{};
  for (const Block& block : blocks_of(name.entries, false)) {
    const PanelEntry& first = name.entries[block.begin];
    const auto all = std::span(words).first(block.count);
    if (!master_->read(first.unit, first.entry->table, block.address, all)) {
      tell_failure(first);
      return std::nullopt;
    }
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const ModbusEntry& entry = *name.entries[i].entry;
      const auto value =
          value_of(name.entries[i], all.subspan(entry.address - block.address, modbus_span(entry)));
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
  }
  return values;
}

std::optional<Value> ModbusPanel::value_of(const PanelEntry& place,
                                           std::span<const std::uint16_t> words) const {
  ModbusEntry shown = *place.entry;
  shown.range = kAny;  // that of writes
  if (auto value = decode(shown, place.type(), words)) {
    if (shown.is_scaled) value->r = as_written(value->r);
    return value;
  }
  if (is_real(place.type())) {  // beyond the range of REAL, or no number
    Value value{};
    value.r = std::numeric_limits<double>::quiet_NaN();
    return value;
  }
  tell(place.name + ": what came is no value of its type; is this the project that runs?");
  return std::nullopt;
}

bool ModbusPanel::write(const PanelName& name, std::span<const Value> values) {
  std::array<std::uint16_t, kMaximumBitsWritten> words{};
  for (const Block& block : blocks_of(name.entries, true)) {
    const PanelEntry& first = name.entries[block.begin];
    const auto all = std::span(words).first(block.count);
    std::fill(all.begin(), all.end(), std::uint16_t{0});
    std::uint16_t mask = 0;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const ModbusEntry& entry = *name.entries[i].entry;
      const ModbusWords own = encode(entry, name.entries[i].type(), values[i]);
      for (std::uint32_t k = 0; k < modbus_span(entry); ++k) all[entry.address - block.address + k] |= own[k];
      if (entry.bit >= 0) mask |= modbus_bit(entry);
    }
    const bool is_good = mask != 0 ? master_->write_bits(first.unit, block.address, mask, all[0])
                                   : master_->write(first.unit, first.entry->table, block.address, all);
    if (!is_good) return tell_failure(first);
  }
  return true;
}

namespace {

/// The minimum and maximum value of a signal that its registers can show.
struct Limits {
  Value lowest{}, highest{};
};

Limits limits_of(const ModbusEntry& entry, Type type) {
  const auto minimum = static_cast<double>(lowest(entry.type));
  const auto maximum = static_cast<double>(highest(entry.type));
  Limits limits;
  if (entry.is_scaled) {
    std::tie(limits.lowest.r, limits.highest.r) = std::minmax(
        {as_written(minimum * entry.scale + entry.offset), as_written(maximum * entry.scale + entry.offset)},
        [](double a, double b) { return a < b; });
  } else if (is_real(type)) {
    limits.highest.r = std::numeric_limits<float>::max();
    limits.lowest.r = -limits.highest.r;
  } else if (type == Type::TIME) {  // in 32 bits, milliseconds
    limits.lowest.i = std::numeric_limits<std::int32_t>::min() * std::int64_t{1'000'000};
    limits.highest.i = std::numeric_limits<std::int32_t>::max() * std::int64_t{1'000'000};
  } else {
    limits.lowest.i = std::max(lowest(entry.type), lowest(type));
    limits.highest.u = std::min(highest(entry.type), highest(type));
  }
  return limits;
}

bool fits_registers(const ModbusEntry& entry, Type type, Value value) {
  const ModbusWords words = encode(entry, type, value);
  ModbusEntry unlimited = entry;
  unlimited.range = kAny;
  const auto back = decode(unlimited, type, std::span(words).first(modbus_span(entry)));
  if (!back) return false;
  // Rounding is what the map says; a value that became its type's limit is another one.
  if (entry.is_scaled) return std::abs(back->r - value.r) <= std::abs(entry.scale) * 0.500001;
  if (type == Type::TIME) return std::abs(back->i - value.i) <= 500'000;
  return is_real(type) || back->u == value.u;
}

}  // namespace

std::string write_problem(const PanelEntry& place, Value value) {
  const ModbusEntry& entry = *place.entry;
  const Type type = place.type();
  if (!fits_registers(entry, type, value)) {
    const Limits limits = limits_of(entry, type);
    return place.name + ": " + literal(value, type) + " does not fit " + std::string(type_name(entry.type)) +
           " on Modbus; allowed: from " + literal(limits.lowest, type) + " to " +
           literal(limits.highest, type);
  }
  const std::string problem = range_problem(value, type, entry.range, {});
  return problem.empty() ? "" : place.name + ": " + problem;
}

}  // namespace lockstep::cli
