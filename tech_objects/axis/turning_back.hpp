/// Whether an axis stays in front of a place by what it does anyway.
#pragma once

#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/axis/superimposed_motion.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"

namespace lockstep {

/// Whether it comes to rest or turns back within a distance [u] on a side, 1 or -1. @param jerk where nothing
/// is known of the motion to come [u/s³]
bool turns_in_time(int side, double distance, double jerk, AxisMotion motion, const Setpoint& setpoint,
                   const SingleAxisMotion& single, const SuperimposedMotion& superimposed) noexcept;

}  // namespace lockstep
