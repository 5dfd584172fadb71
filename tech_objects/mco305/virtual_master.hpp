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
    if (!active_) frequency_ = target_ = 0;
  }
  void stop() noexcept {
    active_ = false;
    frequency_ = target_ = 0;
  }
  /// One millisecond. @return what it has moved, 4 counts for each pulse [qc]
  std::int64_t step() noexcept {
    if (!active_) return 0;
    constexpr std::int64_t kParts = 1'000'000;
    const std::int64_t before = frequency_;
    if (frequency_ != target_) frequency_ += std::clamp(target_ - frequency_, -acceleration_, acceleration_);
    rest_ += 2 * (before + frequency_);  // 4 counts a pulse, the mean of both ends
    std::int64_t counts = rest_ / kParts;
    rest_ -= counts * kParts;
    if (rest_ < 0) {
      rest_ += kParts;
      --counts;
    }
    position_ += counts;
    return counts;
  }

  bool active() const noexcept { return active_; }
  std::int64_t frequency() const noexcept { return frequency_; }        ///< [1/1000 Hz]
  std::int64_t target() const noexcept { return target_; }              ///< [1/1000 Hz]
  std::int64_t acceleration() const noexcept { return acceleration_; }  ///< [Hz/s]
  /// What the encoder output has shown since the start [qc], for other devices.
  std::int64_t position() const noexcept { return position_; }

 private:
  std::int32_t next_acceleration_ = 0;
  bool active_ = false;
  std::int64_t acceleration_ = 0;            // [1/1000 Hz per ms]
  std::int64_t frequency_ = 0, target_ = 0;  // [1/1000 Hz]
  std::int64_t position_ = 0, rest_ = 0;     // [qc], [qc/1000000]
};

}  // namespace lockstep::mco305
