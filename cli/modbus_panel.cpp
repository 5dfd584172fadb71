// The names of a project's Modbus map over the network.
#include "cli/modbus_panel.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep::cli {
void add_panel_options(CLI::App& command, PanelOptions& options) {
  command.add_option("ADDRESS", options.place, "HOST:PORT where the project runs")->required();
  command.add_option("--project", options.project, "the project file, whose map says where the names stand")
      ->required();
  command.add_option("--unit", options.unit, "unit id, where the map is for all of them (1)")
      ->check(CLI::Range(0, 247));
  command.add_option("--timeout", options.timeout, "seconds to wait for an answer (2)")
      ->check(CLI::Range(0.001, 3600.0));
}

ModbusPanel::ModbusPanel(const Project& project, const PanelOptions& options)
    : project_(project), options_(options) {}

std::vector<PanelEntry> ModbusPanel::all() const {
  std::vector<PanelEntry> places;
  for (const ModbusMapConfig& map : project_.modbus.maps)
    for (const ModbusEntry& entry : map.map.entries()) {
      PanelEntry place{project_.modbus.signal_of(entry).name, map.unit ? int{*map.unit} : options_.unit,
                       &map.map, &entry};
      if (std::none_of(places.begin(), places.end(),
                       [&](const PanelEntry& other) { return same_name(other.name, place.name); }))
        places.push_back(std::move(place));
    }
  return places;
}

std::optional<PanelEntry> ModbusPanel::find(const std::string& name, bool to_write) const {
  bool is_known = false;
  std::vector<std::string> names;
  for (const ModbusMapConfig& map : project_.modbus.maps)
    for (const ModbusEntry& entry : map.map.entries()) {
      const std::string own = project_.modbus.signal_of(entry).name;
      names.push_back(own);
      if (!same_name(own, name)) continue;
      is_known = true;
      if (entry.writable || !to_write)
        return PanelEntry{own, map.unit ? int{*map.unit} : options_.unit, &map.map, &entry};
    }
  const std::vector<std::string_view> views(names.begin(), names.end());
  tell(is_known ? quote(name) + " is read-only on Modbus"
                : "the Modbus map has no " + quote(name) + did_you_mean(name, views) +
                      "; it has: " + list_of(views));
  return std::nullopt;
}

bool ModbusPanel::connect() {
  std::string problem;
  const std::optional<Endpoint> endpoint = parse_endpoint(options_.place, problem);
  if (endpoint) {
    master_.emplace(*endpoint, std::chrono::milliseconds(static_cast<int>(options_.timeout * 1000.0)));
    if (master_->connect()) return true;
    problem = options_.place + ": " + master_->problem();
  }
  tell(problem);
  return false;
}

bool ModbusPanel::tell_failure(const PanelEntry& place) const {
  tell(place.name + ": " + master_->problem());
  return false;
}

std::optional<Value> ModbusPanel::read(const PanelEntry& place) {
  ModbusWords words{};
  const auto own = std::span(words).first(modbus_span(*place.entry));
  if (!master_->read(place.unit, place.entry->table, place.entry->address, own)) {
    tell_failure(place);
    return std::nullopt;
  }
  ModbusEntry shown = *place.entry;
  shown.range = kAny;  // that of writes
  if (const auto value = decode(shown, place.type(), own)) return value;
  if (is_real(place.type())) {  // beyond the range of REAL, or no number
    Value value{};
    value.r = std::numeric_limits<double>::quiet_NaN();
    return value;
  }
  tell(place.name + ": what came is no value of its type; is this the project that runs?");
  return std::nullopt;
}

bool ModbusPanel::write(const PanelEntry& place, Value value) {
  const ModbusEntry& entry = *place.entry;
  const ModbusWords words = encode(entry, place.type(), value);
  const bool is_good = entry.bit >= 0
                           ? master_->write_bits(place.unit, entry.address, modbus_bit(entry), words[0])
                           : master_->write(place.unit, entry.table, entry.address,
                                            std::span(words).first(modbus_span(entry)));
  return is_good || tell_failure(place);
}

std::string write_problem(const PanelEntry& place, Value value) {
  const ModbusEntry& entry = *place.entry;
  const Type type = place.type();
  const std::string wrong =
      place.name + ": the value does not fit " + std::string(type_name(entry.type)) + " on Modbus";
  const ModbusWords words = encode(entry, type, value);
  ModbusEntry unlimited = entry;
  unlimited.range = kAny;
  const auto own = std::span(words).first(modbus_span(entry));
  const auto back = decode(unlimited, type, own);
  if (!back) return wrong;
  // Rounding is what the map says; a value that became its type's limit is another one.
  if (entry.is_scaled && !(std::abs(back->r - value.r) <= std::abs(entry.scale) * 0.500001)) return wrong;
  if (type == Type::TIME && std::abs(back->i - value.i) > 500'000) return wrong;
  if (!is_real(type) && type != Type::TIME && back->u != value.u) return wrong;
  if (!decode(entry, type, own)) return place.name + ": the value is out of the range of its variable";
  return "";
}

}  // namespace lockstep::cli
