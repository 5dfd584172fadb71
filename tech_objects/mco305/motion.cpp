// What a program asks the axis to do.
#include <algorithm>
#include <cmath>

#include "tech_objects/mco305/device.hpp"

namespace lockstep::mco305 {

FourSlopeState Device::state() const noexcept {
  return profile_.state();
}

// [qc/ms]
double Device::relative_velocity(std::int32_t velocity) const noexcept {
  const double wanted = static_cast<double>(velocity) / parameters_.real(kVelRes) * velocity_maximum_;
  return std::clamp(wanted, -kFastest, kFastest);
}

FourSlopeLimits Device::limits() const noexcept {
  const auto of = [this](std::int32_t set, std::int32_t start) noexcept {
    return static_cast<double>(set > 0 ? set : std::max(parameters_[start], 1)) / parameters_.real(kVelRes);
  };
  FourSlopeLimits limits;
  limits.velocity =
      std::abs(velocity_ < 0 ? relative_velocity(parameters_[kDfltVel]) : relative_velocity(velocity_));
  limits.acceleration = of(acceleration_, kDfltAcc) * acceleration_maximum_;
  limits.deceleration = of(deceleration_, kDfltAcc) * acceleration_maximum_;
  limits.reverses = parameters_[kRevers] != 2;
  const std::int32_t type = parameters_[kRampType];
  limits.sinusoidal = type == 1;
  if (type != 2) return limits;
  const std::int32_t first = parameters_[kJerkMin];
  for (std::size_t i = 0; i < limits.slopes.size(); ++i) {
    const std::int32_t own = parameters_[kJerkMin + static_cast<std::int32_t>(i)];
    limits.slopes[i] = static_cast<double>(std::max(own > 0 ? own : first, 0)) / acceleration_maximum_;
  }
  return limits;
}

bool Device::may_move(int& error) const noexcept {
  error = 0;
  if (pending_.any())
    error = kErrorNotReset;
  else if (parameters_[kHomeForce] != 0 && !homed_)
    error = kHomeNotDone;
  return error == 0;
}

/// From 5.00 on an axis beyond a limit may be driven back.
bool Device::within_limits(std::int64_t target, int& error) const noexcept {
  const std::int64_t to = target - limits_origin_, at = set_counts() - limits_origin_;
  const auto outside = [](bool active, bool beyond) noexcept { return active && beyond; };
  const bool below = outside(parameters_[kSwNegLimAct] != 0, to < parameters_[kNegLimit]);
  const bool above = outside(parameters_[kSwPosLimAct] != 0, to > parameters_[kPosLimit]);
  error = 0;
  if (at_negative_end_ && to < at) error = kFurtherOut;
  if (at_positive_end_ && to > at) error = kFurtherOut;
  if (!below && !above) return error == 0 || !settings_.later_edition;
  const bool was_outside = (below && at < parameters_[kNegLimit]) || (above && at > parameters_[kPosLimit]);
  const bool back = (below && to > at) || (above && to < at);
  if (settings_.later_edition && was_outside) {
    if (back) return true;
    error = kFurtherOut;
    return false;
  }
  error = kSoftwareLimit;
  return false;
}

void Device::move_to(double target) noexcept {
  profile_.to_position(state(), target, limits());
}

void Device::move_with(double velocity) noexcept {
  FourSlopeLimits all = limits();
  all.velocity = std::max(velocity_maximum_, std::abs(state().velocity));
  profile_.to_velocity(state(), velocity, all);
}

int Device::position_to(std::int32_t units, bool relative) noexcept {
  int error = 0;
  if (!may_move(error)) return error;
  const std::int64_t target = within_reach(within_reach(unit_.counts(units)) + (relative ? actual_ : zero()));
  if (!within_limits(target, error)) return error;
  if (!on_) return kErrorNotReset;
  mode_ = MotionMode::kPosition;
  target_ = target;
  arrived_ = false;
  was_reset_ = false;
  move_to(static_cast<double>(target));
  return 0;
}

int Device::further_out() const noexcept {
  return settings_.later_edition ? kFurtherOut : kSoftwareLimit;
}

bool Device::leads_out(double velocity) const noexcept {
  if (velocity == 0.0) return false;
  const bool backwards = velocity < 0.0;
  if (settings_.later_edition && (backwards ? at_negative_end_ : at_positive_end_)) return true;
  const std::int64_t at = set_counts() - limits_origin_;
  return backwards ? parameters_[kSwNegLimAct] != 0 && at < parameters_[kNegLimit]
                   : parameters_[kSwPosLimAct] != 0 && at > parameters_[kPosLimit];
}

/// While it moves, a new velocity that leads further out is an error like one that begins so.
void Device::set_speed(std::int32_t velocity) noexcept {
  speed_ = velocity;
  if (mode_ == MotionMode::kSpeed && on_ && start_speed() == further_out()) raise(further_out());
}

int Device::start_speed() noexcept {
  int error = 0;
  if (!may_move(error)) return error;
  if (!on_) return kErrorNotReset;
  const auto sign = static_cast<double>(unit_.sign);
  const double velocity = sign * relative_velocity(speed_);
  if (leads_out(velocity)) return further_out();
  mode_ = MotionMode::kSpeed;
  arrived_ = false;
  was_reset_ = false;
  move_with(velocity);
  return 0;
}

void Device::stop(double deceleration, MotionMode mode) noexcept {
  if (!on_) return;
  if (mode_ == MotionMode::kPosition || mode_ == MotionMode::kSpeed) interrupted_ = mode_;
  FourSlopeLimits all = limits();
  all.deceleration = deceleration;
  all.velocity = std::max(all.velocity, std::abs(state().velocity));
  profile_.to_velocity(state(), 0.0, all);
  mode_ = mode;
  arrived_ = false;
}

/// The motion is over, not interrupted.
void Device::stop_speed() noexcept {
  stop(limits().deceleration, MotionMode::kHold);
  interrupted_ = MotionMode::kHold;
}

void Device::motor_stop() noexcept {
  if (homing()) give_up_home();
  stop(limits().deceleration, MotionMode::kStop);
}

void Device::motor_on() noexcept {
  if (on_) return;
  on_ = true;
  open_loop_ = 0;
  was_reset_ = true;
  mode_ = MotionMode::kHold;
  arrived_ = true;
  controller_.reset();
  if (drive_ != nullptr) {
    drive_->enable(true);
    unled_ += static_cast<double>(actual_) - profile_.state().position;
    profile_.stand(static_cast<double>(actual_));
  } else {
    profile_.stand(profile_.state().position);
  }
}

void Device::motor_off() noexcept {
  if (mode_ == MotionMode::kPosition || mode_ == MotionMode::kSpeed) interrupted_ = mode_;
  if (homing()) give_up_home();
  on_ = false;
  open_loop_ = 0;
  mode_ = MotionMode::kHold;
  arrived_ = true;
  reference_ = 0.0;
  if (!virtual_) unled_ += static_cast<double>(actual_) - profile_.state().position;
  profile_.stand(virtual_ ? profile_.state().position : static_cast<double>(actual_));
  if (drive_ != nullptr) drive_->enable(false);
}

/// While the axis is controlled the controller says what the drive does.
void Device::set_reference(std::int32_t reference) noexcept {
  if (on_) return;
  constexpr std::int32_t kFull = 0x4000;
  open_loop_ = std::clamp(reference, -kFull, kFull);
  if (drive_ != nullptr) drive_->enable(open_loop_ != 0);
}

int Device::go_on() noexcept {
  const MotionMode what = interrupted_;
  interrupted_ = MotionMode::kHold;
  if (what == MotionMode::kSpeed) return start_speed();
  if (what != MotionMode::kPosition) return 0;
  int error = 0;
  if (!may_move(error)) return error;
  if (!on_) return kErrorNotReset;
  mode_ = MotionMode::kPosition;
  arrived_ = false;
  move_to(static_cast<double>(target_));
  return 0;
}

int Device::follow(SyncMode mode) noexcept {
  int error = 0;
  if (!may_move(error)) return error;
  if (!on_) return kErrorNotReset;
  has_master_ = true;
  sync_.begin(mode, state(), actual_, limits(), master_);
  mode_ = MotionMode::kFollow;
  interrupted_ = MotionMode::kHold;
  arrived_ = false;
  was_reset_ = false;
  return 0;
}

void Device::turn_own_master(std::int32_t hertz) noexcept {
  master_.set_velocity(hertz);
  has_master_ = true;
}

void Device::define_sync_origin(std::int32_t master, std::int32_t slave) noexcept {
  sync_.define_origin(master_.origin() + master,
                      static_cast<double>(within_reach(unit_.counts(slave)) + zero()));
}

/// The limits stay where they are on the machine.
int Device::define_origin() noexcept {
  if (is_absolute()) return kUnknownCommand;
  origin_ = actual_;
  temporary_ = 0;
  return 0;
}

int Device::define_master_origin() noexcept {
  if (master_.is_absolute()) return kUnknownCommand;
  master_.set_origin(0);
  return 0;
}

void Device::set_origin(std::int32_t units) noexcept {
  temporary_ = within_reach(unit_.counts(units));
}

}  // namespace lockstep::mco305
