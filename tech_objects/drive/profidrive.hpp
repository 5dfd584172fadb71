/// The language of a drive with a PROFIdrive telegram: control and status words, its state machine, and the
/// telegrams 3 and 105 as words. Pure; the cycle's thread.
/// @source PROFIdrive profile, application class 4: general state diagram, standard telegram 3; telegram 105
#pragma once

#include <array>
#include <cstdint>

namespace lockstep {

/// Bits of control word 1. OFF2 and OFF3 act when they are 0.
namespace stw1 {
inline constexpr unsigned kOn = 0;                ///< 0: OFF1, stop on the ramp, then off
inline constexpr unsigned kNoCoastStop = 1;       ///< 0: OFF2, pulses off at once
inline constexpr unsigned kNoQuickStop = 2;       ///< 0: OFF3, stop as quickly as the drive can, then off
inline constexpr unsigned kEnableOperation = 3;   ///< pulses
inline constexpr unsigned kEnableRamp = 4;        ///< of the setpoint
inline constexpr unsigned kUnfreezeRamp = 5;      ///< of the setpoint
inline constexpr unsigned kEnableSetpoint = 6;    ///< 0: setpoint 0
inline constexpr unsigned kAcknowledgeFault = 7;  ///< rising edge
inline constexpr unsigned kControlByPlc = 10;     ///< 0: the words are not valid
}  // namespace stw1

/// Bits of status word 1.
namespace zsw1 {
inline constexpr unsigned kReadyToSwitchOn = 0;
inline constexpr unsigned kReadyForOperation = 1;
inline constexpr unsigned kOperationEnabled = 2;
inline constexpr unsigned kFaultPresent = 3;
inline constexpr unsigned kNoCoastStop = 4;
inline constexpr unsigned kNoQuickStop = 5;
inline constexpr unsigned kSwitchingOnInhibited = 6;
inline constexpr unsigned kControlRequested = 9;
}  // namespace zsw1

/// Bits of the message word MELDW of telegram 105.
namespace meldw {
inline constexpr unsigned kTorqueBelowThreshold = 1;  ///< utilization of the torque limit
}  // namespace meldw

constexpr bool bit_of(std::uint16_t word, unsigned bit) noexcept {
  return (word >> bit & 1u) != 0;
}
constexpr std::uint16_t bit_mask(unsigned bit) noexcept {
  return static_cast<std::uint16_t>(1u << bit);
}

/// Control words that an axis sends.
inline constexpr std::uint16_t kControlOff = 0x047E;        ///< OFF1
inline constexpr std::uint16_t kControlOn = 0x047F;         ///< operation
inline constexpr std::uint16_t kControlCoast = 0x047C;      ///< OFF2
inline constexpr std::uint16_t kControlQuickStop = 0x047A;  ///< OFF3

/// States S1 to S5 of the drive.
class DriveStates {
 public:
  enum class State : std::uint8_t {
    inhibited,    ///< S1: waits for OFF1 without OFF2, OFF3 and fault
    ready,        ///< S2: waits for ON
    switched_on,  ///< S3: waits for the enabling of the pulses
    operation,    ///< S4: follows its setpoint
    ramp_stop,    ///< S5 after OFF1
    quick_stop    ///< S5 after OFF3
  };

  /// Takes a control word; acts at once, through more than one state where all conditions hold.
  void control(std::uint16_t stw1) noexcept;
  /// A fault: the pulses go off, or, with `quick_stop`, the drive stops by itself before. It is kept until it
  /// is acknowledged.
  void fail(bool quick_stop) noexcept;
  /// Whether the cause of a fault is still there, so that it cannot be acknowledged.
  void hold_fault(bool cause) noexcept { cause_ = cause; }
  /// The drive has come to rest on a ramp of its own.
  void stopped() noexcept;

  State state() const noexcept { return state_; }
  bool operation() const noexcept { return state_ == State::operation; }
  bool stopping() const noexcept { return state_ >= State::ramp_stop; }
  /// Whether the motor has torque.
  bool pulses() const noexcept { return state_ >= State::operation; }
  bool fault() const noexcept { return fault_; }
  std::uint16_t zsw1() const noexcept;

 private:
  void advance() noexcept;

  State state_ = State::ready;
  std::uint16_t stw1_ = kControlOff;
  bool fault_ = false;
  bool cause_ = false;
};

/// What goes to the drive in a cycle, in the units of the telegram.
struct TelegramSetpoint {
  std::uint16_t stw1 = 0;
  std::int32_t nsoll_b = 0;  ///< speed setpoint, 16#4000'0000: reference speed
  std::uint16_t stw2 = 0;
  std::uint16_t momred = 0;  ///< 105: torque reduction, 16#4000: by the whole reference torque
  std::uint16_t g1_stw = 0;
  std::int32_t xerr = 0;  ///< 105: control difference in increments of Gx_XIST1, for DSC
  std::int32_t kpc = 0;   ///< 105: gain of position control [1/(1000 s)], for DSC; 0: no DSC
  bool operator==(const TelegramSetpoint&) const = default;
};

/// What comes from the drive.
struct TelegramActual {
  std::uint16_t zsw1 = 0;
  std::int32_t nist_b = 0;
  std::uint16_t zsw2 = 0;
  std::uint16_t meldw = 0;  ///< 105
  std::uint16_t g1_zsw = 0;
  std::uint32_t g1_xist1 = 0;
  std::uint32_t g1_xist2 = 0;
  bool operator==(const TelegramActual&) const = default;
};

using Telegram3Setpoint = std::array<std::uint16_t, 5>;
using Telegram3Actual = std::array<std::uint16_t, 9>;
using Telegram105Setpoint = std::array<std::uint16_t, 10>;
using Telegram105Actual = std::array<std::uint16_t, 10>;

/// Words in the order of the telegram, the high word of a double word first. What a telegram has no space for
/// is lost, and 0 when it is unpacked.
Telegram3Setpoint pack_telegram_3(const TelegramSetpoint& setpoint) noexcept;
Telegram3Actual pack_telegram_3(const TelegramActual& actual) noexcept;
TelegramSetpoint unpack_telegram(const Telegram3Setpoint& words) noexcept;
TelegramActual unpack_telegram(const Telegram3Actual& words) noexcept;
Telegram105Setpoint pack_telegram_105(const TelegramSetpoint& setpoint) noexcept;
Telegram105Actual pack_telegram_105(const TelegramActual& actual) noexcept;
TelegramSetpoint unpack_telegram_105_setpoint(const Telegram105Setpoint& words) noexcept;
TelegramActual unpack_telegram_105_actual(const Telegram105Actual& words) noexcept;

/// A value of a reference as N4: 16#4000'0000 is 100 %; what is beyond ±200 % is cut, NaN is 0.
std::int32_t normalised_32(double value, double reference) noexcept;
double from_normalised_32(std::int32_t word, double reference) noexcept;
/// As N2: 16#4000 is 100 %.
std::int16_t normalised_16(double value, double reference) noexcept;
double from_normalised_16(std::int16_t word, double reference) noexcept;

}  // namespace lockstep
