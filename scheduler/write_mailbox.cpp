#include "scheduler/write_mailbox.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "scheduler/come_near.hpp"

namespace lockstep {
namespace {

static_assert(std::endian::native == std::endian::little, "bits stand in memory from the lowest on");

constexpr std::size_t kState = 0;
constexpr std::size_t kCount = 1;
constexpr std::size_t kFirst = 2;
constexpr std::uint64_t kTaken = 0;

constexpr std::size_t kPerWrite = 3;
constexpr std::size_t kMaximumLinesNear = 8;

constexpr std::size_t cells_of(std::size_t writes) noexcept {
  return kFirst + kPerWrite * writes;
}

/// Lines that it is worth to move before they are needed.
constexpr std::size_t lines_near(std::size_t writes, std::size_t per_line) noexcept {
  return std::min(kMaximumLinesNear, (cells_of(writes) + per_line - 1) / per_line);
}

/// The bits of a value as they stand in the memory of a variable, from the lowest on.
std::uint64_t in_memory(Type type, Value value) noexcept {
  if (type == Type::REAL) return std::bit_cast<std::uint32_t>(static_cast<float>(value.r));
  return type == Type::BOOL ? std::uint64_t{value.u != 0} : value.u;
}

/// All bits of the memory of a variable of so many bytes.
constexpr std::uint64_t all_of(std::size_t bytes) noexcept {
  return ~std::uint64_t{0} >> (64 - 8 * bytes);
}

void write_some_bits(unsigned char* memory, std::uint64_t bits, std::uint64_t mask) noexcept {
  for (; mask != 0; ++memory, bits >>= 8, mask >>= 8)
    *memory = static_cast<unsigned char>((*memory & ~mask) | (bits & mask));
}

/// Does what three cells say.
void write_memory(const std::uint64_t* write) noexcept {
  auto* const memory = std::bit_cast<unsigned char*>(write[0]);
  const std::uint64_t bits = write[1];
  switch (const std::uint64_t mask = write[2]) {
    case all_of(1):
      std::memcpy(memory, &bits, 1);
      break;
    case all_of(2):
      std::memcpy(memory, &bits, 2);
      break;
    case all_of(4):
      std::memcpy(memory, &bits, 4);
      break;
    case all_of(8):
      std::memcpy(memory, &bits, 8);
      break;
    default:
      write_some_bits(memory, bits, mask);
  }
}

}  // namespace

WriteMailbox::WriteMailbox(std::span<const Signal> variables) : variables_(variables) {
  for (const Signal& variable : variables)
    whole_.push_back(all_of(static_cast<std::size_t>(size_of(variable.type))));
  for (Slot& slot : slots_) {
    slot.lines.resize((cells_of(variables.size()) + kPerLine - 1) / kPerLine);
    slot.cells = slot.lines.data()->cells.data();
  }
}

// The cycle takes the slots by turns. Once it has taken this one, it is through with the other.
bool WriteMailbox::take_back() noexcept {
  const std::atomic_ref state(slots_[filled_].cells[kState]);
  if (state.exchange(kTaken, std::memory_order_acq_rel) != kTaken) return true;
  filled_ = 1 - filled_;
  return false;
}

void WriteMailbox::put(std::size_t index, const VariableWrite& write) noexcept {
  const Signal& variable = variables_[write.variable];
  Cell* const cells = slots_[filled_].cells + cells_of(index);
  cells[0] = std::bit_cast<std::uint64_t>(variable.address);
  cells[1] = in_memory(variable.type, write.value);
  cells[2] = write.mask & whole_[write.variable];
}

void WriteMailbox::hand_on(std::size_t count, std::uint64_t number) noexcept {
  Cell* const cells = slots_[filled_].cells;
  cells[kCount] = count;
  std::atomic_ref(cells[kState]).store(number, std::memory_order_release);
  for (std::size_t i = 0; i < lines_near(count, kPerLine); ++i) send_away(cells + i * kPerLine);
}

void WriteMailbox::prefetch() const noexcept {
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
  const Cell* const end = cells + cells_of(cells[kCount]);
  for (const Cell* write = cells + kFirst; write != end; write += kPerWrite) write_memory(write);
  lines_near_ = lines_near(cells[kCount], kPerLine);
  awaited_ = 1 - awaited_;
  return number;
}

}  // namespace lockstep
