/// Hands items from one thread to another one, in order and without loss.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lockstep {

/// A queue of fixed capacity between one producer and one consumer. Neither side ever waits: a full queue
/// refuses, an empty one gives nothing. Allocates in its constructor only. Several items pushed together
/// appear together: the consumer finds all of them or none.
template <class T>
class SpscQueue {
 public:
  /// `capacity` ≥ 0: the greatest number of items it holds.
  explicit SpscQueue(std::size_t capacity)
      : capacity_(capacity), items_(std::bit_ceil(std::max<std::size_t>(capacity, 1))) {}
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  std::size_t capacity() const noexcept { return capacity_; }

  /// Appends all the items, or, where they do not fit, none and returns false. Thread: the producer.
  [[nodiscard]] bool push(std::span<const T> items) noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (items.size() > capacity_ - (tail - known_head_)) {
      known_head_ = head_.load(std::memory_order_acquire);
      if (items.size() > capacity_ - (tail - known_head_)) return false;
    }
    for (std::size_t i = 0; i < items.size(); ++i) slot(tail + i) = items[i];
    tail_.store(tail + items.size(), std::memory_order_release);
    return true;
  }
  [[nodiscard]] bool push(const T& item) noexcept { return push(std::span<const T>(&item, 1)); }

  /// Calls `use(item)` for every item that is in the queue at the time of the call, oldest first, and removes
  /// them; items pushed meanwhile stay, so that the work is bounded by the capacity. Returns their number.
  /// Thread: the consumer.
  template <class Use>
  std::size_t consume(Use&& use) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t tail = tail_.load(std::memory_order_acquire);
    for (std::uint64_t i = head; i != tail; ++i) use(static_cast<const T&>(slot(i)));
    head_.store(tail, std::memory_order_release);
    return static_cast<std::size_t>(tail - head);
  }

  /// Moves the oldest item into `item`; false if there is none. Thread: the consumer.
  [[nodiscard]] bool pop(T& item) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    item = slot(head);
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

 private:
  static constexpr std::size_t kCacheLine = 64;

  T& slot(std::uint64_t index) noexcept { return items_[index & (items_.size() - 1)]; }

  const std::size_t capacity_;
  std::vector<T> items_;  ///< a power of two, so that the counters below may count on for ever
  alignas(kCacheLine) std::atomic<std::uint64_t> head_{0};  ///< items ever removed
  alignas(kCacheLine) std::atomic<std::uint64_t> tail_{0};  ///< items ever appended
  std::uint64_t known_head_ = 0;                            ///< the producer's last look at `head_`
};

}  // namespace lockstep
