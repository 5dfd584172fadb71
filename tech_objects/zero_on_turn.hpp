#pragma once

#include <cstdint>

#include "tech_objects/axis_position.hpp"

namespace lockstep {

/// Where 0 lies on a turn of a ring, whose names may begin behind it.
inline AxisPosition zero_on_turn(std::int64_t turns, const Modulo& modulo) noexcept {
  return {turns, normalised({0, 0.0}, modulo).value};
}

}  // namespace lockstep
