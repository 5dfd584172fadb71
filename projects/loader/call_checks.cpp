#include "projects/loader/call_checks.hpp"

#include <algorithm>

namespace lockstep {

void CallChecks::add(const JsonValue& in, const Instance& instance,
                     std::span<const std::pair<const Pin*, const JsonValue*>> constants) {
  const BlockChecks* const checks = checks_of(*instance.type);
  if (checks == nullptr) return;
  WrittenCall call{instance.type, instance.block.get(), {}};
  for (const auto& [name, json] : in.members) {
    const Pin* const pin = instance.type->find_pin(name);
    if (pin == nullptr || pin->name != name) continue;
    const bool by_name = pin->type == Type::AXIS || pin->type == Type::ARRAY;
    const bool constant = std::any_of(constants.begin(), constants.end(),
                                      [&](const auto& known) { return known.first == pin; });
    call.inputs.push_back({pin->name, by_name || constant, json->shown()});
  }
  Calls& known = calls_[checks];
  known.inputs.push_back(&in);
  known.calls.push_back(std::move(call));
  if (checks->one == nullptr) return;
  CallWarnings warnings;
  checks->one(known.calls.back(), warnings);
  tell(warnings, std::span(known.inputs).last(1));
}

void CallChecks::look_at_all() const {
  for (const BlockChecks& checks : block_checks()) {
    const auto found = calls_.find(&checks);
    if (checks.all == nullptr || found == calls_.end()) continue;
    CallWarnings warnings;
    checks.all(found->second.calls, warnings);
    tell(warnings, found->second.inputs);
  }
}

void CallChecks::tell(const CallWarnings& warnings, std::span<const JsonValue* const> inputs) const {
  for (const CallWarning& warning : warnings)
    problems_.warn(*inputs[warning.call]->find(warning.pin), warning.text);
}

}  // namespace lockstep
