/// What a signal was lately: minimum and maximum values of short times.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace lockstep::cli {

/// A ring of minimum and maximum values, each over `kSlot` of the time of the run. Any one thread.
class History {
 public:
  static constexpr std::int64_t kSlot = 100'000'000;  ///< [ns]
  static constexpr std::size_t kSlots = 600;          ///< a minute

  /// Minimum and maximum value of a time.
  struct Span {
    double minimum;
    double maximum;
  };

  /// Takes a value; one that is not finite leaves no mark. A time before the last one begins anew: it is
  /// another run. @param t of the run [ns], ≥ 0
  void add(std::int64_t t, double value);
  /// The last `window` [ns] in so many parts, oldest first; none where nothing has come.
  std::vector<std::optional<Span>> parts(std::int64_t window, std::size_t count) const;
  /// Over the last `window`; none where nothing has come.
  std::optional<Span> whole(std::int64_t window) const;

 private:
  struct Slot {
    std::int64_t number = -1;  // of the time; -1: nothing yet
    Span span{};
  };
  std::vector<Slot> slots_;
  std::int64_t last_ = -1;  // number of the newest slot
};

}  // namespace lockstep::cli
