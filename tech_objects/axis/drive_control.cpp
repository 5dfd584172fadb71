#include "tech_objects/axis/drive_control.hpp"

namespace lockstep {
namespace {

// Bits of the control words that an axis does not use itself.
constexpr std::uint16_t kFreeBits1 = 0xFB00;
constexpr std::uint16_t kFreeBits2 = 0x0FFF;

}  // namespace

void DriveControl::send(std::uint16_t stw1) noexcept {
  const std::uint16_t free = free_bits_.stw1;
  drive_->control(static_cast<std::uint16_t>(stw1 | free), free_bits_.stw2);
  sent_stw1_ = stw1;
}

ErrorId DriveControl::set_free_bits(const ControlBitsJob& job, bool has_drive) noexcept {
  const auto mask1 = static_cast<std::uint16_t>(job.stw1_mask);
  const auto mask2 = static_cast<std::uint16_t>(job.stw2_mask);
  if ((mask1 & ~kFreeBits1) != 0 || (mask2 & ~kFreeBits2) != 0) return ErrorId::control_bits;
  if (!has_drive) return ErrorId::unspecified;
  const auto changed = [](std::uint16_t word, WORD bits, std::uint16_t mask) {
    return static_cast<std::uint16_t>((word & ~mask) | (static_cast<std::uint16_t>(bits) & mask));
  };
  free_bits_.stw1 = changed(free_bits_.stw1, job.stw1, mask1);
  free_bits_.stw2 = changed(free_bits_.stw2, job.stw2, mask2);
  send(sent_stw1_);
  return ErrorId::none;
}

}  // namespace lockstep
