/// The crossing of signal values between the cycle and the bridge: a snapshot out, a queue of writes in.
/// @source contract of the project file, sections 4 and 6
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/spsc_queue.hpp"
#include "scheduler/triple_buffer.hpp"
#include "tech_objects/types.hpp"

namespace lockstep {

/// A value to be written to a signal at the start of a tick.
struct SignalWrite {
  std::uint32_t signal = 0;    ///< index into the signals of the image
  Value value{};               ///< in the range of the signal's type
  std::uint64_t mask = ~0ULL;  ///< bits to write, the others keep what they are at that tick; integers and
                               ///< bit strings only
};

/// What crosses between the cycle and one thread of the bridge. The cycle's side is wait-free and allocates
/// nothing. Writes enter the signals at the start of a tick, those of one batch at the same tick; the values
/// that leave are those of the end of one tick. The bridge sees its own writes at once, whether the cycle has
/// applied them already or not (or has not even started: then they wait in the queue).
class ProcessImage {
 public:
  /// Number of writes that may be on their way: more than the largest Modbus request holds (1968 coils), and
  /// few enough that applying all of them in one tick takes some ten microseconds.
  static constexpr std::size_t kDefaultCapacity = 2048;

  /// Reads the signals once, so that the bridge has values before the first tick. The signals stay where they
  /// are for the life of the image, and nobody else changes them during construction.
  explicit ProcessImage(std::vector<Signal> signals, std::size_t capacity = kDefaultCapacity);
  ProcessImage(const ProcessImage&) = delete;
  ProcessImage& operator=(const ProcessImage&) = delete;

  std::size_t size() const noexcept { return places_.size(); }
  /// Type of the values of a signal: BOOL for a bit. `signal` < size().
  Type type(std::size_t signal) const noexcept { return signals_[signal].value_type(); }

  /// Applies all writes that were posted before, oldest first, so that the last one to a signal wins. At most
  /// as many as the capacity. Thread: the cycle, at the start of a tick.
  void take_writes() noexcept;

  /// Shows the values as they stand to the bridge. `tick` ≥ 0. Thread: the cycle, at the end of a tick.
  void publish(std::int64_t tick) noexcept;

  /// Turns to the newest values; false if no tick ended since the last call. Thread: the bridge.
  bool refresh() noexcept;

  /// Tick at whose end the values stood that `refresh` turned to; -1 before the first one. Thread: the
  /// bridge.
  std::int64_t tick() const noexcept { return snapshot_.front().tick; }

  /// Value of a signal at that tick, with the posted writes which that tick did not know yet.
  /// `signal` < size(). Thread: the bridge.
  Value value(std::size_t signal) const noexcept;

  /// Has all the writes applied at the start of one tick. False, and none is, if they do not fit beside those
  /// on their way: the client has to be told. Every `signal` < size(). Thread: the bridge.
  [[nodiscard]] bool post(std::span<const SignalWrite> batch) noexcept;

 private:
  struct Snapshot {
    std::int64_t tick = -1;
    std::uint64_t applied = 0;  ///< number of writes, from the first one on, that are in `values`
    std::vector<Value> values;  ///< of `variables_`
  };

  static Snapshot first_snapshot(const std::vector<Signal>& variables);
  static void apply(const Signal& signal, const SignalWrite& write) noexcept;
  Signal shadow_of(std::size_t signal) const noexcept;

  // Fixed after construction. Several signals may lie in one variable: the word and its bits.
  const std::vector<Signal> signals_;
  std::vector<Signal> variables_;      ///< the distinct variables, whole
  std::vector<std::uint32_t> places_;  ///< variable of each signal

  SpscQueue<SignalWrite> writes_;
  TripleBuffer<Snapshot> snapshot_;

  std::uint64_t applied_ = 0;  ///< the cycle's: writes applied so far

  // The bridge's: the variables as it sees them, and its writes that no snapshot has shown yet.
  mutable std::vector<std::uint64_t> shadow_;
  std::vector<SignalWrite> pending_;  ///< a ring of the queue's capacity, indexed by number of write
  std::uint64_t posted_ = 0;
  std::uint64_t shown_ = 0;
};

}  // namespace lockstep
