#include "hmi_bridge/modbus/answer.hpp"

#include <modbus.h>

#include <algorithm>
#include <cstddef>

namespace lockstep {
namespace {

constexpr std::uint8_t kRefusal = 0x80;  // bit of a function that was answered with an exception

/// Bytes of the values that a read has asked for; 0 for writes.
std::size_t bytes_read(std::span<const std::uint8_t> asked) noexcept {
  const std::size_t count = std::size_t{asked[4]} << 8 | asked[5];
  switch (asked[1]) {
    case MODBUS_FC_READ_COILS:
    case MODBUS_FC_READ_DISCRETE_INPUTS:
      return (count + 7) / 8;
    case MODBUS_FC_READ_HOLDING_REGISTERS:
    case MODBUS_FC_READ_INPUT_REGISTERS:
      return 2 * count;
    default:
      return 0;
  }
}

}  // namespace

ModbusAnswer judge_answer(std::span<const std::uint8_t> asked, std::span<const std::uint8_t> got) noexcept {
  if (got.size() < 3) return {0, "the answer is too short"};
  if (got[0] != asked[0]) return {0, "the answer is of another unit"};
  const std::uint8_t function = asked[1];
  if (got[1] == (function | kRefusal)) {
    if (got.size() == 3 && got[2] > 0 && got[2] < MODBUS_EXCEPTION_MAX) return {got[2], nullptr};
    return {0, "the answer is an exception that Modbus does not know"};
  }
  if (got[1] != function) return {0, "the answer is one to another function"};
  if (const std::size_t bytes = bytes_read(asked); bytes != 0) {
    if (got.size() == 3 + bytes && got[2] == bytes) return {};
    return {0, "the answer has another number of values"};
  }
  const auto echo = asked.first(function == MODBUS_FC_MASK_WRITE_REGISTER ? 8 : 6);
  if (std::equal(echo.begin(), echo.end(), got.begin(), got.end())) return {};
  return {0, "the answer tells another address, value or number than was written"};
}

}  // namespace lockstep
