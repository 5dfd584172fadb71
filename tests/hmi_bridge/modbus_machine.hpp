/// A few tags with a Modbus map and an image, for the tests of the server.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hmi_bridge/modbus/map.hpp"
#include "scheduler/process_image.hpp"

namespace lockstep {

/// The addresses stand beside the tags. `w` can be written.
struct ModbusMachine {
  ModbusMachine() : map{lines(), types()}, image(signals) {}

  BOOL start = false;                    // coil 0 w
  BOOL shown = true;                     // coil 1
  std::array<bool, 2000> lamps{};        // coils 1000… w
  BOOL synced = true;                    // discrete input 0
  LREAL speed = 200.0;                   // holding registers 10, 11 w, as REAL
  LINT count = 0;                        // 20…23 w
  WORD word{0x0F0F};                     // 30 w; bit 4: coil 2 w
  SINT small = -3;                       // 31 w
  INT locked = 77;                       // 32
  REAL rounded = 0.0F;                   // 40…43 w, as LREAL
  std::array<std::int16_t, 130> row{};   // 200… w
  LREAL position = 0.0;                  // input registers 0, 1, as REAL
  std::array<std::uint64_t, 4> turns{};  // input registers 100…115

  std::vector<Signal> signals;
  std::vector<ModbusEntry> entries;
  ModbusMap map;
  ProcessImage image;

  void tick() {
    image.take_writes();
    image.publish(++ticks_);
  }

 private:
  std::vector<ModbusEntry> lines() {
    add(&start, Type::BOOL, ModbusTable::coil, 0, Type::BOOL, true);
    add(&shown, Type::BOOL, ModbusTable::coil, 1, Type::BOOL, false);
    for (std::uint32_t i = 0; i < lamps.size(); ++i)
      add(&lamps[i], Type::BOOL, ModbusTable::coil, 1000 + i, Type::BOOL, true);
    add(&synced, Type::BOOL, ModbusTable::discrete_input, 0, Type::BOOL, false);
    add(&speed, Type::LREAL, ModbusTable::holding_register, 10, Type::REAL, true);
    add(&count, Type::LINT, ModbusTable::holding_register, 20, Type::LINT, true);
    add(&word, Type::WORD, ModbusTable::holding_register, 30, Type::WORD, true);
    add(&word, Type::WORD, ModbusTable::coil, 2, Type::BOOL, true, 4);
    add(&small, Type::SINT, ModbusTable::holding_register, 31, Type::SINT, true);
    add(&locked, Type::INT, ModbusTable::holding_register, 32, Type::INT, false);
    add(&rounded, Type::REAL, ModbusTable::holding_register, 40, Type::LREAL, true);
    for (std::uint32_t i = 0; i < row.size(); ++i)
      add(&row[i], Type::INT, ModbusTable::holding_register, 200 + i, Type::INT, true);
    add(&position, Type::LREAL, ModbusTable::input_register, 0, Type::REAL, false);
    for (std::uint32_t i = 0; i < turns.size(); ++i)
      add(&turns[i], Type::ULINT, ModbusTable::input_register, 100 + 4 * i, Type::ULINT, false);
    return entries;
  }

  std::vector<Type> types() const {
    std::vector<Type> result;
    for (const Signal& signal : signals) result.push_back(signal.value_type());
    return result;
  }

  void add(void* tag, Type type, ModbusTable table, std::uint32_t address, Type wire, bool writable,
           std::int8_t bit = -1) {
    entries.push_back(
        {static_cast<std::uint32_t>(signals.size()), table, address, wire, WordOrder::big, writable, kAny});
    signals.push_back({tag, type, bit});
  }

  std::int64_t ticks_ = -1;
};

}  // namespace lockstep
