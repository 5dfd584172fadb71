/// Writes to variables on their way from one thread of the bridge to the cycle.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tech_objects/cache_line.hpp"
#include "tech_objects/types.hpp"

namespace lockstep {

/// A write to a variable, merged of all that have come for it.
struct VariableWrite {
  std::uint32_t variable = 0;
  Value value{};
  std::uint64_t mask = ~0ULL;  ///< bits to write

  /// Makes this the write that does what it and then the other would.
  void add(Value later, std::uint64_t its_mask) noexcept {
    value.u = (value.u & ~its_mask) | (later.u & its_mask);
    mask |= its_mask;
  }
};

/// Holds at most one write for each variable. The bridge takes everything back to add to it; the cycle takes
/// all of it, once, or nothing if the bridge is just adding. Neither waits for the other, and nothing is
/// allocated after construction. What the processors hand over to each other is little: up to six writes of
/// values that fit 32 bits stand in one cache line with the state, eight more in each that follows.
class WriteMailbox {
 public:
  /// @param variables writes are for those below this number, at most 2^30
  explicit WriteMailbox(std::size_t variables);

  /// Takes back what the cycle has not taken. @return whether there was something. Thread: the bridge.
  bool take_back() noexcept;
  /// Puts a write at a place, below the number of variables. Thread: the bridge, after `take_back`.
  void put(std::size_t place, const VariableWrite& write) noexcept;
  /// Hands on what stands at the first `count` places, as batch `number` ≥ 1, greater than those before.
  /// Thread: the bridge.
  void hand_on(std::size_t count, std::uint64_t number) noexcept;

  /// Fetches what `take` is going to read. Thread: the cycle.
  void come_near() const noexcept;
  /// Fills `writes`, whose room suffices for all variables. @return the number of the batch; 0: there is
  /// nothing. Thread: the cycle.
  std::uint64_t take(std::vector<VariableWrite>& writes) noexcept;

 private:
  using Cell = std::atomic<std::uint64_t>;
  static constexpr std::size_t kPerLine = kCacheLine / sizeof(Cell);
  struct alignas(kCacheLine) Line {
    std::array<Cell, kPerLine> cells{};
  };
  Cell& cell(std::size_t i) noexcept { return lines_[i / kPerLine].cells[i % kPerLine]; }
  std::size_t far_cell(std::size_t place) const noexcept;

  const std::size_t variables_;
  std::vector<Line> lines_;
  std::size_t lines_taken_ = 1;  ///< the cycle's: what the last writes took
};

}  // namespace lockstep
