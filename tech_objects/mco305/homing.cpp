// HOME and INDEX.
#include <algorithm>
#include <cmath>

#include "tech_objects/mco305/device.hpp"

namespace lockstep::mco305 {
namespace {

// Part of the velocity of homing with which a switch is left and an index looked for; the sources say slowly.
constexpr double kSlowly = 0.2;
constexpr double kSlowest = 0.1;  // [qc/ms]

}  // namespace

int Device::begin_home(bool index_only) noexcept {
  if (is_absolute()) return kUnknownCommand;
  if (pending_.any() || !on_) return kErrorNotReset;
  const std::int32_t velocity = parameters_[kHomeVel];
  if (velocity == 0) return kHomeVelocityZero;
  const std::int32_t type = parameters_[kHomeType];
  home_ = {};
  home_.index_only = index_only;
  home_.by_index = index_only || type == 0 || type == 2;
  home_.turns = !index_only && type <= 1;
  home_.search_velocity = static_cast<double>(unit_.sign) * relative_velocity(velocity);
  mode_ = MotionMode::kHome;
  interrupted_ = MotionMode::kHold;
  arrived_ = false;
  was_reset_ = false;
  if (index_only) {
    search_index();
    search_with(home_.search_velocity);
  } else {
    home_.phase = Home::Phase::kToSwitch;
    search_with(home_.search_velocity);
  }
  return 0;
}

/// HOME_RAMP, but no steeper than DFLTACC.
FourSlopeLimits Device::home_limits() const noexcept {
  const std::int32_t ramp = std::max(std::min(parameters_[kHomeRamp], parameters_[kDfltAcc]), 1);
  FourSlopeLimits all = limits();
  all.acceleration = all.deceleration =
      static_cast<double>(ramp) / parameters_.real(kVelRes) * acceleration_maximum_;
  all.reverses = true;
  return all;
}

void Device::search_with(double velocity) noexcept {
  FourSlopeLimits all = home_limits();
  all.velocity = std::max(velocity_maximum_, std::abs(state().velocity));
  profile_.to_velocity(state(), velocity, all);
}

void Device::search_index() noexcept {
  home_.phase = Home::Phase::kToIndex;
  home_.begin = actual_;
  home_.latches = latches_;
}

/// The switch is reached: it is left to where the zero is looked for.
void Device::home_from_switch() noexcept {
  const double slow = std::max(std::abs(home_.search_velocity) * kSlowly, kSlowest);
  const double direction = (home_.search_velocity < 0.0) != home_.turns ? -1.0 : 1.0;
  home_.phase = Home::Phase::kOffSwitch;
  home_.seen = false;
  search_with(direction * slow);
}

void Device::step_home() noexcept {
  const bool at_switch = io_.active(InputFunction::kHomeSwitch);
  switch (home_.phase) {
    case Home::Phase::kToSwitch:
      if (at_switch) home_from_switch();
      break;
    case Home::Phase::kOffSwitch: {
      // Braking in front of a reversal may carry it over a narrow switch.
      const bool leaves = (state().velocity < 0.0) == ((home_.search_velocity < 0.0) != home_.turns);
      home_.seen = home_.seen || (at_switch && leaves);
      if (at_switch || !home_.seen) break;
      if (home_.by_index)
        search_index();
      else
        to_home(static_cast<double>(actual_));
      break;
    }
    case Home::Phase::kToIndex:
      if (latches_ != home_.latches)
        to_home(static_cast<double>(latched_));
      else if (std::abs(actual_ - home_.begin) > 4 * std::int64_t{parameters_[kEncoder]})
        end_home(kIndexNotFound);
      break;
    case Home::Phase::kToZero:
      if (!profile_.over() || profile_.state().velocity != 0.0) break;
      if (!home_.index_only) {
        const std::int64_t distance = set_counts();
        origin_ = limits_origin_ = distance;
        temporary_ = 0;
        homed_ = true;
      }
      end_home(0);
      break;
    case Home::Phase::kOver:
      break;
  }
}

/// To the place that becomes the zero point.
void Device::to_home(double from) noexcept {
  const double offset = home_.index_only ? 0.0 : parameters_.real(kHomeOffset);
  home_.phase = Home::Phase::kToZero;
  FourSlopeLimits all = home_limits();
  all.velocity = std::max(std::abs(home_.search_velocity), std::abs(state().velocity));
  profile_.to_position(state(), from + offset, all);
}

void Device::end_home(int error) noexcept {
  home_.phase = Home::Phase::kOver;
  home_.error = error;
  mode_ = MotionMode::kHold;
  arrived_ = error == 0;
  if (error != 0) stop(limits().deceleration, MotionMode::kHold);
}

void Device::give_up_home() noexcept {
  if (homing()) end_home(0);
  stop(limits().deceleration, MotionMode::kHold);
}

}  // namespace lockstep::mco305
