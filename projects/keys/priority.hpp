/// Priorities of what runs in Cyclic: programs of the project and those of devices.
#pragma once

namespace lockstep::keys {

inline constexpr int kLowestPriority = 1;
inline constexpr int kHighestPriority = 26;

}  // namespace lockstep::keys
