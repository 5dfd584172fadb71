#include "tech_objects/axis/coupling_chain.hpp"

#include "tech_objects/axis/axis_parts.hpp"

namespace lockstep {
namespace {

/// Longest chain of leading axes that is followed; a project cannot have more axes.
constexpr int kLongestChain = 65536;

}  // namespace

bool led_by(const LeadingObject& first, const LeadingObject* leading) noexcept {
  for (int i = 0; leading != nullptr && i < kLongestChain; ++i) {
    if (leading == &first) return true;
    if (!among(leading->kind, kAnyAxis)) return false;
    leading = static_cast<const AxisParts*>(leading)->coupled_to();
  }
  return false;
}

const LeadingValue* find_leading_value(const std::vector<LeadingValue>& leading_values,
                                       const LeadingObject* leading) noexcept {
  for (const LeadingValue& value : leading_values)
    if (value.source == leading) return &value;
  return nullptr;
}

}  // namespace lockstep
