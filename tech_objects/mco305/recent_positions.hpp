/// Where an axis has been in its last steps, from which its velocity is read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lockstep::mco305 {

/// In qc, one for each step; before the first of them it has been at 0. Thread: the cycle.
class RecentPositions {
 public:
  static constexpr std::size_t kSteps = 256;  ///< that are kept

  /// Where it is in a step, the one behind that of the last call. What has stood for so long that all of
  /// them are the same is not written: an axis at rest leaves the memory alone.
  void keep(std::int64_t step, std::int64_t position) noexcept {
    if (position != last_) {
      last_ = position;
      same_ = 0;
    } else if (same_ == kSteps) {
      return;
    }
    ++same_;
    positions_[static_cast<std::size_t>(step) % kSteps] = position;
  }
  /// It has always been here.
  void fill(std::int64_t position) noexcept {
    positions_.fill(position);
    last_ = position;
    same_ = kSteps;
  }
  /// @param step one of the last, not below 0
  std::int64_t at(std::int64_t step) const noexcept {
    return positions_[static_cast<std::size_t>(step) % kSteps];
  }

 private:
  // What every step needs stands last: its owner goes on with what it needs itself.
  std::array<std::int64_t, kSteps> positions_{};
  std::int64_t last_ = 0;
  std::size_t same_ = kSteps;  // how many of them, the last ones, are `last_`
};

}  // namespace lockstep::mco305
