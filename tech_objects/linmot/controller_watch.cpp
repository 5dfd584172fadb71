// What a controller watches: supplies, electronics, motors; what becomes an error, a warning, an entry of
// what is logged.
#include <cmath>

#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot_catalogue/errors.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {

using namespace linmot;

void LinMotController::watch_supplies(std::uint16_t& causes, std::uint16_t& warnings) noexcept {
  const auto look = [&](const LREAL* voltage, const SupplyThresholds& at, std::uint16_t low,
                        std::uint16_t high) {
    if (voltage == nullptr) return;
    // What is no number is no voltage.
    if (!(*voltage >= at.low_warning)) warnings |= low;
    if (!(*voltage >= at.low_error)) causes |= low;
    if (*voltage > at.high_warning) warnings |= high;
    if (*voltage > at.high_error) causes |= high;
  };
  look(wiring.power_voltage, hardware->power, system_bit::kPowerLow, system_bit::kPowerHigh);
  look(wiring.signal_voltage, hardware->signal, system_bit::kSignalLow, system_bit::kSignalHigh);
  constexpr double kHotTime = 5.0;  // [s] after which the warning is an error
  const bool hot = is_on(wiring.heat_sink_hot);
  hot_ticks_ = hot ? hot_ticks_ + 1 : 0;
  if (hot) warnings |= system_bit::kElectronics;
  if (hot && (hot_ticks_ - 1) * tick_ >= kHotTime - 1e-9) causes |= system_bit::kElectronics;
}

std::uint16_t LinMotController::system_warning_masks() const noexcept {
  const SystemParameters& system = data.Parameters;
  std::uint16_t masks = system_bit::kEmergencyStop;
  if (system.warn_mask_dclv_power_low) masks |= system_bit::kPowerLow;
  if (system.warn_mask_dclv_power_high) masks |= system_bit::kPowerHigh;
  if (system.warn_mask_dclv_signal_low) masks |= system_bit::kSignalLow;
  if (system.warn_mask_dclv_signal_high) masks |= system_bit::kSignalHigh;
  if (system.warn_mask_electronic_fault) masks |= system_bit::kElectronics;
  return masks;
}

void LinMotController::watch_system() noexcept {
  std::uint16_t causes = 0, warnings = 0;
  if (watches_supplies_) watch_supplies(causes, warnings);
  if (state_ == State::stop) warnings |= system_bit::kEmergencyStop;
  if (out_of_range_) causes |= system_bit::kApplication;
  system_causes_ = causes;
  system_errors_ |= causes;
  if (warnings != 0) warnings &= system_warning_masks();
  system_warnings_ = warnings;
}

std::uint16_t LinMotController::sensors_of(std::size_t index) const noexcept {
  const MotorSettings& settings = motor_settings[index];
  std::uint16_t conditions = 0;
  if (is_on(settings.slider_missing)) conditions |= motor_bit::kSliderMissing;
  if (is_on(settings.too_hot)) conditions |= motor_bit::kHotSensor;
  return conditions;
}

/// @param conditions that its sensors tell, as bits  @param follows its following error is within its limits
std::uint16_t LinMotController::causes_of(std::size_t index, std::uint16_t conditions,
                                          bool follows) const noexcept {
  const Motor& motor = motors_[index];
  const Watched& watched = watched_[index];
  std::uint16_t causes = conditions | watched.always;
  if (state_ != State::error && (curve_missing_[index] || motor.curve_missing())) causes |= motor_bit::kCurve;
  if (motor.heat() > motor_settings[index].thermal.error)
    causes |= motor_bit::kHotCalculated & watched.error_mask;
  if (state_ != State::init)
    return follows ? causes : causes | (motor_bit::kFollowingError & watched.error_mask);
  if (motor.homing() == Motor::Homing::failed || !follows) causes |= motor_bit::kInitFailed;
  return causes;
}

/// What a motor mostly is: homed, within its limits, without anything else that could tell.
void LinMotController::watch_motor(std::size_t index, Together& together) noexcept {
  const Motor& motor = motors_[index];
  const MotorParameters& parameters = taken_[index];
  const double error = motor.following_error(), actual = motor.actual();
  const bool follows = !motor.energised() || (error <= parameters.following_error_plus &&
                                              error >= -parameters.following_error_minus);
  const bool outside = actual < parameters.pos_range_min || actual > parameters.pos_range_max;
  if (follows && motor.homed() && !outside && watched_[index].only_motion && state_ != State::init &&
      !curve_missing_[index] && !motor.curve_missing()) {
    data.Motors[index].PosRange = false;
    warnings_[index] = 0;
    return;
  }
  watch_closely(index, follows, outside, together);
}

void LinMotController::watch_closely(std::size_t index, bool follows, bool outside,
                                     Together& together) noexcept {
  Motor& motor = motors_[index];
  const Watched& watched = watched_[index];
  std::uint16_t warnings = sensors_of(index);
  const std::uint16_t causes = causes_of(index, warnings, follows);
  if ((causes & (motor_bit::kSliderMissing | motor_bit::kTypeMismatch | motor_bit::kInitFailed)) != 0)
    motor.lose_position();
  const bool homed = motor.homed();
  data.Motors[index].PosRange = homed && outside;
  if (motor.heat() > motor_settings[index].thermal.warn) warnings |= motor_bit::kHotCalculated;
  if (!follows) warnings |= motor_bit::kFollowingError;
  if (!homed) warnings |= motor_bit::kInitNotDone;
  if (homed && outside) warnings |= motor_bit::kPositionRange;
  warnings &= watched.warning_mask;
  warnings_[index] = warnings;
  errors_[index] |= causes;
  together.homed = together.homed && homed;
  together.causes |= causes;
  together.errors |= causes;
  together.warnings |= warnings;
}

/// An error stays until ERROR is left; what ends with the motors' current is a cause no more.
void LinMotController::watch() noexcept {
  watch_system();
  Together together{.errors = together_.errors};
  for (const std::size_t i : motors_there()) watch_motor(i, together);
  together_ = together;
  if (state_ == State::run && (refused_ || has_warning())) log_warnings();
  refused_ = false;
}

void LinMotController::log_warnings() noexcept {
  const auto logged = static_cast<std::uint16_t>(together_.warnings | ((system_warnings_ & 0x3E) << 8) |
                                                 (system_warnings_ & system_bit::kEmergencyStop) |
                                                 (refused_ ? system_bit::kRefused : 0));
  data.LoggedWarnings =
      WORD{static_cast<std::uint16_t>(static_cast<std::uint16_t>(data.LoggedWarnings) | logged)};
}

/// What version 3 shows is the code of the error, with the motor in its second digit. Version 2 has two
/// lights that flash: A so often as the motor's number, or long for the controller, B by the error; both
/// together are any other error.
WORD LinMotController::shown_code(const ErrorRow& row, std::size_t motor) const noexcept {
  const std::size_t number = row.of_motor ? motor + 1 : 0;
  if (hardware->version >= 3 || row.ascii == 0)
    return WORD{static_cast<std::uint16_t>(row.code + number * 0x100)};
  return WORD{static_cast<std::uint16_t>(number * 0x10 + static_cast<std::size_t>(row.ascii))};
}

void LinMotController::find_first_error() noexcept {
  constexpr std::uint16_t kBothLights = 0xFF;
  error_number_ = 0;
  error_motor_ = -1;
  for (const ErrorRow& row : errors()) {
    if (row.bit < 0 || row.ascii == 0) continue;
    const auto bit = static_cast<std::uint16_t>(1u << row.bit);
    for (std::size_t i = 0; i < (row.of_motor ? kMotors : 1); ++i) {
      if (((row.of_motor ? errors_[i] : system_errors_) & bit) == 0) continue;
      error_number_ = row.ascii;
      if (row.of_motor) error_motor_ = static_cast<int>(i);
      data.Display = shown_code(row, i);
      return;
    }
  }
  if ((system_errors_ & system_bit::kApplication) != 0)
    data.Display = WORD{hardware->version >= 3 ? kDataOutOfRange : kBothLights};
}

}  // namespace lockstep
