/// How well an axis follows: whether it is accurate, and how often that has been found so or not.
/// @source MCO 305 Design Guide, SYNCSTAT; 33-13, 33-24, 33-25
#pragma once

#include <cstdint>

namespace lockstep {

class SyncQuality {
 public:
  void clear() noexcept { *this = {}; }
  /// Every step.
  void look(std::int64_t error, std::int64_t window) noexcept {
    accurate_ = (error < 0 ? -error : error) < window;
  }
  /// An evaluation: more than so many accurate ones in a row make it ready, more than so many others a fault.
  void evaluate(std::int64_t ready_count, std::int64_t fault_count) noexcept {
    good_ = accurate_ ? good_ + 1 : 0;
    bad_ = accurate_ ? 0 : bad_ + 1;
    ready_ = good_ > ready_count;
    fault_ = bad_ > fault_count;
  }

  bool accurate() const noexcept { return accurate_; }
  bool ready() const noexcept { return ready_; }
  bool fault() const noexcept { return fault_; }

 private:
  std::int64_t good_ = 0, bad_ = 0;
  bool accurate_ = false, ready_ = false, fault_ = false;  // last what every step writes
};

}  // namespace lockstep
