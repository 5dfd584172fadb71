#include "scheduler/aposs/frame.hpp"

#include <algorithm>

namespace lockstep::aposs {

int Arrays::fit(std::span<const ArrayDeclaration> wanted) {
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (i < count_) {
      if (extents_[i].size != wanted[i].size) return 170;
      continue;
    }
    const std::size_t first = i == 0 ? 0 : extents_[i - 1].first + extents_[i - 1].size;
    if (wanted[i].size == 0 || wanted[i].size > kMaximumCells - first) return 175;
    extents_.resize(i);
    extents_.push_back({static_cast<std::uint32_t>(first), wanted[i].size});
    const std::size_t end = first + wanted[i].size;
    if (cells_.size() < end) cells_.resize(end);
    std::fill(cells_.begin() + static_cast<std::ptrdiff_t>(first),
              cells_.begin() + static_cast<std::ptrdiff_t>(end), 0);
    count_ = i + 1;
  }
  return 0;
}

void Arrays::reserve(std::span<const ArrayDeclaration> wanted) {
  std::size_t cells = 0;
  for (const ArrayDeclaration& one : wanted) cells += one.size;
  extents_.reserve(wanted.size());
  if (cells <= kMaximumCells && cells_.size() < cells) cells_.resize(cells);
}

bool Stack::call(std::uint16_t from) noexcept {
  if (calls_count_ == calls_.size()) return false;
  calls_[calls_count_++] = {from, static_cast<std::uint8_t>(loops_count_)};
  return true;
}

bool Stack::leave(std::uint16_t& to) noexcept {
  if (calls_count_ == 0) return false;
  loops_count_ = loops_of_caller();
  to = calls_[--calls_count_].instruction;
  return true;
}

bool Stack::forget(bool all) noexcept {
  if (calls_count_ == 0) return false;
  calls_count_ = all ? 0 : calls_count_ - 1;
  loops_count_ = calls_[calls_count_].loops;
  return true;
}

Stack::Turn Stack::turn(std::uint16_t instruction, std::int32_t count) noexcept {
  const std::size_t base = loops_of_caller();
  std::size_t at = loops_count_;
  while (at > base && loops_[at - 1].instruction != instruction) --at;
  if (at > base) {
    loops_count_ = at;  // loops within this one have been left by GOTO
  } else {
    if (count <= 0) return Turn::kOver;
    if (loops_count_ - base == kMaximumLoops) return Turn::kTooDeep;
    loops_[loops_count_++] = {instruction, count};
  }
  Loop& loop = loops_[loops_count_ - 1];
  if (loop.remaining == 0) {
    --loops_count_;
    return Turn::kOver;
  }
  --loop.remaining;
  return Turn::kAgain;
}

}  // namespace lockstep::aposs
