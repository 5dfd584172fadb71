/// The outputs that OUTB switches.
/// @source MCO 305 Design Guide, OUTB
#pragma once

#include <cstdint>
#include <span>

namespace lockstep::aposs {

inline constexpr std::int32_t kOptionOutputs[] = {1, 2, 3, 4, 5, 6, 7, 8};
inline constexpr std::int32_t kDriveOutputs[] = {27, 29};

/// Those of a byte, that of the lowest bit first: 0, of the option; 1, of the drive. None for any other.
constexpr std::span<const std::int32_t> outputs_of_byte(std::int32_t number) noexcept {
  if (number == 0) return kOptionOutputs;
  if (number == 1) return kDriveOutputs;
  return {};
}

}  // namespace lockstep::aposs
