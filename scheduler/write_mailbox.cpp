#include "scheduler/write_mailbox.hpp"

#include <algorithm>
#include <bit>

#include "scheduler/come_near.hpp"

namespace lockstep {
namespace {

// The cells: state, number of writes, one for each of them, and behind those value and mask of each that does
// not fit into one. The state is the number of the batch and a bit that says that it is to be taken; while
// the bridge is at it, a third value.
constexpr std::size_t kState = 0;
constexpr std::size_t kCount = 1;
constexpr std::size_t kFirst = 2;
constexpr std::uint64_t kFull = 1;
constexpr std::uint64_t kBusy = 2;
constexpr int kNumberAt = 2;

// The cell of a write: variable, form, and 32 bits of the value.
constexpr int kVariableAt = 34;
constexpr int kFormAt = 32;
enum Form : std::uint64_t { kUnsigned, kSigned, kSingle, kFar };

constexpr std::uint64_t kAllBits = ~0ULL;
constexpr std::size_t kMostLinesNear = 16;

std::uint64_t single(std::uint32_t bits) noexcept {
  return std::bit_cast<std::uint64_t>(static_cast<double>(std::bit_cast<float>(bits)));
}

std::uint64_t signed_wide(std::uint32_t bits) noexcept {
  return static_cast<std::uint64_t>(static_cast<std::int32_t>(bits));
}

/// The form in which 32 bits are as good as all; those of a REAL in an LREAL are.
std::uint64_t packed(const VariableWrite& write) noexcept {
  const std::uint64_t all = write.value.u;
  const auto low = static_cast<std::uint32_t>(all);
  const std::uint64_t head = std::uint64_t{write.variable} << kVariableAt;
  if (write.mask != kAllBits) return head | kFar << kFormAt;
  if (all == low) return head | kUnsigned << kFormAt | low;
  if (all == signed_wide(low)) return head | kSigned << kFormAt | low;
  if (write.value.r >= -1e38 && write.value.r <= 1e38) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(write.value.r));
    if (all == single(bits)) return head | kSingle << kFormAt | bits;
  }
  return head | kFar << kFormAt;
}

}  // namespace

WriteMailbox::WriteMailbox(std::size_t variables)
    : variables_(variables), lines_((far_cell(variables) + kPerLine - 1) / kPerLine) {}

std::size_t WriteMailbox::far_cell(std::size_t place) const noexcept {
  return kFirst + variables_ + 2 * place;
}

bool WriteMailbox::take_back() noexcept {
  return (cell(kState).exchange(kBusy, std::memory_order_acq_rel) & kFull) != 0;
}

// The cycle may be reading. If it gets any of this, it gets with it that the state is another one.
void WriteMailbox::put(std::size_t place, const VariableWrite& write) noexcept {
  const std::uint64_t near = packed(write);
  cell(kFirst + place).store(near, std::memory_order_release);
  if ((near >> kFormAt & 3u) != kFar) return;
  cell(far_cell(place)).store(write.value.u, std::memory_order_release);
  cell(far_cell(place) + 1).store(write.mask, std::memory_order_release);
}

void WriteMailbox::hand_on(std::size_t count, std::uint64_t number) noexcept {
  cell(kCount).store(count, std::memory_order_release);
  cell(kState).store(number << kNumberAt | kFull, std::memory_order_release);
}

void WriteMailbox::come_near() const noexcept {
  come_near_for_writing(lines_.data());
  for (std::size_t i = 1; i < lines_taken_; ++i) come_near_for_reading(&lines_[i]);
}

std::uint64_t WriteMailbox::take(std::vector<VariableWrite>& writes) noexcept {
  std::uint64_t state = cell(kState).load(std::memory_order_acquire);
  if ((state & kFull) == 0) return 0;
  writes.resize(cell(kCount).load(std::memory_order_acquire));
  for (std::size_t i = 0; i < writes.size(); ++i) {
    const std::uint64_t near = cell(kFirst + i).load(std::memory_order_acquire);
    const auto low = static_cast<std::uint32_t>(near);
    VariableWrite& write = writes[i];
    write.variable = static_cast<std::uint32_t>(near >> kVariableAt);
    write.mask = kAllBits;
    switch (near >> kFormAt & 3u) {
      case kUnsigned:
        write.value.u = low;
        break;
      case kSigned:
        write.value.u = signed_wide(low);
        break;
      case kSingle:
        write.value.u = single(low);
        break;
      default:
        write.value.u = cell(far_cell(i)).load(std::memory_order_acquire);
        write.mask = cell(far_cell(i) + 1).load(std::memory_order_acquire);
    }
  }
  lines_taken_ = std::min(kMostLinesNear, (kFirst + writes.size() + kPerLine - 1) / kPerLine);
  // What was read counts only if the bridge has not been at it meanwhile.
  const bool is_taken = cell(kState).compare_exchange_strong(state, 0, std::memory_order_acq_rel);
  return is_taken ? state >> kNumberAt : 0;
}

}  // namespace lockstep
