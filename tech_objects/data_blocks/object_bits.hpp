/// The bits of the status, error and warning words of technology objects other than axes. What has the same
/// name at an axis stands at the same place there.
/// @source S7-1500/S7-1500T axis functions, and measuring input and output cam functions, tags
#pragma once

#include <initializer_list>

#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep {

/// Bits of the StatusWord of measuring inputs, output cams and cam tracks.
enum class InputOutputBit : std::uint8_t {
  Control = 0,                   ///< the technology object is in operation
  Error = 1,                     ///< an error is pending
  RestartActive = 2,             ///< a restart is active
  OnlineStartValuesChanged = 3,  ///< restart variables were changed
  OutputInverted = 4,            ///< cams: the output is inverted
  CommunicationOK = 5,           ///< the connection to the input or output is up
};

/// Those names of a word that a kind of object has.
constexpr BitNames only(const BitNames& names, std::initializer_list<unsigned> bits) noexcept {
  BitNames result{};
  for (const unsigned bit : bits) result[bit] = names[bit];
  return result;
}

/// The names of a word but those that a kind of object has not.
constexpr BitNames without(BitNames names, std::initializer_list<unsigned> bits) noexcept {
  for (const unsigned bit : bits) names[bit] = {};
  return names;
}

inline constexpr BitNames kEncoderStatusBitNames = only(kStatusBitNames, {0, 1, 2, 3, 5, 6, 7, 11});
inline constexpr BitNames kEncoderErrorBitNames = only(kErrorBitNames, {0, 1, 2, 3, 5, 7, 10, 13, 15});
inline constexpr BitNames kEncoderWarningBitNames = only(kWarningBitNames, {0, 1, 2, 3, 5, 7, 10, 13, 15});

/// Bits of the StatusWord of a leading axis proxy.
enum class ProxyBit : std::uint8_t {
  Control = 0,                   ///< the proxy is in operation
  Error = 1,                     ///< an error is pending
  RestartActive = 2,             ///< a restart is active
  OnlineStartValuesChanged = 3,  ///< restart variables were changed
  LeadingValueValid = 4,         ///< the external leading value is there and valid
  LeadingValueModulo = 5,        ///< the leading value has a modulo function
  LeadingAxisControl = 6,        ///< the leading axis is in setpoint operation, not in follow-up
};
inline constexpr BitNames kProxyStatusBitNames = {"Control",           "Error",
                                                  "RestartActive",     "OnlineStartValuesChanged",
                                                  "LeadingValueValid", "LeadingValueModulo",
                                                  "LeadingAxisControl"};
inline constexpr BitNames kProxyErrorBitNames = only(kErrorBitNames, {0, 1, 2, 3, 7});
inline constexpr BitNames kProxyWarningBitNames = only(kWarningBitNames, {0, 1, 2, 3, 7});

inline constexpr BitNames kCamStatusBitNames = {
    "Control", "Error", "RestartActive", "OnlineStartValuesChanged", "OutputInverted", "CommunicationOK"};
inline constexpr BitNames kMeasuringInputStatusBitNames = only(kCamStatusBitNames, {0, 1, 2, 3, 5});
inline constexpr BitNames kInputOutputErrorBitNames = only(kErrorBitNames, {0, 1, 2, 3, 13});
inline constexpr BitNames kInputOutputWarningBitNames = only(kWarningBitNames, {0, 1, 2, 3, 13});

}  // namespace lockstep
