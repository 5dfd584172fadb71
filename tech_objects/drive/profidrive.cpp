#include "tech_objects/drive/profidrive.hpp"

#include <cmath>

namespace lockstep {
namespace {

constexpr double kFull32 = 1073741824.0;  // 16#4000'0000
constexpr double kFull16 = 16384.0;       // 16#4000

constexpr std::uint16_t high(std::uint32_t word) noexcept {
  return static_cast<std::uint16_t>(word >> 16);
}
constexpr std::uint16_t low(std::uint32_t word) noexcept {
  return static_cast<std::uint16_t>(word);
}
constexpr std::uint32_t joined(std::uint16_t high_word, std::uint16_t low_word) noexcept {
  return static_cast<std::uint32_t>(high_word) << 16 | low_word;
}
constexpr std::int32_t joined_signed(std::uint16_t high_word, std::uint16_t low_word) noexcept {
  return static_cast<std::int32_t>(joined(high_word, low_word));
}
constexpr std::uint32_t bits(std::int32_t word) noexcept {
  return static_cast<std::uint32_t>(word);
}

/// Nearest number of steps within ±2 · full, less one step at the upper end.
double steps(double value, double reference, double full) noexcept {
  const double wanted = std::floor(value / reference * full + 0.5);
  if (wanted >= 2.0 * full) return 2.0 * full - 1.0;
  if (wanted <= -2.0 * full) return -2.0 * full;
  return std::isnan(wanted) ? 0.0 : wanted;
}

}  // namespace

// ---- States
// ------------------------------------------------------------------------------------------------------

void DriveStates::control(std::uint16_t word) noexcept {
  const bool acknowledged = bit_of(word, stw1::kAcknowledgeFault) && !bit_of(stw1_, stw1::kAcknowledgeFault);
  stw1_ = word;
  if (!bit_of(word, stw1::kControlByPlc)) return;
  if (acknowledged && !cause_) fault_ = false;
  advance();
}

void DriveStates::advance() noexcept {
  const bool on = bit_of(stw1_, stw1::kOn);
  const bool coasts = !bit_of(stw1_, stw1::kNoCoastStop);
  const bool stops = !bit_of(stw1_, stw1::kNoQuickStop);
  if (coasts) {
    state_ = State::inhibited;
    return;
  }
  if (stopping()) {
    if (stops || fault_) state_ = State::quick_stop;
    if (state_ == State::ramp_stop && on) state_ = State::operation;  // OFF1 is withdrawn
    return;
  }
  if (state_ == State::operation) {
    if (stops) {
      state_ = State::quick_stop;
    } else if (!on) {
      state_ = State::ramp_stop;
    } else if (!bit_of(stw1_, stw1::kEnableOperation)) {
      state_ = State::switched_on;
    }
    return;
  }
  if (stops || fault_) {
    state_ = State::inhibited;
    return;
  }
  if (state_ == State::inhibited && !on) state_ = State::ready;
  if (state_ == State::ready && on) state_ = State::switched_on;
  if (state_ == State::switched_on && !on) state_ = State::ready;
  if (state_ == State::switched_on && bit_of(stw1_, stw1::kEnableOperation)) state_ = State::operation;
}

void DriveStates::fail(bool quick_stop) noexcept {
  fault_ = true;
  const bool stops = quick_stop && pulses();
  state_ = stops ? State::quick_stop : State::inhibited;
}

void DriveStates::stopped() noexcept {
  if (!stopping()) return;
  const bool ramp = state_ == State::ramp_stop;
  state_ = ramp ? State::ready : State::inhibited;
  if (ramp) advance();
}

std::uint16_t DriveStates::zsw1() const noexcept {
  unsigned word = bit_mask(zsw1::kControlRequested);
  const auto show = [&word](unsigned bit, bool value) {
    if (value) word |= bit_mask(bit);
  };
  show(zsw1::kReadyToSwitchOn, state_ != State::inhibited);
  show(zsw1::kReadyForOperation, state_ >= State::switched_on);
  show(zsw1::kOperationEnabled, state_ == State::operation);
  show(zsw1::kFaultPresent, fault_);
  show(zsw1::kNoCoastStop, bit_of(stw1_, stw1::kNoCoastStop));
  show(zsw1::kNoQuickStop, bit_of(stw1_, stw1::kNoQuickStop) && state_ != State::quick_stop);
  show(zsw1::kSwitchingOnInhibited, state_ == State::inhibited);
  return static_cast<std::uint16_t>(word);
}

// ---- Telegrams
// ---------------------------------------------------------------------------------------------------

Telegram3Setpoint pack_telegram_3(const TelegramSetpoint& s) noexcept {
  return {s.stw1, high(bits(s.nsoll_b)), low(bits(s.nsoll_b)), s.stw2, s.g1_stw};
}

Telegram3Actual pack_telegram_3(const TelegramActual& a) noexcept {
  return {a.zsw1,           high(bits(a.nist_b)), low(bits(a.nist_b)), a.zsw2,         a.g1_zsw,
          high(a.g1_xist1), low(a.g1_xist1),      high(a.g1_xist2),    low(a.g1_xist2)};
}

TelegramSetpoint unpack_telegram(const Telegram3Setpoint& w) noexcept {
  return {.stw1 = w[0], .nsoll_b = joined_signed(w[1], w[2]), .stw2 = w[3], .g1_stw = w[4]};
}

TelegramActual unpack_telegram(const Telegram3Actual& w) noexcept {
  return {.zsw1 = w[0],
          .nist_b = joined_signed(w[1], w[2]),
          .zsw2 = w[3],
          .g1_zsw = w[4],
          .g1_xist1 = joined(w[5], w[6]),
          .g1_xist2 = joined(w[7], w[8])};
}

Telegram105Setpoint pack_telegram_105(const TelegramSetpoint& s) noexcept {
  return {s.stw1,
          high(bits(s.nsoll_b)),
          low(bits(s.nsoll_b)),
          s.stw2,
          s.momred,
          s.g1_stw,
          high(bits(s.xerr)),
          low(bits(s.xerr)),
          high(bits(s.kpc)),
          low(bits(s.kpc))};
}

Telegram105Actual pack_telegram_105(const TelegramActual& a) noexcept {
  return {a.zsw1,   high(bits(a.nist_b)), low(bits(a.nist_b)), a.zsw2,           a.meldw,
          a.g1_zsw, high(a.g1_xist1),     low(a.g1_xist1),     high(a.g1_xist2), low(a.g1_xist2)};
}

TelegramSetpoint unpack_telegram_105_setpoint(const Telegram105Setpoint& w) noexcept {
  return {.stw1 = w[0],
          .nsoll_b = joined_signed(w[1], w[2]),
          .stw2 = w[3],
          .momred = w[4],
          .g1_stw = w[5],
          .xerr = joined_signed(w[6], w[7]),
          .kpc = joined_signed(w[8], w[9])};
}

TelegramActual unpack_telegram_105_actual(const Telegram105Actual& w) noexcept {
  return {.zsw1 = w[0],
          .nist_b = joined_signed(w[1], w[2]),
          .zsw2 = w[3],
          .meldw = w[4],
          .g1_zsw = w[5],
          .g1_xist1 = joined(w[6], w[7]),
          .g1_xist2 = joined(w[8], w[9])};
}

std::int32_t normalised_32(double value, double reference) noexcept {
  return static_cast<std::int32_t>(steps(value, reference, kFull32));
}

double from_normalised_32(std::int32_t word, double reference) noexcept {
  return static_cast<double>(word) / kFull32 * reference;
}

std::int16_t normalised_16(double value, double reference) noexcept {
  return static_cast<std::int16_t>(steps(value, reference, kFull16));
}

double from_normalised_16(std::int16_t word, double reference) noexcept {
  return static_cast<double>(word) / kFull16 * reference;
}

}  // namespace lockstep
