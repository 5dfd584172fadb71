/// What the operands of an image say of interrupts.
/// @source MCO 305 Design Guide, DISABLE, ENABLE, ON APOS, ON MAPOS, ON MCPOS
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::aposs {

/// What DISABLE and ENABLE name.
enum class InterruptClass : std::uint16_t {
  kAll,
  kInput,
  kPosition,
  kCombit,
  kStatbit,
  kParameter,
  kTime,
  kPeriod
};
inline constexpr std::size_t kInterruptClasses = 8;

/// Position and direction of an ON APOS, ON MAPOS, ON MCPOS: source · 2, and 1 more for the negative
/// direction.
using PositionInterrupt = std::uint16_t;
inline constexpr std::size_t kPositionInterrupts = 6;

}  // namespace lockstep::aposs
