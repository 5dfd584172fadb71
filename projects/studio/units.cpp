#include "projects/studio/units.hpp"

#include "scheduler/units.hpp"

namespace lockstep {
namespace {

constexpr Unit kLastUnit = Unit::kMilliseconds;

/// Calls `found` with each unit.
template <class Found>
void each_unit(Found found) {
  for (int unit = 0; unit <= static_cast<int>(kLastUnit); ++unit) found(static_cast<Unit>(unit));
}

}  // namespace

StudioUnits::StudioUnits(const Project& project) {
  for (const auto& object : project.controller->objects)
    each_unit([&](Unit unit) { texts_[{object.get(), unit}] = unit_of(unit, *object); });
  for (const Instance& instance : project.controller->instances)
    each_unit([&](Unit unit) { texts_[{&instance, unit}] = unit_of(unit, instance); });
}

std::string StudioUnits::of(const NamedSignal& signal) const {
  const void* owner = signal.instance;
  if (signal.object != nullptr) owner = signal.object;
  const auto found = texts_.find({owner, signal.unit});
  return found != texts_.end() ? found->second : std::string(unit_text(signal.unit));
}

}  // namespace lockstep
