/// A foreign Modbus client: libmodbus, as an HMI would use it.
#pragma once

#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <memory>

namespace lockstep::test {

class ModbusClient {
 public:
  explicit ModbusClient(int port) : client_(modbus_new_tcp("127.0.0.1", port), &destroy) {
    modbus_set_response_timeout(client_.get(), 20, 0);
    EXPECT_EQ(modbus_connect(client_.get()), 0) << modbus_strerror(errno);
  }

  void write_coil(int address, bool value) {
    EXPECT_EQ(modbus_write_bit(client_.get(), address, value ? 1 : 0), 1) << modbus_strerror(errno);
  }
  void write_register(int address, std::uint16_t value) {
    EXPECT_EQ(modbus_write_register(client_.get(), address, value), 1) << modbus_strerror(errno);
  }
  void write_float(int address, float value) {
    // Most significant word first; the library's own function of this name has its bytes the wrong way round.
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(bits >> 16),
                                             static_cast<std::uint16_t>(bits & 0xFFFF)};
    EXPECT_EQ(modbus_write_registers(client_.get(), address, 2, words.data()), 2) << modbus_strerror(errno);
  }
  bool coil(int address) {
    std::uint8_t bit = 0;
    EXPECT_EQ(modbus_read_bits(client_.get(), address, 1, &bit), 1) << modbus_strerror(errno);
    return bit != 0;
  }
  bool input(int address) {
    std::uint8_t bit = 0;
    EXPECT_EQ(modbus_read_input_bits(client_.get(), address, 1, &bit), 1) << modbus_strerror(errno);
    return bit != 0;
  }
  float holding_float(int address) {
    std::array<std::uint16_t, 2> words{};
    EXPECT_EQ(modbus_read_registers(client_.get(), address, 2, words.data()), 2) << modbus_strerror(errno);
    return modbus_get_float_abcd(words.data());
  }
  float input_float(int address) {
    std::array<std::uint16_t, 2> words{};
    EXPECT_TRUE(read_input_float(address, words)) << modbus_strerror(errno);
    return modbus_get_float_abcd(words.data());
  }
  std::uint32_t input_double_word(int address) {
    std::array<std::uint16_t, 2> words{};
    EXPECT_TRUE(read_input_float(address, words)) << modbus_strerror(errno);
    return std::uint32_t{words[0]} << 16 | words[1];
  }

 private:
  static void destroy(modbus_t* client) {
    modbus_close(client);
    modbus_free(client);
  }
  bool read_input_float(int address, std::array<std::uint16_t, 2>& words) {
    return modbus_read_input_registers(client_.get(), address, 2, words.data()) == 2;
  }
  std::unique_ptr<modbus_t, void (*)(modbus_t*)> client_;
};

}  // namespace lockstep::test
