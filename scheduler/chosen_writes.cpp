#include "scheduler/chosen_writes.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {
namespace {

void apply_text(ChosenWrite& write) noexcept {
  const std::string_view before = write.text.view();
  const std::size_t size = std::min(before.size(), write.old_text.size());
  std::copy_n(before.begin(), size, write.old_text.begin());
  write.text.assign(write.new_text);
}

void apply_value(ChosenWrite& write) noexcept {
  write.before = write.signal.load();
  Value value = write.value;
  if (write.mask != ~0ULL) value.u = (write.before.u & ~write.mask) | (value.u & write.mask);
  write.signal.store(value);
}

}  // namespace

bool ChosenWrites::post(std::vector<ChosenWrite> batch) {
  if (!is_applied() || batch.size() > kMaximum) return false;
  batch_ = std::move(batch);
  for (ChosenWrite& write : batch_)
    if (write.text.characters != nullptr) write.old_text.assign(write.text.capacity, '\0');
  handed_over_.store(handed_over_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  return true;
}

void ChosenWrites::apply_batch(std::int64_t tick) noexcept {
  for (ChosenWrite& write : batch_) {
    if (write.text.characters != nullptr)
      apply_text(write);
    else
      apply_value(write);
  }
  tick_ = tick;
  ++number_;
  applied_.store(number_, std::memory_order_release);
}

}  // namespace lockstep
