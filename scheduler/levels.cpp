#include "scheduler/levels.hpp"

#include <algorithm>

namespace lockstep {
namespace {

std::size_t number_of(const Axis* axis) noexcept {
  return static_cast<std::uint32_t>(axis->number);
}

}  // namespace

void Levels::reserve(std::size_t axes, std::uint32_t highest_number) {
  axes_.resize(axes);
  begins_.resize(axes + 2);
  levels_.resize(std::size_t{highest_number} + 1);
}

void Levels::rebuild(std::span<Axis* const> order) noexcept {
  std::fill(begins_.begin(), begins_.end(), 0u);
  std::uint32_t lowest = 0;  // that is permitted
  std::uint32_t end = 0;     // one above the highest so far
  for (const Axis* axis : order) {
    const Axis* leading = axis->coupled_leading_axis();
    const bool alone = axis->awaited_leading_axis() != nullptr;
    std::uint32_t level = alone ? end : lowest;
    if (leading != nullptr && !alone) level = std::max(level, levels_[number_of(leading)] + 1);
    levels_[number_of(axis)] = level;
    end = std::max(end, level + 1);
    if (alone) lowest = end;
    ++begins_[level + 1];
  }
  count_ = end;
  for (std::size_t level = 0; level < count_; ++level) begins_[level + 1] += begins_[level];
  // Each level is filled from its begin, which then is the begin of the next; afterwards they are moved back.
  for (Axis* axis : order) axes_[begins_[levels_[number_of(axis)]]++] = axis;
  for (std::size_t level = count_; level > 0; --level) begins_[level] = begins_[level - 1];
  begins_[0] = 0;
}

}  // namespace lockstep
