/// The unit of the velocities of an axis, in words.
#pragma once

#include <string_view>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// "u/s"; of a speed axis as its Units.VelocityUnit has it: "1/s", "1/min", "1/h". Any thread, once the axis
/// has its start values.
std::string_view velocity_unit_text(const Axis& axis) noexcept;

}  // namespace lockstep
