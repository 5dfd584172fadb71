#include "tech_objects/axis/velocity_unit.hpp"

#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep {

std::string_view velocity_unit_text(const Axis& axis) noexcept {
  if (axis.has_position()) return unit_text(Unit::kVelocity);
  const VariableAddress place = find_variable(axis.kind, "Units.VelocityUnit");
  if (place.variable == nullptr) return "";
  for (const Choice& choice : place.variable->choices)
    if (choice.value == axis.data.Units.VelocityUnit) return choice.text;
  return "";
}

}  // namespace lockstep
