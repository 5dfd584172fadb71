/// Whether an answer is one to the request: what the asking side of Modbus takes nobody's word for.
/// @source Modbus application protocol V1.1b3, 6 and 7
#pragma once

#include <cstdint>
#include <span>

namespace lockstep {

/// What came for a request.
struct ModbusAnswer {
  int exception = 0;           ///< code of the exception that the device answered with; 0: none
  const char* flaw = nullptr;  ///< what makes it no answer to this request; nullptr: nothing
};

/// Looks at an answer to a request with one of the functions 1 to 6, 15, 16 and 22. Both begin with the unit
/// and end with their last byte of data. An answer has the unit and the function of its request; values that
/// were read are as many as asked for; a write is told again: one value or mask whole, of several the address
/// and the number. An exception has a code that the standard knows. Any thread.
/// @param asked a whole request, by this program
ModbusAnswer judge_answer(std::span<const std::uint8_t> asked, std::span<const std::uint8_t> got) noexcept;

}  // namespace lockstep
