/// Hands the newest state of one thread to another one.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "scheduler/come_near.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"

namespace lockstep {

/// A value that one thread writes again and again and one other thread reads; the reader always gets the
/// newest complete one, and older ones are overwritten. Neither side ever waits for the other: each owns one
/// of three slots, and the third changes hands by one atomic exchange. Nothing is allocated after
/// construction unless assigning a `T` allocates.
template <class T>
class TripleBuffer {
 public:
  /// All three slots start as copies of `initial`, which is also what the reader sees first.
  explicit TripleBuffer(const T& initial) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}
  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// The slot to fill before `publish`. It holds some older value, not the last one: fill all of it.
  /// Thread: the writer.
  T& back() noexcept { return slots_[back_].value; }

  /// Fetches what the reader has touched and `publish` needs, some time before it. Thread: the writer.
  void prefetch() const noexcept {
    come_near_for_writing(&shared_);
    come_near_for_writing(&slots_[back_]);
  }

  /// Makes what `back` holds the newest value; `back` is another slot from here on. Thread: the writer.
  void publish() noexcept {
    // Release gives the reader this slot's content; acquire makes its reading of the returned slot end first.
    back_ = shared_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kSlot;
  }

  /// Turns to the newest value. True if one was published since the last call. Thread: the reader.
  bool refresh() noexcept {
    if ((shared_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = shared_.exchange(front_, std::memory_order_acq_rel) & kSlot;
    return true;
  }

  /// The value that the last `refresh` turned to; it stays as it is until the next one. Thread: the reader.
  const T& front() const noexcept { return slots_[front_].value; }

 private:
  static constexpr std::uint8_t kSlot = 3;   ///< bits of `shared_` that number a slot
  static constexpr std::uint8_t kFresh = 4;  ///< bit of `shared_`: published and not yet taken

  struct alignas(kCacheLine) Slot {
    T value;
  };

  std::array<Slot, 3> slots_;
  alignas(kCacheLine) std::atomic<std::uint8_t> shared_{1};
  alignas(kCacheLine) std::uint8_t back_ = 0;   ///< the writer's
  alignas(kCacheLine) std::uint8_t front_ = 2;  ///< the reader's
};

}  // namespace lockstep
