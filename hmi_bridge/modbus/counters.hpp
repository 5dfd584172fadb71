/// What the Modbus server has seen, for the end of a run and for the map itself.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

namespace lockstep {

/// What the server has seen since its construction. Any thread may read.
struct ModbusCounters {
  std::atomic<std::uint64_t> requests{0};      ///< answered, exceptions included
  std::atomic<std::uint64_t> exceptions{0};    ///< answered with an exception
  std::atomic<std::uint64_t> connections{0};   ///< accepted
  std::atomic<std::uint64_t> refused{0};       ///< connections closed at once: too many
  std::atomic<std::uint64_t> not_allowed{0};   ///< connections closed at once: from where none may come
  std::atomic<std::uint64_t> displaced{0};     ///< silent clients whose connection a new one got
  std::atomic<std::uint64_t> malformed{0};     ///< connections closed: not Modbus
  std::atomic<std::uint64_t> stalled{0};       ///< connections closed: owed something for too long
  std::atomic<std::uint64_t> idle{0};          ///< connections closed: asked for nothing for too long
  std::atomic<std::uint64_t> throttled{0};     ///< requests that had to wait for their client's rate
  std::atomic<std::uint64_t> bad_frames{0};    ///< on serial lines: frames with a wrong check or length
  std::atomic<std::uint64_t> broken_lines{0};  ///< times that a serial line broke
  std::atomic<std::uint64_t> faults{0};        ///< internal failures survived
  std::atomic<std::uint64_t> clients{0};       ///< connected now
};

/// A counter of the server.
using ModbusCounter = std::atomic<std::uint64_t> ModbusCounters::*;

/// A counter that a map may show, under its name in the project file.
struct ModbusCounterName {
  std::string_view name;
  ModbusCounter counter;
};

inline constexpr ModbusCounterName kModbusCounters[] = {{"requests", &ModbusCounters::requests},
                                                        {"exceptions", &ModbusCounters::exceptions},
                                                        {"connections", &ModbusCounters::connections},
                                                        {"refused", &ModbusCounters::refused},
                                                        {"not_allowed", &ModbusCounters::not_allowed},
                                                        {"displaced", &ModbusCounters::displaced},
                                                        {"malformed", &ModbusCounters::malformed},
                                                        {"stalled", &ModbusCounters::stalled},
                                                        {"idle", &ModbusCounters::idle},
                                                        {"throttled", &ModbusCounters::throttled},
                                                        {"bad_frames", &ModbusCounters::bad_frames},
                                                        {"broken_lines", &ModbusCounters::broken_lines},
                                                        {"clients", &ModbusCounters::clients}};

}  // namespace lockstep
