#include "cli/monitor/history.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::cli {

void History::add(std::int64_t t, double value) {
  const std::int64_t number = t / kSlot;
  if (t < 0) return;
  if (number < last_) slots_.clear();
  if (slots_.empty()) slots_.resize(kSlots);
  last_ = number;
  if (!std::isfinite(value)) return;
  Slot& slot = slots_[static_cast<std::size_t>(number) % kSlots];
  if (slot.number != number) slot = {number, {value, value}};
  slot.span.minimum = std::min(slot.span.minimum, value);
  slot.span.maximum = std::max(slot.span.maximum, value);
}

std::vector<std::optional<History::Span>> History::parts(std::int64_t window, std::size_t count) const {
  std::vector<std::optional<Span>> parts(count);
  const auto slots = std::min<std::int64_t>(window / kSlot, kSlots);
  if (slots_.empty() || slots <= 0 || count == 0) return parts;
  for (std::int64_t number = std::max<std::int64_t>(last_ - slots + 1, 0); number <= last_; ++number) {
    const Slot& slot = slots_[static_cast<std::size_t>(number) % kSlots];
    if (slot.number != number) continue;
    const std::int64_t age = last_ - number;  // in slots; the newest stands in the last part
    const auto back = static_cast<std::size_t>(age) * count / static_cast<std::size_t>(slots);
    auto& part = parts[count - 1 - back];
    if (!part) part = slot.span;
    part->minimum = std::min(part->minimum, slot.span.minimum);
    part->maximum = std::max(part->maximum, slot.span.maximum);
  }
  return parts;
}

std::optional<History::Span> History::whole(std::int64_t window) const {
  return parts(window, 1).front();
}

}  // namespace lockstep::cli
