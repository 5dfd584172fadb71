/// The crossing of writes to signals that somebody chooses while the cycle runs, such as those of a page of
/// the studio.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/text.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A value that somebody chooses, and what stood there before.
struct ChosenWrite {
  Signal signal{};  ///< of a text: nothing
  Value value{};    ///< in the range of the signal's type
  std::uint64_t mask =
      ~0ULL;               ///< bits to write; other than all of them only for whole integers and bit strings
  Value before{};          ///< once it is applied
  Text text{};             ///< of a tag of type STRING; else without characters
  std::string new_text{};  ///< what it gets
  std::string old_text{};  ///< once it is applied; as long as the text may be, zeroes behind its end
};

/// Batches of writes, one after the other: the bridge hands one over, the cycle applies it as a whole at the
/// start of a tick and tells which tick that was. The memory of a batch belongs to one side at a time, and to
/// the bridge before and after; so nothing is made, given back or waited for in a tick, and without a batch a
/// tick costs one load. Threads: the *cycle* applies, the *bridge* (one thread) does the rest.
class ChosenWrites {
 public:
  static constexpr std::size_t kMaximum = 1000;  ///< writes of a batch

  ChosenWrites() = default;
  ChosenWrites(const ChosenWrites&) = delete;
  ChosenWrites& operator=(const ChosenWrites&) = delete;

  /// Applies the batch that has been handed over, if there is one. Thread: the cycle, at the start of a tick.
  void apply(std::int64_t tick) noexcept {
    if (handed_over_.load(std::memory_order_acquire) != number_) apply_batch(tick);
  }

  /// Hands a batch over. @return false: the one before has not been applied, or this one has too many writes;
  /// nothing has happened. Thread: the bridge.
  bool post(std::vector<ChosenWrite> batch);
  /// Whether all that was handed over has been applied. Thread: the bridge.
  bool is_applied() const noexcept {
    return applied_.load(std::memory_order_acquire) == handed_over_.load(std::memory_order_relaxed);
  }
  /// The batch that was handed over last, with what stood there before, once it is applied. Thread: the
  /// bridge.
  const std::vector<ChosenWrite>& batch() const noexcept { return batch_; }
  /// At the start of which tick that was. Thread: the bridge, once it is applied.
  std::int64_t tick() const noexcept { return tick_; }

 private:
  void apply_batch(std::int64_t tick) noexcept;

  // In one line, which is written only where there is a batch.
  alignas(kCacheLine) std::uint64_t number_ = 0;  // the cycle's: of the last batch applied
  // Whose the batch is: the cycle's as long as the two differ.
  std::atomic<std::uint64_t> handed_over_{0};
  std::atomic<std::uint64_t> applied_{0};
  std::vector<ChosenWrite> batch_;
  std::int64_t tick_ = -1;
};

}  // namespace lockstep
