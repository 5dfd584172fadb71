#include "hmi_bridge/traces/columns.hpp"

#include <algorithm>

#include "scheduler/units.hpp"

namespace lockstep {

std::string unit_of(const NamedSignal& signal) {
  if (signal.object != nullptr) return unit_of(signal.unit, *signal.object);
  if (signal.instance != nullptr) return unit_of(signal.unit, *signal.instance);
  return std::string(unit_text(signal.unit));
}

std::vector<Signal> places_of(const std::vector<NamedSignal>& signals) {
  std::vector<Signal> places;
  for (const NamedSignal& named : signals) places.push_back(named.signal);
  return places;
}

std::size_t TraceColumns::of(const NamedSignal& signal) {
  const auto same = [&](const NamedSignal& other) { return other.name == signal.name; };
  const auto found = std::find_if(columns_.begin(), columns_.end(), same);
  if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
  columns_.push_back(signal);
  return columns_.size() - 1;
}

std::vector<std::size_t> TraceColumns::of(const std::vector<NamedSignal>& signals) {
  std::vector<std::size_t> columns;
  for (const NamedSignal& signal : signals) columns.push_back(of(signal));
  return columns;
}

std::vector<TraceSignal> TraceColumns::described() const {
  std::vector<TraceSignal> signals;
  for (const NamedSignal& column : columns_)
    signals.push_back({column.name, column.signal.value_type(), unit_of(column)});
  return signals;
}

}  // namespace lockstep
