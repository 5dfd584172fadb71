#include "tech_objects/axis/coupling_order.hpp"

#include <algorithm>

namespace lockstep {
namespace {

enum Mark : std::uint8_t { kUnseen, kOnPath, kPlaced };

}  // namespace

void CouplingOrder::set_axes(std::span<Axis* const> axes) {
  all_.assign(axes.begin(), axes.end());
  std::uint32_t highest = 0;
  for (const Axis* axis : axes) {
    highest = std::max(highest, static_cast<std::uint32_t>(axis->number));
  }
  order_ = all_;
  path_.reserve(all_.size() + 1);
  marks_.assign(highest + 1, kUnseen);
}

std::uint8_t& CouplingOrder::mark(const Axis* axis) noexcept {
  return marks_[static_cast<std::uint32_t>(axis->number)];
}

void CouplingOrder::rebuild() noexcept {
  std::fill(marks_.begin(), marks_.end(), std::uint8_t{kUnseen});
  order_.clear();
  for (Axis* axis : all_) place(axis);
}

/// Whether the couplings above an axis lead to one that is being placed, and so can only be placed after it.
bool CouplingOrder::leads_back(Axis* axis) noexcept {
  for (std::size_t i = 0; axis != nullptr && mark(axis) != kPlaced && i < all_.size(); ++i) {
    if (mark(axis) == kOnPath) return true;
    axis = axis->coupled_leading_axis();
  }
  return false;
}

/// Depth first without recursion: an axis is placed once the axes that lead it are. A chain of couplings is
/// taken only as a whole, up to its first axis, so that an awaited axis never comes between two of them.
void CouplingOrder::place(Axis* first) noexcept {
  if (mark(first) != kUnseen) return;
  path_.clear();
  path_.push_back(first);
  mark(first) = kOnPath;
  while (!path_.empty()) {
    Axis* axis = path_.back();
    Axis* coupled = axis->coupled_leading_axis();
    Axis* awaited = axis->awaited_leading_axis();
    Axis* next = nullptr;
    if (coupled != nullptr && mark(coupled) == kUnseen) {
      next = coupled;
    } else if (awaited != nullptr && mark(awaited) == kUnseen && !leads_back(awaited)) {
      next = awaited;
    }
    if (next != nullptr) {
      mark(next) = kOnPath;
      path_.push_back(next);
      continue;
    }
    axis->awaited_axis_in_order = awaited == nullptr || mark(awaited) == kPlaced;
    mark(axis) = kPlaced;
    order_.push_back(axis);
    path_.pop_back();
  }
}

}  // namespace lockstep
