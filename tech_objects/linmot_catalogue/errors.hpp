/// Errors and warnings of a LinMot controller: what each interface calls them.
/// @source LinMot release 1.3 addendum, 6.2, 6.4, 8.7, appendix B
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::linmot {

/// Bits of the errors and warnings of a motor (ASCII EE, EW), and of the controller (GE, GW).
namespace motor_bit {
inline constexpr std::uint16_t kHotCalculated = 1u << 0, kHotSensor = 1u << 1, kFollowingError = 1u << 2,
                               kSliderMissing = 1u << 3, kSlave = 1u << 4, kInitFailed = 1u << 5,
                               kTypeMismatch = 1u << 6, kCurve = 1u << 7;
inline constexpr std::uint16_t kInitNotDone = 1u << 6, kPositionRange = 1u << 8;  // warnings
}  // namespace motor_bit
namespace system_bit {
inline constexpr std::uint16_t kPowerLow = 1u << 1, kPowerHigh = 1u << 2, kSignalLow = 1u << 3,
                               kSignalHigh = 1u << 4, kElectronics = 1u << 5;
inline constexpr std::uint16_t kEmergencyStop = 1u << 14;  // a warning
inline constexpr std::uint16_t kApplication = 1u << 15;    // an error
inline constexpr std::uint16_t kRefused = 1u << 15;  // of what is logged: something could not be carried out
}  // namespace system_bit

struct ErrorRow {
  std::string_view name;
  bool of_motor;
  int ascii;              ///< number of status E…; 0: none
  int bit;                ///< of EE or GE; -1: none
  int diagnosis_bit;      ///< of PROFIBUS; -1: none
  std::uint16_t code;     ///< shown by version 3; of a motor 16#0x00 is added for motor x; 0: none
  std::string_view mask;  ///< of the mask that lets it pass; empty: it always does
  std::string_view text;
};
std::span<const ErrorRow> errors() noexcept;

struct WarningRow {
  std::string_view name;
  int motor_bit;      ///< of EW; -1: none
  int system_bit;     ///< of GW; -1: none
  int diagnosis_bit;  ///< of PROFIBUS, of the motor if it is one of a motor
  std::string_view text;
};
std::span<const WarningRow> warnings() noexcept;

/// What a command line is answered with instead of its result.
struct AnswerCode {
  int code;  ///< 50 to 68
  std::string_view text;
};
std::span<const AnswerCode> answer_codes() noexcept;

inline constexpr std::uint16_t kDataOutOfRange = 0x8002;  ///< shown code of PROFIBUS

}  // namespace lockstep::linmot
