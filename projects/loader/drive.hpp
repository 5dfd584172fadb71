/// Parts of a simulated drive: what it moves, what goes wrong with it, further encoders, and what stands
/// along its way.
#pragma once

#include "projects/loader/loader.hpp"

namespace lockstep {

/// The value of a BOOL tag; nullptr if the key is not given, or names something else, which is reported.
const bool* find_bool_tag(const JsonValue* json, const Loading& loading);

void load_plant(const JsonValue& json, DriveSettings& drive, const Loading& loading);
void load_faults(const JsonValue& json, SimulatedFaults& faults, const Loading& loading);
void load_sensors(const JsonValue& json, Axis& axis, const Loading& loading);
/// Position control begins with an encoder that is there. @param json the drive
void check_operative_sensor(const JsonValue& json, const Axis& axis, const Loading& loading);

/// Keys `zero_marks` and `reference_cam`.
void load_homing_marks(const Fields& fields, MachineSignals& signals, const Loading& loading);
/// These, and all other signals of the machine of a drive.
void load_signals(const Fields& fields, MachineSignals& signals, const Loading& loading);

}  // namespace lockstep
