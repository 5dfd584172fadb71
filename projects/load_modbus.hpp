/// What the Modbus server and the clients of a project have in common: the shape of an entry.
#pragma once

#include <optional>

#include "hmi_bridge/modbus_map.hpp"
#include "projects/loader.hpp"

namespace lockstep {

/// Reads table, address, type, orders, bit and scale of an entry; whatever is wrong is reported. The rest of
/// the entry is as it begins.
/// @param signal type of its value; none: not known, since its name is faulty; then there is no entry
std::optional<ModbusEntry> read_modbus_shape(const Fields& fields, std::optional<Type> signal,
                                             Problems& problems);

/// Reads the keys of a serial line.
SerialOptions read_serial(const JsonValue& json, Problems& problems);

/// What may be written to a variable from outside: its range, which for an enumeration goes from its first to
/// its last value; for anything else any value.
Range written_range(const Place& place);

/// Reads the clients of the project.
void load_modbus_clients(const JsonValue* clients, const Loading& loading);

}  // namespace lockstep
