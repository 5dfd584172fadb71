/// What an MCO 305 keeps across runs.
#pragma once

#include <cstddef>
#include <vector>

#include "hmi_bridge/retain/kept_value.hpp"
#include "scheduler/mco305/mco305.hpp"

namespace lockstep {

/// Elements of arrays that a device keeps: each is copied at the end of every tick.
inline constexpr std::size_t kMaximumKeptCells = 10'000;

/// Memory of the arrays that the programs of a device save; none if they save none. Once they are compiled.
/// @return how many values there are
std::size_t make_kept_arrays(Mco305& device);

/// Adds what its programs can change for good: application parameters, and what they SAVE.
void keep_mco305(Mco305& device, std::vector<KeptValue>& values);

}  // namespace lockstep
