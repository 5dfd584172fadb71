/// The keys of Modbus: servers, their maps, and foreign devices.
#pragma once

#include "hmi_bridge/modbus/map.hpp"
#include "hmi_bridge/modbus/options.hpp"
#include "projects/json/addresses.hpp"
#include "projects/json/key.hpp"

namespace lockstep::keys {

inline constexpr double kMilli = 1e6, kSecond = 1e9, kMinute = 60e9, kHour = 3600e9, kDay = 86400e9;  // [ns]

template <class E>
constexpr Word word_for(std::string_view word, E value) {
  return {word, static_cast<std::int64_t>(value)};
}

inline constexpr Word kTables[] = {word_for("coil", ModbusTable::coil),
                                   word_for("discrete_input", ModbusTable::discrete_input),
                                   word_for("input_register", ModbusTable::input_register),
                                   word_for("holding_register", ModbusTable::holding_register)};
inline constexpr Word kWordOrders[] = {word_for("big", WordOrder::big),
                                       word_for("little", WordOrder::little)};
inline constexpr Word kByteOrders[] = {word_for("big", ByteOrder::big),
                                       word_for("little", ByteOrder::little)};
inline constexpr Word kParities[] = {word_for("none", Parity::none), word_for("even", Parity::even),
                                     word_for("odd", Parity::odd)};
inline constexpr Word kAccesses[] = {{"read", 0}, {"write", 1}};

inline constexpr auto kMapTable = key::word<&ModbusEntry::table>("table", kTables, "table of Modbus");
inline constexpr auto kTable = kMapTable.needed();
inline constexpr auto kAddress =
    key::integer<&ModbusEntry::address>("address", {0, 65535},
                                        "zero-based address of the first register or of the bit")
        .needed();
inline constexpr auto kWireType = key::defined("type", "tag_type_of_values", "elementary type",
                                               "type on the wire; it may narrow that of the signal")
                                      .otherwise_is("the type of the signal");
inline constexpr auto kWordOrder =
    key::word<&ModbusEntry::word_order>("word_order", kWordOrders, "big: most significant register first");
inline constexpr auto kByteOrder = key::word<&ModbusEntry::byte_order>(
    "byte_order", kByteOrders, "big: more significant byte of a register first");
inline constexpr auto kBit = key::integer<&ModbusEntry::bit>(
                                 "bit", {0, 15}, "a BOOL as this bit of a register, which several may share")
                                 .otherwise_is("the value fills its registers");
inline constexpr auto kScale = key::number<&ModbusEntry::scale>(
    "scale", kNotZero, "", "of a REAL or LREAL as an integer: value = integer * scale + offset");
inline constexpr auto kOffset = key::number<&ModbusEntry::offset>("offset", kFinite, "", "see scale");
/// What entries of maps and of devices have in common.
inline constexpr auto kEntryShape =
    key_table<ModbusEntry>(kTable, kAddress, kWireType, kWordOrder, kByteOrder, kBit, kScale, kOffset);

/// What a line of a map may show of a device as a whole.
enum class DeviceContent : std::uint8_t { process_data, parameters };

inline constexpr Word kGaps[] = {{"refused", 0}, {"zero", 1}};
inline constexpr auto kGapsKey =
    key::word(
        "gaps", kGaps,
        "a read of addresses without an entry, between entries of a table: refused with exception 2, or "
        "zero")
        .otherwise_is("refused");

inline constexpr Word kContents[] = {word_for("pcd", DeviceContent::process_data),
                                     word_for("parameters", DeviceContent::parameters)};
inline constexpr auto kMapEntry = key_table<ModbusEntry>(
    key::signal(
        "tag",
        "signal: tag (a text: two characters in a register), instance.Pin or Object.Variable; elements of "
        "an array side by side: array, array[*], array[2..5]"),
    key::text("diagnostic",
              "in place of a tag: a number of the run, such as ticks, overruns, alarms, refused"),
    key::object("object", static_cast<ObjectKinds>(ObjectKind::MCO_305),
                "in place of a tag: device whose 'content' stands from 'address' on"),
    key::word(
        "content", kContents,
        "of that device. pcd: ten words that come as holding registers, ten that go as input registers; "
        "parameters: parameter gg-nn as 32 bits in holding registers at address + 10 * ggnn, so 33-17 at "
        "33170; what a program may not set cannot be written"),
    kMapTable.otherwise_is("what 'content' has; else it is needed"), kAddress, kWireType, kWordOrder,
    kByteOrder, kBit, kScale, kOffset,
    key::word("access", kAccesses, "whether a client may write")
        .otherwise_is("write for a tag in coils and holding registers, else read"),
    key::number(
        "min", kFinite, "",
        "lowest value that a client may write, in the unit of the signal (TIME: s); below it exception "
        "3, and nothing of the request is written")
        .otherwise_is("what the signal holds"),
    key::number("max", kFinite, "", "highest value that a client may write, see min")
        .otherwise_is("what the signal holds"));

inline constexpr auto kWatchdog = key_table<void>(
    key::signal("tag",
                "heartbeat: a tag of the map that a client writes; a change of its value is a sign of life")
        .needed(),
    key::duration("timeout", {1e3, kDay},
                  "without a sign of life after which there is silence; a servo cycle at least")
        .needed(),
    key::constant("set", "tag: value, written in every tick while there is silence").named(),
    key::tag("status", "BOOL tag: there is silence"));
inline constexpr auto kWatchdogKey =
    key::structure("watchdog", kWatchdog, "what is done when a client that writes falls silent")
        .one_or_list()
        .defined_as("modbus_watchdog");

constexpr auto map_key(std::string_view text) {
  return key::structure("map", kMapEntry, text).list().defined_as("modbus_entry");
}
inline constexpr auto kUnit =
    key_table<void>(key::integer("unit", {0, 255}, "unit id").needed(),
                    map_key("which signal stands where").needed(), kGapsKey, kWatchdogKey);
inline constexpr auto kUnitsKey =
    key::structure("units", kUnit, "maps of single unit ids in place of the one for all").list();

inline constexpr auto kSerial = key_table<SerialOptions>(
    key::title<&SerialOptions::device>("device", "serial line, such as /dev/ttyS0").needed(),
    key::one_of<&SerialOptions::baud>("baud", kBauds, "bits per second"),
    key::word<&SerialOptions::parity>("parity", kParities, "of a character"),
    key::integer<&SerialOptions::stop_bits>("stop_bits", {1, 2}, "of a character"),
    key::duration<&SerialOptions::silence>("silence", {100e3, kSecond}, "that ends a frame")
        .otherwise_is("3.5 characters and at least 1.75 ms"));

inline constexpr auto kServer = key_table<ModbusServerOptions>(
    key::text("listen", "where it listens, such as 127.0.0.1:1502 or [::1]:1502; a server has it or 'serial'")
        .of_form(kEndpointForm)
        .one_or_list(),
    key::structure<&ModbusServerOptions::serial>("serial", kSerial,
                                                 "RTU over a serial line, in place of listen"),
    key::integer<&ModbusServerOptions::serial_unit>("unit", {1, 247}, "own address on the serial line"),
    key::text("allow", "from which clients may come, such as 192.168.1.0/24")
        .of_form(kNetworkForm)
        .list()
        .otherwise_is("from everywhere"),
    key::integer<&ModbusServerOptions::max_clients>("max_clients", {1, 1000}, "connected at the same time"),
    key::integer<&ModbusServerOptions::requests_per_second>("max_requests_per_second", {1, 1e6},
                                                            "of one client; what is more waits")
        .otherwise_is("as many as it likes"),
    key::integer<&ModbusServerOptions::max_clients_per_address>("max_clients_per_address", {1, 1000},
                                                                "of them from one address")
        .otherwise_is("three quarters of max_clients"),
    key::duration<&ModbusServerOptions::idle_limit>(
        "idle_timeout", {kSecond, kDay}, "a client that asks for nothing for this long is disconnected")
        .otherwise_is("never"),
    map_key("a map of its own in place of the common one"), kGapsKey, kWatchdogKey, kUnitsKey);

inline constexpr auto kDeviceEntry = key_table<ModbusEntry>(
    key::signal("tag", "tag or variable, or elements of an array as in a map").needed(), kTable, kAddress,
    kWireType, kWordOrder, kByteOrder, kBit, kScale, kOffset,
    key::tag("quality", "BOOL tag: this entry went well in the last cycle"),
    key::tag("age", "TIME tag: since the last cycle in which it did", Type::TIME));
inline constexpr auto kDevice = key_table<ModbusDevice>(
    key::title<&ModbusDevice::name>("name", "for messages").needed(),
    key::integer("unit", {0, 255}, "unit id: 0 to 247, 255; on a serial line 1 to 247").otherwise_is("1"),
    key::duration<&ModbusDevice::cycle>("cycle", {kMilli, kHour}, "how often it is read and written")
        .needed(),
    key::tag("quality", "BOOL tag: the last cycle went well"),
    key::tag("age", "TIME tag: since the last cycle that went well", Type::TIME),
    key::structure("read", kDeviceEntry, "from the device into tags").list(),
    key::structure("write", kDeviceEntry, "from tags and variables to the device").list());
inline constexpr auto kClient = key_table<ModbusClientOptions>(
    key::text("connect", "of the device or gateway, such as 10.0.0.5:502; a client has it or 'serial'")
        .of_form(kEndpointForm),
    key::structure<&ModbusClientOptions::serial>("serial", kSerial,
                                                 "RTU over a serial line, in place of connect"),
    key::duration<&ModbusClientOptions::timeout>("timeout", {kMilli, kMinute},
                                                 "for connecting and for each answer"),
    key::structure("devices", kDevice, "devices behind this connection").list().needed());

inline constexpr auto kModbus =
    key_table<void>(key::structure("server", kServer, "where clients may ask").one_or_list(),
                    map_key("which signal stands where"), kGapsKey, kWatchdogKey, kUnitsKey,
                    key::structure("clients", kClient, "foreign devices").list());

}  // namespace lockstep::keys
