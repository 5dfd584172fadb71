/// The distance to the target of MC_MoveAbsolute.
#pragma once

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/jobs/families.hpp"

namespace lockstep {

/// From a position to the target of the job [u]; on a ring in its direction, or the shortest one.
double absolute_distance(const MoveAbsoluteJob& job, double here, const Modulo& modulo) noexcept;

/// From a setpoint, at which the motion begins, to the target of the job [u]; on a ring in its direction, or
/// the shortest one. In a direction that is asked for it goes on to the pass of the target that the axis can
/// still come to rest at: turning back would be the other direction.
/// @param beyond_target distance that the axis has made since the target of the motion before, from which a
/// motion that blends counts [u]
DoubleDouble absolute_distance(const MoveAbsoluteJob& job, const Setpoint& from, DoubleDouble beyond_target,
                               const Dynamics& dynamics, const Modulo& modulo) noexcept;

/// On a ring the turn of a given position is the one on which it is next to where the axis is.
AxisPosition next_to(AxisPosition here, double position, const Modulo& modulo) noexcept;

}  // namespace lockstep
