/// What an axis keeps of what it has shown.
#pragma once

#include <cstdint>

#include "tech_objects/data_blocks/standstill.hpp"

namespace lockstep {

/// The publisher's own: nobody else writes it, but for a restart.
struct ShownBefore {
  static constexpr std::uint8_t kNothing = 0xFF;
  static constexpr std::uint8_t kOperating = 1;  ///< in operation, not disabled

  Standstill standstill;
  double largest_deviation = 0.0;  ///< [u] from the synchronous function
  bool synchronous = false;        ///< it has been
  std::uint8_t drive = kNothing;   ///< of StatusDrive
};

}  // namespace lockstep
