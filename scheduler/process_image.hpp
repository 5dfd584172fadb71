/// The crossing of signal values between the cycle and the bridge: a snapshot out, a set of writes in.
/// @source contract of the project file, sections 4 and 6
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/triple_buffer.hpp"
#include "tech_objects/cache_line.hpp"
#include "tech_objects/types.hpp"

namespace lockstep {

/// A value to be written to a signal at the start of a tick.
struct SignalWrite {
  std::uint32_t signal = 0;    ///< index into the signals of the image
  Value value{};               ///< in the range of the signal's type
  std::uint64_t mask = ~0ULL;  ///< bits to write, the others keep what they are at that tick; other than all
                               ///< of them only for whole integers and bit strings
};

/// What crosses between the cycle and one thread of the bridge. Neither side ever waits for the other, and
/// neither allocates after construction. Writes enter the signals at the start of a tick, those of one batch
/// at the same tick; the values that leave are those of the end of one tick. Since of several writes before
/// one tick the last wins, they are merged on their way: there is always room for more, and a tick never has
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
    Value value = shadow_[places_[signal]];
    if (const int bit = signals_[signal].bit; bit >= 0) value.u = value.u >> bit & 1u;
    return value;
  }

  /// The same for many signals that are whole variables, no bits: the value of a signal is
  /// `values()[places()[signal]]`. Valid until the next `refresh` or `post`. Thread: the bridge.
  std::span<const Value> values() const noexcept { return shadow_; }
  std::span<const std::uint32_t> places() const noexcept { return places_; }

  /// Has all the writes applied, in their order, at the start of one tick. Every `signal` < size(). May turn
  /// to newer values, as `refresh` does. Thread: the bridge.
  void post(std::span<const SignalWrite> batch) noexcept;

 private:
  struct Snapshot {
    std::int64_t tick = -1;
    std::uint64_t applied = 0;  ///< number of the last batch that is in `values`
    std::vector<Value> values;  ///< of `variables_`
  };

  /// Merged writes, by variable: what applying one after the other would give.
  class WriteSet {
   public:
    explicit WriteSet(std::size_t variables) : writes_(variables) { touched_.reserve(variables); }
    void add(std::uint32_t variable, Value value, std::uint64_t mask) noexcept;
    void clear() noexcept;
    /// Writes to the variables, or to values that stand for them.
    void apply(const std::vector<Signal>& variables) const noexcept;
    void apply(const std::vector<Signal>& variables, std::vector<Value>& values) const noexcept;

    std::uint64_t last = 0;  ///< number of the last batch in it; 0: none

   private:
    struct Write {
      Value value{};
      std::uint64_t mask = 0;  ///< 0: no write
    };
    std::vector<Write> writes_;
    std::vector<std::uint32_t> touched_;  ///< variables with a write
  };

  void bring_snapshot_near() noexcept;
  static Snapshot first_snapshot(const std::vector<Signal>& variables);
  void add(WriteSet& set, const SignalWrite& write) noexcept;

  // Fixed after construction. Several signals may lie in one variable: the word and its bits.
  const std::vector<Signal> signals_;
  std::vector<Signal> variables_;      ///< the distinct variables, whole
  std::vector<std::uint32_t> places_;  ///< variable of each signal

  TripleBuffer<Snapshot> snapshot_;

  // Three sets: one of each side and one in the box between them, where `kFull` says that it is to be
  // applied. The cycle takes it only if it is; the bridge takes it back to add to it, so that each is applied
  // once.
  static constexpr std::uint8_t kSet = 3;
  static constexpr std::uint8_t kFull = 4;
  std::array<WriteSet, 3> sets_;
  alignas(kCacheLine) std::atomic<std::uint8_t> box_{1};

  alignas(kCacheLine) std::uint8_t cycle_set_ = 0;
  std::uint64_t applied_ = 0;  ///< the cycle's: number of the last batch applied

  // The bridge's: the variables as it sees them, and its writes that the cycle had not taken when it last
  // looked.
  alignas(kCacheLine) std::uint8_t bridge_set_ = 2;
  std::vector<Value> shadow_;
  WriteSet waiting_;
  std::uint64_t posted_ = 0;
};

}  // namespace lockstep
