/// What a technology object notes of its alarms, for a list with their times; the data block shows one at a
/// time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/alarms/detail.hpp"

namespace lockstep {

/// An alarm that has come, or the acknowledgement of all.
struct AlarmNote {
  std::int16_t number = 0;    ///< 0: all alarms of the object have been acknowledged
  std::int16_t reaction = 0;  ///< value of ErrorDetail.Reaction; 0: none
  AlarmDetail detail;
};

/// An alarm is noted when it comes, not again while it is pending. Notes wait until they are taken; what does
/// not fit any more is counted. Thread: the cycle.
class AlarmNotes {
 public:
  void raised(int number, int reaction, const AlarmDetail& detail = {}) noexcept {
    for (std::size_t i = 0; i < pending_count_; ++i)
      if (pending_[i] == number) return;
    if (pending_count_ < pending_.size()) pending_[pending_count_++] = static_cast<std::int16_t>(number);
    note({static_cast<std::int16_t>(number), static_cast<std::int16_t>(reaction), detail});
  }
  /// Noted if an alarm was pending.
  void acknowledged() noexcept {
    if (pending_count_ == 0) return;
    pending_count_ = 0;
    note({});
  }

  bool any() const noexcept { return count_ != 0; }
  std::uint32_t lost() const noexcept { return lost_; }

  /// Hands each note to `give`, in their order, and forgets them.
  template <class Give>
  void take(Give give) noexcept {
    for (std::size_t i = 0; i < count_; ++i) give(notes_[i]);
    count_ = 0;
  }

 private:
  void note(AlarmNote what) noexcept {
    if (count_ == notes_.size()) {
      ++lost_;
      return;
    }
    notes_[count_++] = what;
  }

  std::array<AlarmNote, 8> notes_{};
  std::array<std::int16_t, 16> pending_{};
  std::uint8_t count_ = 0;
  std::uint8_t pending_count_ = 0;
  std::uint32_t lost_ = 0;
};

}  // namespace lockstep
