#include "scheduler/write_mailbox.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "scheduler/come_near.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kState = 0;
constexpr std::size_t kCount = 1;
constexpr std::size_t kFirst = 2;
constexpr std::uint64_t kTaken = 0;

// The cell of a write: variable, form, and 32 bits. They are the memory of a variable that has no more, or
// what the 64 bits of a larger one can be had from.
constexpr int kVariableAt = 35;
constexpr int kFormAt = 32;
constexpr std::uint64_t kFormBits = 7;
enum Form : std::uint64_t { kOneByte, kTwoBytes, kFourBytes, kUnsigned, kSigned, kSingle, kFar };

constexpr std::uint64_t kAllBits = ~0ULL;
constexpr std::size_t kMostLinesNear = 16;

std::uint64_t single(std::uint32_t bits) noexcept {
  return std::bit_cast<std::uint64_t>(static_cast<double>(std::bit_cast<float>(bits)));
}

std::uint64_t signed_wide(std::uint32_t bits) noexcept {
  return static_cast<std::uint64_t>(static_cast<std::int32_t>(bits));
}

/// Of a variable of 64 bits: the form in which 32 of them are as good as all; those of a REAL in an LREAL
/// are.
std::uint64_t packed(Value value) noexcept {
  const std::uint64_t all = value.u;
  const auto low = static_cast<std::uint32_t>(all);
  if (all == low) return std::uint64_t{kUnsigned} << kFormAt | low;
  if (all == signed_wide(low)) return std::uint64_t{kSigned} << kFormAt | low;
  if (value.r >= -1e38 && value.r <= 1e38) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value.r));
    if (all == single(bits)) return std::uint64_t{kSingle} << kFormAt | bits;
  }
  return std::uint64_t{kFar} << kFormAt;
}

/// Form and 32 bits of a write.
std::uint64_t packed(Type type, const VariableWrite& write) noexcept {
  if (write.mask != kAllBits) return std::uint64_t{kFar} << kFormAt;
  std::uint32_t memory = 0;
  const Signal copy{&memory, type, -1};
  switch (size_of(type)) {
    case 1:
      copy.store(write.value);
      return std::uint64_t{kOneByte} << kFormAt | memory;
    case 2:
      copy.store(write.value);
      return std::uint64_t{kTwoBytes} << kFormAt | memory;
    case 4:
      copy.store(write.value);
      return std::uint64_t{kFourBytes} << kFormAt | memory;
    default:
      return packed(write.value);
  }
}

template <class Bits>
bool write_memory(void* address, Bits bits) noexcept {
  std::memcpy(address, &bits, sizeof bits);
  return true;
}

/// Does what one cell says; false if that is not all of it.
bool write_near(std::span<const Signal> variables, std::uint64_t cell) noexcept {
  const auto low = static_cast<std::uint32_t>(cell);
  void* const address = variables[cell >> kVariableAt].address;
  switch (cell >> kFormAt & kFormBits) {
    case kOneByte:
      return write_memory(address, static_cast<std::uint8_t>(low));
    case kTwoBytes:
      return write_memory(address, static_cast<std::uint16_t>(low));
    case kFourBytes:
      return write_memory(address, low);
    case kUnsigned:
      return write_memory(address, std::uint64_t{low});
    case kSigned:
      return write_memory(address, signed_wide(low));
    case kSingle:
      return write_memory(address, single(low));
    default:
      return false;
  }
}

}  // namespace

Value written(const Signal& variable, Value before, const VariableWrite& write) noexcept {
  if (write.mask == kAllBits && variable.type != Type::REAL) return write.value;
  std::uint64_t memory = 0;
  const Signal copy{&memory, variable.type, -1};
  VariableWrite all{0, before, kAllBits};
  all.add(write.value, write.mask);
  copy.store(all.value);
  return copy.load();
}

WriteMailbox::WriteMailbox(std::span<const Signal> variables) : variables_(variables) {
  for (Slot& slot : slots_) {
    slot.lines.resize((far_cell(variables.size()) + kPerLine - 1) / kPerLine);
    slot.cells = slot.lines.data()->cells.data();
  }
}

std::size_t WriteMailbox::far_cell(std::size_t place) const noexcept {
  return kFirst + variables_.size() + 2 * place;
}

// The cycle takes the slots by turns. Once it has taken this one, it is through with the other.
bool WriteMailbox::take_back() noexcept {
  const std::atomic_ref state(slots_[filled_].cells[kState]);
  if (state.exchange(kTaken, std::memory_order_acq_rel) != kTaken) return true;
  filled_ = 1 - filled_;
  return false;
}

void WriteMailbox::put(std::size_t place, const VariableWrite& write) noexcept {
  Cell* const cells = slots_[filled_].cells;
  const std::uint64_t bits = packed(variables_[write.variable].type, write);
  cells[kFirst + place] = std::uint64_t{write.variable} << kVariableAt | bits;
  if (bits >> kFormAt != kFar) return;
  cells[far_cell(place)] = write.value.u;
  cells[far_cell(place) + 1] = write.mask;
}

void WriteMailbox::hand_on(std::size_t count, std::uint64_t number) noexcept {
  Cell* const cells = slots_[filled_].cells;
  cells[kCount] = count;
  std::atomic_ref(cells[kState]).store(number, std::memory_order_release);
}

void WriteMailbox::come_near() const noexcept {
  const std::vector<Line>& lines = slots_[awaited_].lines;
  come_near_for_writing(lines.data());
  for (std::size_t i = 1; i < lines_near_; ++i) come_near_for_reading(&lines[i]);
}

std::uint64_t WriteMailbox::apply() noexcept {
  Cell* const cells = slots_[awaited_].cells;
  const std::atomic_ref state(cells[kState]);
  if (state.load(std::memory_order_relaxed) == kTaken) return 0;
  const std::uint64_t number = state.exchange(kTaken, std::memory_order_acq_rel);
  if (number == kTaken) return 0;  // the bridge has been quicker
  const std::span near(cells + kFirst, cells[kCount]);
  for (const Cell& write : near)
    if (!write_near(variables_, write)) apply_far(cells, static_cast<std::size_t>(&write - near.data()));
  lines_near_ = std::min(kMostLinesNear, (kFirst + near.size() + kPerLine - 1) / kPerLine);
  awaited_ = 1 - awaited_;
  return number;
}

void WriteMailbox::apply_far(const Cell* cells, std::size_t place) const noexcept {
  const VariableWrite write{static_cast<std::uint32_t>(cells[kFirst + place] >> kVariableAt),
                            {.u = cells[far_cell(place)]},
                            cells[far_cell(place) + 1]};
  const Signal& variable = variables_[write.variable];
  variable.store(written(variable, variable.load(), write));
}

}  // namespace lockstep
