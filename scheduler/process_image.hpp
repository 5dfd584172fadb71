/// The crossing of signal values between the cycle and the bridge: a snapshot out, a set of writes in.
/// @source contract of the project file, sections 4 and 6
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/triple_buffer.hpp"
#include "scheduler/write_mailbox.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A value to be written to a signal at the start of a tick.
struct SignalWrite {
  std::uint32_t signal = 0;    ///< index into the signals of the image
  Value value{};               ///< in the range of the signal's type
  std::uint64_t mask = ~0ULL;  ///< bits to write, the others keep what they are at that tick; other than all
                               ///< of them only for whole integers and bit strings; none, as a client may
                               ///< ask for: nothing is written
};

/// What crosses between the cycle and one thread of the bridge. Neither side ever waits for the other, and
/// neither allocates after construction. Writes enter the signals at the start of a tick, those of one batch
/// at the same tick; the values that leave are those of the end of one tick. Since of several writes before
/// one tick the last wins, they are merged on their way: there is always space for more, and a tick never has
/// more to apply than there are variables. The bridge sees its own writes at once, whether the cycle has
/// applied them already or not (or has not even started: then they wait).
class ProcessImage {
 public:
  /// Reads the signals once, so that the bridge has values before the first tick. The signals stay where they
  /// are for the life of the image, and nobody else changes them during construction.
  explicit ProcessImage(std::vector<Signal> signals);
  ProcessImage(const ProcessImage&) = delete;
  ProcessImage& operator=(const ProcessImage&) = delete;

  std::size_t size() const noexcept { return signals_.size(); }
  /// Type of the values of a signal: BOOL for a bit. `signal` < size().
  Type type(std::size_t signal) const noexcept { return signals_[signal].value_type(); }

  /// Applies the batches that were posted before. Every tick calls it once, and `publish` once after it.
  /// Thread: the cycle, at the start of a tick.
  void take_writes() noexcept;

  /// Shows the values as they stand to the bridge. `tick` ≥ 0. Thread: the cycle, at the end of a tick.
  void publish(std::int64_t tick) noexcept;

  /// Turns to the newest values; false if no tick ended since the last time. Thread: the bridge.
  bool refresh() noexcept;

  /// Tick at whose end the values stood to which the bridge has turned; -1 before the first one.
  /// Thread: the bridge.
  std::int64_t tick() const noexcept { return snapshot_.front().tick; }

  /// Value of a signal at that tick, with the posted writes which that tick did not know yet.
  /// `signal` < size(). Thread: the bridge.
  Value value(std::size_t signal) const noexcept {
    const std::uint32_t variable = indices_[signal];
    Value value = shown_[variable];
    if (is_behind_) value = with_own_writes(variable, value);
    if (const int bit = signals_[signal].bit; bit >= 0) value.u = value.u >> bit & 1u;
    return value;
  }

  /// Has all the writes applied, in their order, at the start of one tick. Every `signal` < size(). May turn
  /// to newer values, as `refresh` does. Thread: the bridge.
  void post(std::span<const SignalWrite> batch) noexcept;

 private:
  static constexpr std::size_t kPerLine = kCacheLine / sizeof(Value);
  struct alignas(kCacheLine) Line {
    std::array<Value, kPerLine> values{};
  };
  struct Snapshot {
    std::int64_t tick = -1;
    std::uint64_t applied = 0;  ///< number of the last batch that is in the values
    std::vector<Line> lines;    ///< values of `variables_`
  };

  /// Merged writes, by variable: what applying one after the other would give.
  class WriteSet {
   public:
    explicit WriteSet(std::size_t variables) : indices_(variables) { writes_.reserve(variables); }
    /// @return the index of the write to this variable
    std::size_t add(std::uint32_t variable, Value value, std::uint64_t mask) noexcept;
    void clear() noexcept;
    std::size_t size() const noexcept { return writes_.size(); }
    const VariableWrite& at(std::size_t index) const noexcept { return writes_[index]; }
    /// nullptr: there is none
    const VariableWrite* to(std::uint32_t variable) const noexcept {
      return indices_[variable] == 0 ? nullptr : &writes_[indices_[variable] - 1];
    }

    std::uint64_t last = 0;  ///< number of the last batch in it; 0: none

   private:
    std::vector<VariableWrite> writes_;
    std::vector<std::uint32_t> indices_;  ///< by variable, plus one; 0: no write
  };

  void fill(std::vector<Line>& lines) const noexcept;
  Value with_own_writes(std::uint32_t variable, Value value) const noexcept;
  void add(const SignalWrite& write) noexcept;

  // Fixed after construction. Several signals may lie in one variable: the word and its bits.
  const std::vector<Signal> signals_;
  std::vector<Signal> variables_;       ///< the distinct variables, whole, by type
  std::vector<std::uint32_t> indices_;  ///< variable of each signal

  TripleBuffer<Snapshot> snapshot_;
  WriteMailbox mailbox_;

  // The cycle's.
  alignas(kCacheLine) std::uint64_t applied_ = 0;  ///< number of the last batch applied

  // The bridge's. It reads of a snapshot only what it is asked for: the rest stays with the cycle. Its own
  // writes, which a snapshot may not know yet, are those that the cycle had not taken when it last looked,
  // and those that it had.
  alignas(kCacheLine) const Value* shown_ = nullptr;  ///< values of the snapshot
  bool is_behind_ = false;                            ///< the snapshot does not know all writes
  WriteSet waiting_, taken_by_cycle_;
  std::uint64_t posted_ = 0;
};

}  // namespace lockstep
