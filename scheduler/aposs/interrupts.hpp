/// The interrupts of a program: what is watched, what has come up, and whose turn it is.
/// @source MCO 305 Design Guide, priorities of interrupts; DISABLE, ENABLE, ON …
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "scheduler/aposs/device.hpp"
#include "scheduler/aposs/interrupt_operands.hpp"

namespace lockstep::aposs {

inline constexpr std::size_t kMaximumInputInterrupts = 32;
inline constexpr std::size_t kMaximumBitInterrupts = 32;
inline constexpr std::size_t kMaximumPositionInterrupts = 20;
inline constexpr std::size_t kMaximumParameterInterrupts = 10;
inline constexpr std::size_t kMaximumTimeInterrupts = 12;

/// A list that never allocates and keeps its order.
template <class T, std::size_t maximum>
class FixedList {
 public:
  T* begin() noexcept { return items_.data(); }
  T* end() noexcept { return items_.data() + count_; }
  bool full() const noexcept { return count_ == maximum; }
  void push(const T& item) noexcept { items_[count_++] = item; }
  void clear() noexcept { count_ = 0; }
  void erase(T* at) noexcept {
    for (T* next = at + 1; next != end(); ++at, ++next) *at = *next;
    --count_;
  }

 private:
  std::array<T, maximum> items_{};
  std::size_t count_ = 0;
};

class Interrupts {
 public:
  using Entry = std::uint16_t;  ///< of a subprogram

  void clear() noexcept;

  /// ON INT, ON COMBIT, ON STATBIT: `number` below 0 is the falling edge. One subprogram for each number.
  /// @return 0; 149 if there are too many, as the others
  int define_edge(EdgeSource source, std::int32_t number, Entry entry, Device& device) noexcept;
  /// A second definition for the same position and direction takes the first one's place.
  int define_position(PositionInterrupt which, std::int32_t at, Entry entry, Device& device) noexcept;
  int define_parameter(std::int32_t number, Entry entry, Device& device) noexcept;
  /// ON TIME: once; another one for the same subprogram starts its time anew.
  /// @return 0; 184 if there are too many
  int define_time(std::int32_t after, Entry entry, std::int64_t now) noexcept;
  /// ON PERIOD: a period of 0 or less ends that of the subprogram.
  int define_period(std::int32_t period, Entry entry, std::int64_t now) noexcept;
  /// ON DELETE: all position interrupts of a subprogram.
  void delete_positions(Entry entry) noexcept;

  void disable(InterruptClass which) noexcept { disabled_[static_cast<std::size_t>(which)] = true; }
  void enable(InterruptClass which) noexcept { disabled_[static_cast<std::size_t>(which)] = false; }
  bool disabled(InterruptClass which) const noexcept { return disabled_[static_cast<std::size_t>(which)]; }

  /// Compares all sources with what they were; once a step.
  void compare(Device& device) noexcept;
  /// The one whose turn it is, which is then no longer pending. None while all are disabled.
  /// @param looks whether times are looked at in this step
  std::optional<Entry> take(std::int64_t now, bool looks) noexcept;

 private:
  struct Edge {
    std::int32_t number = 0;
    Entry entry = 0;
    bool level = false, pending = false;
  };
  struct Position {
    PositionInterrupt which = 0;
    std::int32_t at = 0, last = 0;
    Entry entry = 0;
    bool pending = false;
  };
  struct Parameter {
    std::int32_t number = 0;
    std::uint32_t changes = 0;
    Entry entry = 0;
    bool pending = false;
  };
  struct Timer {
    std::int64_t due = 0;
    std::int32_t period = 0;  ///< 0: once
    Entry entry = 0;
  };
  using Edges = FixedList<Edge, kMaximumBitInterrupts>;
  static_assert(kMaximumInputInterrupts == kMaximumBitInterrupts);

  Edges& edges(EdgeSource source) noexcept { return edges_[static_cast<std::size_t>(source)]; }
  void compare_edges(EdgeSource source, InterruptClass which, Device& device) noexcept;
  int define_timer(const Timer& timer) noexcept;
  std::optional<Entry> take_edge(EdgeSource source, InterruptClass which) noexcept;
  template <class List>
  std::optional<Entry> take_first(List& list, InterruptClass which) noexcept;
  std::optional<Entry> take_timer(std::int64_t now) noexcept;

  std::array<Edges, 3> edges_;
  FixedList<Position, kMaximumPositionInterrupts> positions_;
  FixedList<Parameter, kMaximumParameterInterrupts> parameters_;
  FixedList<Timer, kMaximumTimeInterrupts> timers_;
  std::array<bool, kInterruptClasses> disabled_{};
};

/// Whether a position is passed between two readings, also over the end of its period.
bool passed(std::int32_t from, std::int32_t to, std::int32_t at, bool negative, std::int64_t period) noexcept;

}  // namespace lockstep::aposs
