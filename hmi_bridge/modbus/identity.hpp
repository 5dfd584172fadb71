/// What a Modbus server tells of itself: device identification, function 43/14.
/// @source Modbus application protocol V1.1b3, 6.21
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace lockstep {

/// The objects of the identification; what goes beyond 128 bytes is cut off.
struct ModbusIdentity {
  std::string vendor = "Lockstep";                               ///< object 0
  std::string product_code = "lockstep";                         ///< object 1
  std::string revision = "0";                                    ///< object 2
  std::string product_name = "Lockstep motion-control runtime";  ///< object 4
  std::string application;  ///< object 6: the project's name; empty: left out
};

/// How a request for the identification ends.
struct ModbusIdentification {
  std::uint8_t exception = 0;  ///< 0: none
  std::size_t size = 0;        ///< of the PDU [byte]
};

/// Answers a PDU that begins with function 43 in the basic and regular categories, as a stream and object by
/// object. Exceptions: 1 for a type of encapsulated interface other than 14, 2 for an object that is not
/// there, 3 for another kind of access or a wrong length.
/// @param answer space for 253 bytes
ModbusIdentification identify(const ModbusIdentity& identity, std::span<const std::uint8_t> pdu,
                              std::span<std::uint8_t> answer);

}  // namespace lockstep
