#include "projects/studio/trigger.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lockstep {
namespace {

constexpr std::array<std::pair<std::string_view, StudioTriggerKind>, 10> kTriggerKinds{{
    {"above", StudioTriggerKind::above},
    {"below", StudioTriggerKind::below},
    {"rising", StudioTriggerKind::rising},
    {"falling", StudioTriggerKind::falling},
    {"change", StudioTriggerKind::change},
    {"outside", StudioTriggerKind::outside},
    {"window", StudioTriggerKind::outside},
    {"bits", StudioTriggerKind::bits},
    {"alarm", StudioTriggerKind::alarm},
    {"job", StudioTriggerKind::job},
}};

}  // namespace

std::optional<StudioTriggerKind> studio_trigger_kind(std::string_view name) noexcept {
  const auto* const found = std::find_if(kTriggerKinds.begin(), kTriggerKinds.end(),
                                         [name](const auto& one) { return one.first == name; });
  if (found == kTriggerKinds.end()) return {};
  return found->second;
}

std::string_view studio_trigger_kinds() noexcept {
  return "above, below, rising, falling, change, outside, window, bits, alarm, job";
}

bool StudioTrigger::judge(Value given, Type type) noexcept {
  const double value = as_double(given, type);
  if (std::isnan(value)) return false;
  const auto crossed = [this](bool is_beyond, bool is_back) {
    if (is_back) is_ready_ = true;
    return is_beyond && std::exchange(is_ready_, is_ready_ && !is_beyond);
  };
  const std::optional<Value> before = std::exchange(before_, given);
  switch (condition_.kind) {
    case StudioTriggerKind::above:
      return value > condition_.level;
    case StudioTriggerKind::below:
      return value < condition_.level;
    case StudioTriggerKind::rising:
      return crossed(value > condition_.level, value <= condition_.level - condition_.hysteresis);
    case StudioTriggerKind::falling:
      return crossed(value < condition_.level, value >= condition_.level + condition_.hysteresis);
    case StudioTriggerKind::change:
      // Whole numbers beyond 2^53 differ where their nearest real numbers do not.
      return before && (is_real(type) ? before->r != given.r : before->u != given.u);
    case StudioTriggerKind::bits:
      return (given.u & condition_.mask) == condition_.wanted;
    case StudioTriggerKind::outside:
      return value < condition_.level || value > condition_.upper;
    default:
      return false;
  }
}

}  // namespace lockstep
