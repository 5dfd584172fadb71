// What the option reads of the drive in which it sits, and changes there: GETVLT, SETVLT, INAD, OUTDA.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/mco305/device.hpp"
#include "tech_objects/mco305_catalogue/drive_parameters.hpp"

namespace lockstep::mco305 {
namespace {

constexpr double kVolts = 10.0, kPerVolt = 100.0;                 // INAD: 1 is 10 mV
constexpr double kMilliamperes = 20.0, kPerMilliampere = 5000.0;  // OUTDA: 50000 is 10 mA
constexpr double kMilli = 1000.0;

// The motor that is assumed: the sources have none.
constexpr double kPolePairs = 2.0;
constexpr double kRatedVoltage = 400.0, kVoltsPerHertz = kRatedVoltage / 50.0;
constexpr double kMagnetizing = 1.0, kAmperesPerTorque = 0.3;  // [A], [A/Nm]

std::int32_t whole(double value) noexcept {
  constexpr double kLargest = 2'147'483'647.0;
  if (!(std::abs(value) <= kLargest)) return value > 0.0 ? 2'147'483'647 : value < 0.0 ? -2'147'483'647 : 0;
  return static_cast<std::int32_t>(std::lround(value));
}

}  // namespace

// [qc/ms] of a motor that turns so fast [1/min]
double Device::counts_per_millisecond(double rpm) const noexcept {
  return std::min(rpm * turn_ / 60'000.0, kFastest);
}

/// What the drive makes of a reference; where a parameter of either has changed.
void Device::scale_drive() noexcept {
  full_reference_ =
      drive_sign_ *
      (maximum_reference_ > 0 ? counts_per_millisecond(maximum_reference_ / kMilli) : velocity_maximum_);
  speed_limit_ = speed_high_limit_ < 0 ? kFastest : counts_per_millisecond(speed_high_limit_);
  scaled_reference_ = std::numeric_limits<double>::quiet_NaN();
}

double Device::analog_volts(std::size_t input) const noexcept {
  const double* const tag = settings_.analog_inputs[input];
  return tag == nullptr || !std::isfinite(*tag) ? 0.0 : std::clamp(*tag, -kVolts, kVolts);
}

bool Device::analog_input(std::int32_t terminal, std::int32_t& value) const noexcept {
  if (terminal != 53 && terminal != 54) return false;
  value = whole(analog_volts(terminal == 53 ? 0 : 1) * kPerVolt);
  return true;
}

bool Device::set_analog_output(std::int32_t terminal, std::int32_t value) noexcept {
  if (terminal != 42) return false;
  analog_output_ = std::clamp(static_cast<double>(value) / kPerMilliampere, 0.0, kMilliamperes);
  if (settings_.analog_output != nullptr) *settings_.analog_output = analog_output_;
  return true;
}

bool Device::drive_parameter(std::int32_t number, std::int32_t& value) const noexcept {
  const double full = full_reference_ != 0.0 ? std::abs(full_reference_) : 1.0;
  const double velocity = virtual_ ? 0.0 : told_.velocity / kMillisecondsPerSecond;           // [qc/ms]
  const double frequency = std::abs(velocity) * kMillisecondsPerSecond / turn_ * kPolePairs;  // [Hz]
  switch (number) {
    case kMaximumReference:
      value = maximum_reference_ > 0 ? maximum_reference_ : whole(parameters_.real(kVelMax) * kMilli);
      return true;
    case kSpeedHighLimit:
      value = speed_high_limit_ < 0 ? find_drive_parameter(number)->highest : speed_high_limit_;
      return true;
    case kReferencePercent:
      value = whole(drive_sign_ * reference_ / CountController::kFullScale * 1000.0);
      return true;
    case kDriveStatus: {
      constexpr std::int32_t kFollows = 1 | 2 | 4 | 1 << 9 | 1 << 11, kTrip = 8;
      value = (drive_enabled_ ? kFollows : 0) | (trouble_.fault ? kTrip : 0);
      return true;
    }
    case kMainActualValue:
      value = whole(velocity / full * 10'000.0);
      return true;
    case kMotorVoltage:
      value = whole(drive_enabled_ ? std::min(frequency * kVoltsPerHertz, kRatedVoltage) * 10.0 : 0.0);
      return true;
    case kMotorFrequency:
      value = whole(drive_enabled_ ? frequency * 10.0 : 0.0);
      return true;
    case kMotorCurrent: {
      const double across = kAmperesPerTorque * told_.torque;
      value = whole(drive_enabled_ ? std::sqrt(kMagnetizing * kMagnetizing + across * across) * 100.0 : 0.0);
      return true;
    }
    case kMotorTorque:
      value = whole(told_.torque * 10.0);
      return true;
    case kMotorSpeed:
      value = whole(velocity * 60'000.0 / turn_);
      return true;
    case kDriveInputs:
      value = io_.input_byte(1);
      return true;
    case kAnalogInput53:
    case kAnalogInput54:
      value = whole(analog_volts(number == kAnalogInput53 ? 0 : 1) * kMilli);
      return true;
    case kAnalogOutput42:
      value = whole(analog_output_ * kMilli);
      return true;
    default:
      return false;
  }
}

int Device::set_drive_parameter(std::int32_t number, std::int32_t value) noexcept {
  const DriveParameter* const found = find_drive_parameter(number);
  if (found == nullptr || !found->writable || value < found->lowest || value > found->highest)
    return kUnknownParameter;
  (number == kMaximumReference ? maximum_reference_ : speed_high_limit_) = value;
  scale_drive();
  return 0;
}

/// SWAPMENC: the drive turns the motor whose encoder is the feedback, and the other one stands; counters and
/// zero points change their places. Where ENCCONTROL, MENCCONTROL say so what is read goes on from where it
/// is.
bool Device::swap_encoders(bool swapped) noexcept {
  if (settings_.has_master || absolute_.present() || master_.is_absolute()) return false;
  if (swapped == swapped_) return true;
  swapped_ = swapped;
  has_master_ = true;
  constexpr std::int32_t kSoftChange = 1;
  const auto is_soft = [this](std::int32_t number) noexcept {
    return settings_.later_edition && (parameters_[number] & kSoftChange) != 0;
  };
  std::int64_t position = is_soft(kMasterEncControl) ? master_.position() : actual_;
  std::int64_t origin = is_soft(kMasterEncControl) ? master_.origin() : origin_;
  if (!is_soft(kMasterEncControl)) master_.exchange(position, origin);
  if (is_soft(kEncControl)) return true;
  swap_offset_ += position - actual_;
  actual_ = position;
  origin_ = origin;
  positions_.fill(actual_);
  if (virtual_) {
    machine_ = static_cast<double>(actual_);
    profile_.stand(machine_);
  } else if (!on_) {
    profile_.stand(static_cast<double>(actual_));
  }
  return true;
}

}  // namespace lockstep::mco305
