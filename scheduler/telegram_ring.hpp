/// Crossing of leading value telegrams between the cycle and whoever carries them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/leading_values/telegram.hpp"

namespace lockstep {

/// Telegrams in the order in which they were put in. One thread puts, one takes; neither waits.
class TelegramRing {
 public:
  static constexpr std::size_t kCapacity = 256;

  /// @return false: it is full, the telegram is dropped and counted
  bool put(const LeadingValueTelegram& telegram) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == kCapacity) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    telegrams_[end % kCapacity] = telegram;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// Hands every telegram that is there to `use` and forgets it.
  template <class Use>
  void take(Use use) noexcept {
    const std::size_t end = end_.load(std::memory_order_acquire);
    for (std::size_t i = begin_.load(std::memory_order_relaxed); i != end; ++i)
      use(telegrams_[i % kCapacity]);
    begin_.store(end, std::memory_order_release);
  }

  /// Hands telegrams to `use` up to one that it does not want yet: that and those behind it stay.
  /// @param use gives whether it has taken it
  template <class Use>
  void take_while(Use use) noexcept {
    const std::size_t end = end_.load(std::memory_order_acquire);
    std::size_t i = begin_.load(std::memory_order_relaxed);
    while (i != end && use(telegrams_[i % kCapacity])) ++i;
    begin_.store(i, std::memory_order_release);
  }

  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
  /// The count of those itself. Any thread.
  const std::atomic<std::uint64_t>& drops() const noexcept { return dropped_; }

 private:
  alignas(kCacheLine) std::atomic<std::size_t> begin_{0};
  alignas(kCacheLine) std::atomic<std::size_t> end_{0};
  std::atomic<std::uint64_t> dropped_{0};
  std::array<LeadingValueTelegram, kCapacity> telegrams_{};
};

}  // namespace lockstep
