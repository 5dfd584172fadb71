/// What the Modbus server and the clients of a project have in common: the shape of an entry.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hmi_bridge/modbus/map.hpp"
#include "projects/loader/loader.hpp"

namespace lockstep {

/// Reads table, address, type, orders, bit and scale of an entry; whatever is wrong is reported. The rest of
/// the entry is as it begins.
/// @param signal type of its value; none: not known, since its name is faulty; then there is no entry
std::optional<ModbusEntry> read_modbus_shape(const Fields& fields, std::optional<Type> signal,
                                             const Loading& loading);

/// What an entry shows: a value, or several elements.
struct ModbusSource {
  Operand place;  ///< of the value, or of the first element
  std::optional<ElementPath> elements;

  Type type() const noexcept { return place.signal.value_type(); }
};

/// The value or the elements to which a path leads, or none: then that is reported, unless the problem is
/// known already.
std::optional<ModbusSource> find_modbus_source(const JsonValue& at, std::string_view path,
                                               const Loading& loading);

/// Adds an entry, or one for each element at the addresses that follow, and their signals. What goes beyond
/// the addresses or the signals that there may be is reported.
/// @param shape of the first entry; its signal is not looked at
/// @return how many were added
std::size_t add_modbus_entries(const ModbusEntry& shape, const ModbusSource& source, std::string_view path,
                               const Fields& fields, Problems& problems, std::vector<ModbusEntry>& entries,
                               std::vector<NamedSignal>& signals);

/// Entries of a text: the shape of its first one (none: it is reported), and all of them. The first
/// character of a register is its more significant byte, unless `byte_order` is little.
std::optional<ModbusEntry> read_modbus_text(const Fields& fields, const Loading& loading);
std::size_t add_modbus_text(const ModbusEntry& shape, const StringTag& tag, const Fields& fields,
                            Problems& problems, std::vector<ModbusEntry>& entries,
                            std::vector<NamedSignal>& signals);

/// Adds the entries of what a line shows of a device as a whole: its process data, or its parameters by their
/// numbers.
void add_device_content(const Fields& fields, std::uint32_t line, const Loading& loading,
                        std::vector<ModbusEntry>& entries, std::vector<NamedSignal>& signals);

/// Reports what a map says of its entries, once for each key of the project file.
/// @param places of the entries in the file
void report_modbus_problems(const ModbusMap& map, std::span<const JsonValue* const> places,
                            Problems& problems);

/// Reads the watchdog of a map, or several: each has a heartbeat that a client can write there.
/// @param map nullptr: it is faulty, so that nobody knows what it has
void load_watchdogs(const JsonValue& json, const ModbusMap* map, const Loading& loading);

/// HOST:PORT; none if it is something else, which is reported. @param json may be nullptr
std::optional<Endpoint> read_endpoint(const JsonValue* json, Problems& problems);

/// Reads where the last of the servers is and whom it lets in; the keys of its maps are not looked at.
void load_modbus_place(const JsonValue& json, const Fields& fields, const Loading& loading);

/// Reports a serial line that has more than one user among servers and clients: each would take bytes that
/// are for another.
/// @param serial where the latest of them names it
void report_taken_line(const JsonValue& serial, const ModbusConfig& modbus, const std::string& device,
                       Problems& problems);

/// Narrows the range of an entry to `min` and `max`, which have to lie in what signal and registers hold.
/// @param signal type of its value
void read_modbus_limits(const Fields& fields, ModbusEntry& entry, Type signal, const Loading& loading);

/// What may be written to a variable from outside: its range, which for an enumeration goes from its first to
/// its last value; for anything else any value.
Range written_range(const Operand& place);

/// Reads the clients of the project.
void load_modbus_clients(const JsonValue* clients, const Loading& loading);

}  // namespace lockstep
