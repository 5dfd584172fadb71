#include "fb/block.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

bool same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

bool Pin::allows(const Block& block) const noexcept {
  const Value value = signal(const_cast<Block&>(block)).load();
  if (type == Type::AXIS) return value.u != 0;
  if (type == Type::ARRAY) return true;
  const double number = as_double(value, type);
  if (is_real(type) && !std::isfinite(number)) return false;
  if (relevant != nullptr && !relevant(block)) return true;
  if (!range.allows(number)) return false;
  if (choices.empty()) return true;
  return std::any_of(choices.begin(), choices.end(),
                     [&](const Choice& choice) { return static_cast<double>(choice.value) == number; });
}

ErrorId first_error(std::span<const Pin> pins, const Block& block) noexcept {
  for (const Pin& pin : pins)
    if (pin.error != ErrorId::none && !pin.allows(block)) return pin.error;
  return ErrorId::none;
}

const Pin* BlockType::find_pin(std::string_view pin_name) const noexcept {
  for (const Pin& pin : pins)
    if (same_name(pin.name, pin_name)) return &pin;
  return nullptr;
}

const BlockType* find_block_type(std::string_view name) noexcept {
  for (const BlockType& type : block_types())
    if (same_name(type.name, name)) return &type;
  return nullptr;
}

}  // namespace lockstep
