// What a program, a trace or a panel reads of a device.
#include <algorithm>
#include <cmath>

#include "tech_objects/mco305/device.hpp"
#include "tech_objects/mco305_catalogue/drive_parameters.hpp"

namespace lockstep::mco305 {
namespace {

constexpr int kFirstSyncFlag = 24;

std::int32_t integer(double value) noexcept {
  const double rounded = std::floor(value + 0.5);
  return static_cast<std::int32_t>(std::clamp(rounded, -2147483648.0, 2147483647.0));
}

}  // namespace

std::int32_t Device::reference() const noexcept {
  return integer(reference_);
}

// A position shown is 31 bits wide, and so is what the conversion gets.
std::int32_t Device::shown_units(std::int64_t counter) const noexcept {
  return shown_position(unit_.units(shown_position(counter - zero())));
}

std::int32_t Device::following_error() const noexcept {
  return shown_position(unit_.units(shown_position(set_counts() - actual_)));
}

void Device::set_velocity_window(std::int32_t milliseconds) noexcept {
  velocity_window_ = std::clamp<std::int64_t>(milliseconds, 1, RecentPositions::kSteps - 1);
}

// [qc]
std::int64_t Device::moved_in_window() const noexcept {
  const std::int64_t window = std::min(velocity_window_, now_);
  return window <= 0 ? 0 : actual_ - positions_.at(now_ - window);
}

bool Device::stands() const noexcept {
  constexpr std::int64_t kLong = 20;
  return now_ < kLong || std::abs(actual_ - positions_.at(now_ - kLong)) <= 1;
}

// [UU/s]
std::int32_t Device::velocity_units() const noexcept {
  const std::int64_t window = std::min(velocity_window_, now_);
  const std::int64_t moved = moved_in_window();
  if (moved == 0) return 0;
  // Within what the conversion takes; nothing real is faster.
  constexpr std::int64_t kFar = std::int64_t{1} << 50, kFast = std::int64_t{1} << 32;
  const std::int64_t counts = std::clamp(moved, -kFar, kFar) * 1000 / window;
  return static_cast<std::int32_t>(unit_.units(std::clamp(counts, -kFast, kFast)));
}

std::int32_t Device::axis_end() const noexcept {
  constexpr std::int32_t kReached = 1, kPositioning = 2, kSpeed = 4, kStopped = 8, kOff = 64, kReset = 128;
  if (!on_) return kOff | (arrived_ ? kReached : 0);
  std::int32_t bits = was_reset_ ? kReset : 0;
  if (arrived_ && !moving_) bits |= kReached;
  if (mode_ == MotionMode::kPosition && !arrived_) bits |= kPositioning;
  if (mode_ == MotionMode::kSpeed) bits |= kSpeed;
  if (mode_ == MotionMode::kStop) bits |= kStopped;
  return bits;
}

std::int32_t Device::status() const noexcept {
  const std::uint32_t top = (moving_ ? 1U : 0U) | (controller_.idle() ? 8U : 0U);
  const std::uint32_t second = (on_ ? 0U : 0x80U) | (arrived_ ? 4U : 0U);
  const std::uint32_t lowest = (at_negative_end_ || at_positive_end_ ? 0x80U : 0U) |
                               (io_.active(InputFunction::kHomeSwitch) ? 0x40U : 0U) |
                               (io_.active(InputFunction::kStart) ? 0x20U : 0U) | (on_ ? 0U : 4U);
  return static_cast<std::int32_t>(top << 24 | second << 16 | lowest);
}

// SYSVAR 4218: those of SYNCSTAT are its top ones. A position that is not shown as it is has overflowed.
std::int32_t Device::flags() const noexcept {
  const auto overflows = [](std::int64_t position) noexcept { return shown_position(position) != position; };
  const bool slave = overflows(actual_ - origin_),
             leading = has_master_ && overflows(master_.position() - master_.origin());
  return (slave ? 2 << 8 : 0) | (leading ? 4 << 8 : 0) | (moving_ ? 1 | 1 << 8 : 0) | (arrived_ ? 4 : 0) |
         (latches_ != 0 ? 8 : 0) | (pending_.has(kPositionError) ? 32 : 0) | (on_ ? 0 : 128) |
         (controller_.idle() ? 8 << 8 : 0) | sync_.status() << kFirstSyncFlag;
}

bool Device::system_variable(std::int32_t index, std::int32_t& value) const noexcept {
  const FourSlopeState& set = profile_.state();
  switch (index) {
    case 1:
    case 2:
    case 3:
      value = io_.input_byte(index - 1);
      return true;
    case 9:
      value = io_.output_byte();
      return true;
    case 16:
      value = absolute_.errors() + master_.absolute().errors();
      return true;
    case 17:
      value = status() >> 16 & 0xFFFF;
      return true;
    case 22:
      value = static_cast<std::int32_t>(now_ & 0x7FFFFFFF);
      return true;
    case 28:
      return drive_parameter(kMotorCurrent, value);
    case 30:
      return drive_parameter(kMotorVoltage, value);
    case 31:
      return drive_parameter(kDriveStatus, value);
    case 32:
      return drive_parameter(kMainActualValue, value);
    case 33:
      value = program_line_;
      return true;
    case 34:
      return drive_parameter(kMotorFrequency, value);
    case 35:
      return drive_parameter(kMotorTorque, value);
    case 4096:
      value = shown_position(actual_ - origin_);
      return true;
    case 4097:
      value = shown_position(set_counts() - origin_);
      return true;
    case 4098:
      value = shown_position(latched_ - origin_);
      return true;
    case 4099:
      value = static_cast<std::int32_t>(moved_in_window());
      return true;
    case 4101:
      value = shown_position(set_counts() - actual_);
      return true;
    case 4102:
      value = static_cast<std::int32_t>(absolute_.turns(parameters_[kEncoder]));
      return true;
    case 4103:
      value = static_cast<std::int32_t>(master_.absolute().turns(parameters_[kMasterEncoder]));
      return true;
    case 4107:
      value = static_cast<std::int32_t>(now_ < 1 ? 0 : actual_ - positions_.at(now_ - 1));
      return true;
    case 4111:
      value = reference();
      return true;
    case 4113:
      value = parameters_[kTimer];
      return true;
    case 4114:
      value = parameters_[kProfTime];
      return true;
    case 4115:
      value = 1;  // the reference has a sign,
      return true;
    case 4116:
    case 4127:
      value = 0;  // no output has it; without its controller the motor is free
      return true;
    case 4122:
      value = open_loop_;
      return true;
    case 4123:
      value = parameters_[kEncoderType];
      return true;
    case 4120:
      value = shown_position(std::int64_t{4} * parameters_[kEncoder]);
      return true;
    case 4121:
      value = parameters_[kMarkerTypeMaster];
      return true;
    case 4124:
      value = parameters_[kMasterEncoderType];
      return true;
    case 4125:
      value = parameters_[kEncoder];
      return true;
    case 4126:
      value = parameters_[kMasterEncoder];
      return true;
    case 4218:
      value = flags();
      return true;
    case 4231:
      value = integer(set.velocity * 128.0);
      return true;
    case 4275:
      value = static_cast<std::int32_t>(profile_.phase());
      return true;
    case 4276:
      value = integer(set.velocity * static_cast<double>(sampling_));
      return true;
    case 4277: {
      FourSlopeLimits all = limits();
      const std::int32_t first = parameters_[kJerkMin];
      for (std::size_t i = 0; i < all.slopes.size(); ++i) {
        const std::int32_t own = parameters_[kJerkMin + static_cast<std::int32_t>(i)];
        all.slopes[i] = static_cast<double>(own > 0 ? own : first) / acceleration_maximum_;
      }
      value = integer(std::abs(FourSlopeProfile::stop_path(set.velocity, set.acceleration, all)));
      return true;
    }
    default:
      return sync_variable(index, value);
  }
}

/// Those of the master and of synchronizing.
bool Device::sync_variable(std::int32_t index, std::int32_t& value) const noexcept {
  const auto held = [&value](std::int64_t whole) noexcept {
    value = static_cast<std::int32_t>(std::clamp<std::int64_t>(whole, -2147483648LL, 2147483647LL));
    return true;
  };
  const auto rounded = [&value](double real) noexcept {
    value = integer(real);
    return true;
  };
  const auto share = [&rounded](double spacing, std::int32_t nominal) noexcept {
    return rounded(nominal > 0 ? 100.0 * spacing / static_cast<double>(nominal) : 0.0);
  };
  const MarkerFilter& filter = sync_.filter();
  switch (index) {
    case 4100:
      return held(master_.moved_in(velocity_window_));
    case 4105:
      return held(master_.shown());
    case 4106:
      return held(master_.shown_latch());
    case 4108:
      return held(master_.moved());
    case 4109:
      return held(master_.own().frequency());
    case 4110:
      return held(master_.own().active() ? 1 : 0);
    case 4117:
      return held(master_.own().acceleration() * 1000);
    case 4118:
      return held(master_.own().target());
    case 4128:
      return held(master_.real_velocity());
    case 4238:
      return rounded(filter.distance());
    case 4240:
      return rounded(filter.start());
    case 4241:
      return rounded(filter.start_rest());
    case 4242:
      return rounded(filter.correction());
    case 4243:
      return rounded(std::abs(sync_.master_spacing()));
    case 4244: {
      constexpr double kScale = 65'536.0;  // that of the sources is not printed
      return rounded(filter.trim() * kScale);
    }
    case 4245:
      return rounded(filter.unfiltered());
    case 4246:
      return share(std::abs(sync_.master_spacing()), parameters_[kSyncMPulsM]);
    case 4247:
      return share(std::abs(sync_.slave_spacing()), parameters_[kSyncMPulsS]);
    case 4248:
      return rounded(filter.start_share());
    case 4249:
      return rounded(sync_.slave_spacing());
    case 4250:
      return rounded(filter.markers());
    case 4251:
      return rounded(filter.constant());
    case 4252:
      return rounded(filter.errors());
    case 4253:
      return rounded(filter.filtered_errors());
    default:
      return false;
  }
}

bool Device::set_system_variable(std::int32_t index, std::int32_t value) noexcept {
  constexpr std::int32_t kMasterPosition = 4105;
  if (index != kMasterPosition || !master_.move_to(value)) return false;
  has_master_ = true;
  return true;
}

// [UU]
std::int32_t Device::sync_error() const noexcept {
  return shown_position(unit_.units(shown_position(sync_.error())));
}

// [qc/s]
std::int32_t Device::master_velocity() const noexcept {
  const std::int64_t window = std::max<std::int64_t>(std::min(velocity_window_, now_), 1);
  constexpr std::int64_t kFar = std::int64_t{1} << 40;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(
      std::clamp(master_.moved_in(window), -kFar, kFar) * 1000 / window, -2147483648LL, 2147483647LL));
}

bool Device::get_parameter(std::int32_t number, std::int32_t& value) const noexcept {
  const std::size_t index = parameter_index(number);
  if (index == kNoParameter) return false;
  switch (number) {
    case 3440:
      value = io_.input_word();
      return true;
    case 3441:
      value = io_.output_byte();
      return true;
    case 3450:
      value = actual_units();
      return true;
    case 3451:
      value = set_units();
      return true;
    case 3453:
      value = latched_units();
      return true;
    case 3456:
      value = following_error();
      return true;
    case 3458:
      value = velocity_units();
      return true;
    case 3461:
      value = axis_end();
      return true;
    case 3462:
      value = status();
      return true;
    case 3452:
      value = master_.shown();
      return true;
    case 3454:
      value = master_.shown_latch();
      return true;
    case 3457:
      value = sync_error();
      return true;
    case 3459:
      value = master_velocity();
      return true;
    case 3460:
      value = sync_status();
      return true;
    case 3470:
      value = pending_.alarm_word(1);
      return true;
    case 3471:
      value = pending_.alarm_word(2);
      return true;
    default:
      value = parameters_[number];
      return true;
  }
}

}  // namespace lockstep::mco305
