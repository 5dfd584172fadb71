/// Threads that help the cycle with what can be done side by side.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include "tech_objects/arithmetic/cache_line.hpp"

namespace lockstep {

/// A crew takes portions of a piece of work together with the thread of the cycle: each thread first those of
/// its own share, the same at each tick, then what is left of the others'. The thread of the cycle waits for
/// nobody who has not begun: who comes late finds less to do, and if nobody comes it does all by itself.
///
/// Between two pieces of work the helpers stay awake for some microseconds, then they sleep; waking them is
/// one system call of the cycle, which does not wait for them either.
class Crew {
 public:
  /// Does the items `begin` to `end`, without `end`, of a piece of work. Neither throws nor waits.
  using Work = void (*)(void* context, std::size_t begin, std::size_t end) noexcept;

  /// Items that are taken at a time.
  static constexpr std::size_t kPortion = 32;
  /// Items in a piece of work, at most.
  static constexpr std::size_t kMaximumItems = (std::size_t{1} << 24) - 1;

  /// Load time. @param helpers threads beside that of the cycle, at least 1
  /// @throws std::system_error if a thread cannot be started
  explicit Crew(int helpers);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// The pieces of work from here to `rest` follow each other closely. Thread: the cycle, as for those below.
  void wake() noexcept;
  void rest() noexcept;

  /// Has `count` items done, portion by portion; all are done when it returns, and
  /// seen by the calling thread. Between `wake` and `rest`.
  void share(std::size_t count, Work work, void* context) noexcept;

  /// The helpers, to give them a priority and a processor.
  std::vector<pthread_t> threads();

 private:
  /// What each thread does first, so that it finds in its cache what it had there at the last tick.
  struct alignas(kCacheLine) Share {
    // The number of the piece of work, and the item behind those that have been taken: the highest, between
    // two pieces. Who takes some by compare and exchange has read what belongs to that number.
    std::atomic<std::uint64_t> offer{kMaximumItems};
  };

  void help(std::size_t own) noexcept;
  bool take_portion(std::size_t own) noexcept;
  bool take_portion_of(std::size_t share, std::uint64_t number) noexcept;
  /// The first item of a share; whole portions, and the last share has the rest.
  std::size_t begin_of(std::size_t share, std::size_t count) const noexcept;

  std::vector<Share> shares_;  // the first one is the cycle's
  std::uint64_t number_ = 0;   // of the piece of work
  alignas(kCacheLine) std::atomic<std::size_t> count_{0};
  std::atomic<Work> work_{nullptr};
  std::atomic<void*> context_{nullptr};
  alignas(kCacheLine) std::atomic<std::size_t> done_{0};
  alignas(kCacheLine) std::atomic<std::uint32_t> call_{0};  // odd while work may be offered
  std::atomic<bool> ending_{false};
  std::vector<std::thread> helpers_;
};

}  // namespace lockstep
