// Torque limiting, torque data and the fixed stop of an axis with a drive.
// @source S7-1500T axis functions, force and torque limiting, fixed stop detection, torque data
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/target_distance.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

// ---- Limits
// ------------------------------------------------------------------------------------------------------

ErrorId Axis::torque_limiting_refusal(TorqueLimitingMode mode) const noexcept {
  return has_drive_ ? forces_.limiting_refusal(mode, enabled()) : ErrorId::no_torque_reduction;
}

ErrorId Axis::torque_range_refusal() const noexcept {
  if (!has_drive_ || !data.Actor.Interface.EnableTorqueData) return ErrorId::no_torque_data;
  return forces_.range_refusal();
}

ErrorId Axis::torque_additive_refusal() const noexcept {
  if (!has_drive_ || !data.Actor.Interface.EnableTorqueData) return ErrorId::no_torque_data;
  return enabled() ? ErrorId::none : ErrorId::locked;
}

bool AxisOrders::position_monitoring_off() const noexcept {
  return forces_.limited() && data.TorqueLimiting.PositionBasedMonitors == PositionBasedMonitors::deactivated;
}

/// Each interpolator cycle of an axis with a drive, before it moves.
void AxisOrders::step_forces() noexcept {
  if (!forces_.due()) return;
  if (forces_.detects_fixed_stop())
    watch_fixed_stop();
  else
    clamping_.leave();
  TorqueCommand command = forces_.command(data, enabled());
  if (setpoint_sign_ < 0.0) command = {{-command.band.upper, -command.band.lower}, -command.additive};
  drive_->command_torque(command);
  forces_.watch_limitation(actual_torque_, drive_properties_.tells_torque && drive_running_);
  forces_.show(data, clamping_.holds());
}

// ---- Fixed stop
// --------------------------------------------------------------------------------------------------

/// The axis pushes against something: it lags behind a setpoint that moves on, or that it should have
/// reached.
bool AxisOrders::pushes_against_a_stop() const noexcept {
  const double error = data.StatusPositioning.FollowingError;
  if (!(std::abs(error) > data.Clamping.FollowingErrorDeviation)) return false;
  if (power_state_ != PowerState::on || !position_controlled_ || motion_ == Motion::none) return false;
  if (setpoint_.velocity != 0.0) return setpoint_.velocity * error > 0.0;
  if (motion_ != Motion::single_axis) return jobs_[kBase] != nullptr || led();
  // A job that has only just begun may lead away from what the axis pushes against already.
  return jobs_[kBase] != nullptr && (single_.finished() || single_.way_left(error > 0.0 ? 1 : -1) > 0.0);
}

void AxisOrders::watch_fixed_stop() noexcept {
  if (clamping_.found()) return watch_clamping();
  if (!pushes_against_a_stop()) return;
  clamping_.find(data.StatusPositioning.FollowingError > 0.0 ? 1 : -1, actual_);
  end_all_jobs(JobPhase::aborted, ErrorId::none);
  freeze_setpoint();
}

/// The setpoint stays where it is, and with it the following error: a published step of the velocity.
void AxisOrders::freeze_setpoint() noexcept {
  absorb_superimposed();
  leave_synchronous();
  motion_ = Motion::single_axis;
  setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  last_setpoint_ = setpoint_;  // the fine interpolation has nothing left to do
  single_.stand(setpoint_);
}

void AxisOrders::watch_clamping() noexcept {
  if (power_state_ != PowerState::on) return clamping_.leave();
  const bool has_job = jobs_[kBase] != nullptr || jobs_[kSuperimposed] != nullptr;
  switch (clamping_.watch(actual_, modulo_, data.Clamping.PositionTolerance, setpoint_.velocity, has_job)) {
    case Clamping::Outcome::held:
      break;
    case Clamping::Outcome::turned_to:
      end_all_jobs(JobPhase::failed, ErrorId::towards_fixed_stop);
      freeze_setpoint();
      break;
    case Clamping::Outcome::torn_away:
      raise(alarm::kClamping);
      break;
  }
}

/// Whether a job may start at the fixed stop: only motions away from it, under position control.
ErrorId AxisOrders::check_at_fixed_stop(const Job& job) const noexcept {
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

ErrorId AxisOrders::away_from_stop(double way, int side) noexcept {
  return side * way > 0.0 ? ErrorId::towards_fixed_stop : ErrorId::none;
}

}  // namespace lockstep
