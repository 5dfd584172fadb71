#include "tech_objects/axis/torque.hpp"

#include <cmath>

#include "tech_objects/axis/target_distance.hpp"

namespace lockstep {
namespace {

ErrorId away_from_stop(double distance, int side) noexcept {
  return side * distance > 0.0 ? ErrorId::towards_fixed_stop : ErrorId::none;
}

}  // namespace

void TorqueOrders::step() noexcept {
  if (!forces_.due()) return;
  if (forces_.detects_fixed_stop())
    watch_fixed_stop();
  else
    clamping_.leave();
  TorqueCommand command = forces_.command(data, power_state_ == PowerState::on);
  if (setpoint_sign_ < 0.0) command = {{-command.band.upper, -command.band.lower}, -command.additive};
  drive_->command_torque(command);
  forces_.watch_limitation(actual_torque_, drive_properties_.tells_torque && drive_running_);
  forces_.show(data, clamping_.holds());
}

// ---- Fixed stop

/// The axis pushes against something: it lags behind a setpoint that moves on, or that it should have
/// reached.
bool TorqueOrders::pushes_against_a_stop() const noexcept {
  const double error = data.StatusPositioning.FollowingError;
  if (!(std::abs(error) > data.Clamping.FollowingErrorDeviation)) return false;
  if (power_state_ != PowerState::on || !position_controlled_ || motion_ == AxisMotion::none) return false;
  if (setpoint_.velocity != 0.0) return setpoint_.velocity * error > 0.0;
  if (motion_ != AxisMotion::single_axis) return jobs_[kBase] != nullptr || led(motion_);
  // A job that has only just begun may lead away from what the axis pushes against already.
  return jobs_[kBase] != nullptr && (single_.finished() || single_.distance_left(error > 0.0 ? 1 : -1) > 0.0);
}

void TorqueOrders::watch_fixed_stop() noexcept {
  if (clamping_.found()) return watch_clamping();
  if (!pushes_against_a_stop()) return;
  clamping_.find(data.StatusPositioning.FollowingError > 0.0 ? 1 : -1, actual_);
  ends_.end_all(JobPhase::aborted, ErrorId::none, AbortedBy::fixed_stop);
  stops_.freeze();
}

void TorqueOrders::watch_clamping() noexcept {
  if (power_state_ != PowerState::on) return clamping_.leave();
  const bool has_job = jobs_[kBase] != nullptr || jobs_[kSuperimposed] != nullptr;
  switch (clamping_.watch(actual_, modulo_, data.Clamping.PositionTolerance, setpoint_.velocity, has_job)) {
    case Clamping::Outcome::held:
      break;
    case Clamping::Outcome::turned_to:
      ends_.end_all(JobPhase::failed, ErrorId::towards_fixed_stop);
      stops_.freeze();
      break;
    case Clamping::Outcome::torn_away:
      reactions_.raise(alarm::kClamping, {.cause = side_of(clamping_.side()),
                                          .value = actual_.value,
                                          .limit = data.Clamping.PositionTolerance});
      break;
  }
}

ErrorId TorqueOrders::check_at_fixed_stop(const Job& job) const noexcept {
  const int side = clamping_.side();
  switch (job.kind) {
    case JobKind::MC_Halt:
    case JobKind::MC_Stop:
    case JobKind::MC_HaltSuperimposed:
      return ErrorId::none;
    case JobKind::MC_MoveAbsolute:
      return away_from_stop(absolute_distance(job.as<MoveAbsoluteJob>(), setpoint_.position.value, modulo_),
                            side);
    case JobKind::MC_MoveRelative:
    case JobKind::MC_MoveSuperimposed:
      return away_from_stop(job.as<DistanceJob>().distance, side);
    case JobKind::MC_MoveVelocity:
      if (!job.position_controlled) return ErrorId::fixed_stop_position_control;
      return away_from_stop(job.as<VelocityJob>().current ? 0.0 : job.velocity, side);
    case JobKind::MC_MoveJog:
      if (!job.position_controlled) return ErrorId::fixed_stop_position_control;
      return away_from_stop(job.as<JogJob>().direction, side);
    case JobKind::MC_Home:
      return class_of(job, false) == JobClass::home_active ? ErrorId::towards_fixed_stop : ErrorId::none;
    case JobKind::MC_GearInVelocity:
      return ErrorId::fixed_stop_position_control;
    case JobKind::MC_MotionInVelocity:
      return job.position_controlled ? ErrorId::towards_fixed_stop : ErrorId::fixed_stop_position_control;
    default:  // nobody knows which way it will go
      return ErrorId::towards_fixed_stop;
  }
}

}  // namespace lockstep
