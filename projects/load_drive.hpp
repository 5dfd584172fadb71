/// What a simulated drive moves, and what goes wrong with it: keys `plant` and `faults` of a drive.
#pragma once

#include "projects/loader.hpp"

namespace lockstep {

void load_plant(const JsonValue& json, SimulatedDriveSettings& drive, const Loading& loading);
void load_faults(const JsonValue& json, SimulatedFaults& faults, const Loading& loading);

}  // namespace lockstep
