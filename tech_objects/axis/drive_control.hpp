/// The control words of a drive.
/// @source PROFIdrive state machine
#pragma once

#include <cstdint>
#include <memory>

#include "tech_objects/drive/drive.hpp"
#include "tech_objects/jobs/families.hpp"

namespace lockstep {

/// What an axis tells its drive, with the bits that a program has taken for itself. Thread: the cycle.
class DriveControl {
 public:
  explicit DriveControl(const std::unique_ptr<Drive>& drive) noexcept : drive_(drive) {}

  void send(std::uint16_t stw1) noexcept;

  /// Drives bits of the control words that the axis does not use itself: STW1 8, 9, 11 to 15, STW2 0 to 11.
  /// They stay until the next such job or a restart; with them goes the word that has been sent last.
  ErrorId set_free_bits(const ControlBitsJob& job, bool has_drive) noexcept;
  void release_free_bits() noexcept { free_bits_ = {}; }

 private:
  struct ControlBits {
    std::uint16_t stw1 = 0;
    std::uint16_t stw2 = 0;
  };

  const std::unique_ptr<Drive>& drive_;
  std::uint16_t sent_stw1_ = kControlOff;
  ControlBits free_bits_;  // of MC_SetAxisSTW
};

}  // namespace lockstep
