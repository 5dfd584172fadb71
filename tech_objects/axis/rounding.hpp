/// What rounding may make of values that are the same.
#pragma once

namespace lockstep {

/// By what positions, distances and velocities may be apart by rounding, relative to their size.
inline constexpr double kRelativeRounding = 1e-12;

}  // namespace lockstep
