/// Counts of threads outside of the cycle, as tags show them.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace lockstep {

/// A tag that is the sum of some counts. Made at load time; `show` is for the thread of the cycle.
struct ShownCount {
  std::uint64_t* tag = nullptr;
  std::vector<const std::atomic<std::uint64_t>*> counts{};

  void show() const noexcept {
    std::uint64_t sum = 0;
    for (const auto* const count : counts) sum += count->load(std::memory_order_relaxed);
    *tag = sum;
  }
};

}  // namespace lockstep
