/// Writes to variables on their way from one thread of the bridge to the cycle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A write to a variable, merged of all that have come for it.
struct VariableWrite {
  std::uint32_t variable = 0;
  Value value{};
  std::uint64_t mask = ~0ULL;  ///< bits to write; none that the variable has: nothing is written

  /// Makes this the write that does what it and then the other would.
  void add(Value later, std::uint64_t its_mask) noexcept {
    value.u = (value.u & ~its_mask) | (later.u & its_mask);
    mask |= its_mask;
  }
};

/// Holds at most one write for each variable. The bridge takes everything back to add to it; the cycle
/// applies all of it, once, or nothing if the bridge is just adding. Neither waits for the other, and nothing
/// is allocated after construction. There are two slots: while the cycle applies what is in one, the bridge
/// fills the other. What the processors hand over to each other is little: six writes that fit 32 bits stand
/// in one cache line with the state of the slot, eight more in each that follows.
class WriteMailbox {
 public:
  /// @param variables that the writes are for, whole ones; they outlive the mailbox
  explicit WriteMailbox(std::span<const Signal> variables);

  /// Takes back what the cycle has not begun to apply. @return whether there was something; if not, what is
  /// put begins anew. Thread: the bridge.
  bool take_back() noexcept;
  /// Puts a write at an index, below the number of variables. Thread: the bridge, after `take_back`.
  void put(std::size_t index, const VariableWrite& write) noexcept;
  /// Hands on what stands at the first `count` indices, as batch `number` ≥ 1, greater than those before.
  /// Thread: the bridge.
  void hand_on(std::size_t count, std::uint64_t number) noexcept;

  /// Fetches what `apply` is going to read. Thread: the cycle.
  void prefetch() const noexcept;
  /// Writes to the variables. @return the number of the batch; 0: there is nothing. Thread: the cycle.
  std::uint64_t apply() noexcept;

 private:
  using Cell = std::uint64_t;
  static constexpr std::size_t kPerLine = kCacheLine / sizeof(Cell);
  struct alignas(kCacheLine) Line {
    std::array<Cell, kPerLine> cells{};
  };
  /// The cells of a slot: its state, the number of writes, and three for each of them: address, bits and mask
  /// of the memory. The state is the number of the batch while the slot is the cycle's for the taking; 0: one
  /// side has taken it.
  struct Slot {
    std::vector<Line> lines;
    Cell* cells = nullptr;  ///< of all lines
  };

  const std::span<const Signal> variables_;
  std::vector<std::uint64_t> whole_;  ///< masks of all the bits of each variable
  std::array<Slot, 2> slots_;
  alignas(kCacheLine) std::size_t filled_ = 0;   ///< the bridge's: slot that it fills
  alignas(kCacheLine) std::size_t awaited_ = 1;  ///< the cycle's: slot that it applies next
  std::size_t lines_near_ = 1;                   ///< the cycle's: what the last writes took
};

}  // namespace lockstep
