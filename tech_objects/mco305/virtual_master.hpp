/// The master that a device makes itself: the encoder output, which is its own master input at the same time.
/// @source MCO 305 Design Guide, PULSACC, PULSVEL; SYSVAR 4109, 4110, 4117, 4118
#pragma once

#include <algorithm>
#include <cstdint>

namespace lockstep::mco305 {

/// In whole numbers, so that no count is lost however long it runs. Thread: the cycle.
class VirtualMaster {
 public:
  void set_acceleration(std::int32_t hertz_per_second) noexcept { next_acceleration_ = hertz_per_second; }
  /// From now on with the acceleration that has been set; without one it is switched off at once.
  void set_velocity(std::int32_t hertz) noexcept {
    acceleration_ = next_acceleration_ < 0 ? -std::int64_t{next_acceleration_} : next_acceleration_;
    target_ = std::int64_t{hertz} * 1000;
    active_ = acceleration_ != 0;
    if (!active_) stop();
  }
  void stop() noexcept {
    active_ = false;
    frequency_ = target_ = counts_ = parts_ = 0;
  }
  /// One millisecond. @return what it has moved, 4 counts for each pulse [qc]
  std::int64_t step() noexcept {
    if (!active_) return 0;
    if (frequency_ != target_) return change_speed();
    return advance(counts_, parts_);
  }

  bool active() const noexcept { return active_; }
  std::int64_t frequency() const noexcept { return frequency_; }        ///< [1/1000 Hz]
  std::int64_t target() const noexcept { return target_; }              ///< [1/1000 Hz]
  std::int64_t acceleration() const noexcept { return acceleration_; }  ///< [Hz/s]
  /// What the encoder output has shown since the start [qc], for other devices.
  std::int64_t position() const noexcept { return position_; }

 private:
  static constexpr std::int64_t kParts = 1'000'000;  // of a count

  /// By so many counts and parts of one, 0 … kParts - 1.
  std::int64_t advance(std::int64_t counts, std::int64_t parts) noexcept {
    rest_ += parts;
    if (rest_ >= kParts) {
      rest_ -= kParts;
      ++counts;
    }
    position_ += counts;
    return counts;
  }
  static std::int64_t whole_counts(std::int64_t parts) noexcept {
    return parts / kParts - (parts % kParts < 0 ? 1 : 0);
  }
  /// 4 counts a pulse; in a step that changes the frequency the mean of both ends counts.
  [[gnu::noinline]] std::int64_t change_speed() noexcept {
    const std::int64_t before = frequency_;
    frequency_ += std::clamp(target_ - frequency_, -acceleration_, acceleration_);
    counts_ = whole_counts(4 * frequency_);
    parts_ = 4 * frequency_ - counts_ * kParts;
    const std::int64_t moved = 2 * (before + frequency_), counts = whole_counts(moved);
    return advance(counts, moved - counts * kParts);
  }

  // For the cache: last what only a step that changes the frequency needs.
  bool active_ = false;
  std::int32_t next_acceleration_ = 0;
  std::int64_t position_ = 0, rest_ = 0;     // [qc], [qc/1000000]
  std::int64_t frequency_ = 0, target_ = 0;  // [1/1000 Hz]
  std::int64_t counts_ = 0, parts_ = 0;      // of a step with this frequency, which takes no division to know
  std::int64_t acceleration_ = 0;            // [1/1000 Hz per ms]
};

}  // namespace lockstep::mco305
