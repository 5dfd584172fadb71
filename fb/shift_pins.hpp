/// What the pins of leading and following value offsets have in common.
#pragma once

#include <limits>

#include "fb/pin.hpp"

namespace lockstep::shift_pins {

inline constexpr Choice kPhasingProfiles[] = {
    {0, "with dynamic parameters"},
    {1, "over leading value distance, from the current leading position"},
    {2, "over leading value distance, from StartPosition"},
    {5, "only cancel a waiting job"}};
inline constexpr Choice kOffsetProfiles[] = {
    {1, "over leading value distance, from the current leading position"},
    {2, "over leading value distance, from StartPosition"},
    {5, "only cancel a waiting job"}};
inline constexpr Choice kDirections[] = {{1, "while the leading value moves in positive direction"},
                                         {2, "while the leading value moves in negative direction"},
                                         {3, "in the current direction of the leading value"}};
inline constexpr Range kPositive{std::numeric_limits<double>::min(), kFinite.highest};

/// Whether a profile is made over a leading distance.
constexpr bool over_distance(DINT profile) noexcept {
  return profile == 1 || profile == 2;
}

}  // namespace lockstep::shift_pins
