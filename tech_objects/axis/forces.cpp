// Torque limiting, torque data and the fixed stop of an axis with a drive.
// @source S7-1500T axis functions, force and torque limiting, fixed stop detection, torque data
#include <cmath>
#include <limits>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/target_distance.hpp"

namespace lockstep {
namespace {

/// Part of the limit from which on the drive counts as limited.
constexpr double kInLimitation = 0.9;
constexpr double kTwoPi = 6.283185307179586;

struct Factor {
  UDINT unit;
  double factor;
};
constexpr Factor kMetres[] = {{1010, 1.0},  {1013, 1e-3},   {1536, 1e-3},   {1011, 1e3},     {1014, 1e-6},
                              {1015, 1e-9}, {1019, 0.0254}, {1018, 0.3048}, {1021, 1609.344}};
constexpr Factor kNewtons[] = {
    {1120, 1.0}, {1122, 1e3}, {1094, 4.4482216152605}, {1093, 0.278013850953781}, {1535, 0.138254954376}};
constexpr Factor kNewtonMetres[] = {{1126, 1.0},
                                    {1128, 1e3},
                                    {1529, 0.1129848290276167},
                                    {1530, 1.3558179483314004},
                                    {1531, 0.00706155181422604},
                                    {1532, 0.0847386217707125},
                                    {1533, 0.0035116758411504},
                                    {1534, 0.0421401100938048}};

template <std::size_t N>
double factor_of(const Factor (&table)[N], UDINT unit) noexcept {
  for (const Factor& row : table)
    if (row.unit == unit) return row.factor;
  return 1.0;
}

}  // namespace

// ---- Limits
// ------------------------------------------------------------------------------------------------------

ErrorId Axis::torque_limiting_refusal(DINT mode) const noexcept {
  if (!has_drive_) return ErrorId::no_torque_reduction;
  if (forces_.range.owner != nullptr) return ErrorId::torque_limits_exclude;
  if (mode == 1 && !enabled()) return ErrorId::locked;
  return ErrorId::none;
}

ErrorId Axis::torque_range_refusal() const noexcept {
  if (!has_drive_ || !data.Actor.Interface.EnableTorqueData) return ErrorId::no_torque_data;
  return forces_.limiting.owner != nullptr ? ErrorId::torque_limits_exclude : ErrorId::none;
}

ErrorId Axis::torque_additive_refusal() const noexcept {
  if (!has_drive_ || !data.Actor.Interface.EnableTorqueData) return ErrorId::no_torque_data;
  return enabled() ? ErrorId::none : ErrorId::locked;
}

/// Limit of MC_TorqueLimiting as torque (force) at the motor.
double Axis::limit_at_motor() const noexcept {
  const bool linear_motor = data.Actor.MotorType == 1;
  const bool at_load = data.TorqueLimiting.LimitBase == 1 && !linear_motor;
  const bool force = linear_motor || (at_load && data.Properties.MotionType == 0);
  const auto& defaults = data.TorqueLimiting.LimitDefaults;
  const double given = forces_.limiting.limit;
  const double limit = given >= 0.0 ? given : force ? defaults.Force : defaults.Torque;
  if (!at_load) return limit;
  const double ratio = static_cast<double>(data.LoadGear.Numerator) / data.LoadGear.Denominator;
  const double through = ratio * data.Actor.Efficiency;
  if (through <= 0.0) return std::numeric_limits<double>::infinity();
  if (!force) return limit / through;
  const double screw = data.Mechanics.LeadScrew * factor_of(kMetres, data.Units.LengthUnit) / kTwoPi;
  const double units =
      factor_of(kNewtons, data.Units.ForceUnit) / factor_of(kNewtonMetres, data.Units.TorqueUnit);
  return limit * units * screw / through;
}

/// What the motor may make, in the direction of the axis.
TorqueBand Axis::torque_band() const noexcept {
  if (forces_.limiting.owner != nullptr) {
    const double limit = limit_at_motor();
    return {-limit, limit};
  }
  if (forces_.range.owner != nullptr) return {forces_.range.lower, forces_.range.upper};
  return {};
}

bool Axis::position_monitoring_off() const noexcept {
  return forces_.limited() && data.TorqueLimiting.PositionBasedMonitors == 0;
}

/// Each interpolator cycle of an axis with a drive, before it moves.
void Axis::step_forces() noexcept {
  if (!forces_.active() && !forces_.command_shown) return;
  if (forces_.limiting.owner != nullptr && forces_.limiting.mode == 1)
    watch_fixed_stop();
  else
    leave_fixed_stop();
  const TorqueBand band = torque_band();
  const bool adds = forces_.additive.owner != nullptr && enabled();
  TorqueCommand command{band, adds ? forces_.additive.value : 0.0};
  if (setpoint_sign_ < 0.0) command = {{-band.upper, -band.lower}, -command.additive};
  drive_.command_torque(command);
  const double torque = std::abs(actual_torque_);
  forces_.in_limitation = forces_.limiting.owner != nullptr && drive_.has_plant() && drive_running_ &&
                          torque >= kInLimitation * band.upper;
  show_forces();
  forces_.command_shown = forces_.active();
}

void Axis::show_forces() noexcept {
  set_bit(data.StatusWord, StatusBit::TorqueLimitingCommand, forces_.limiting.owner != nullptr);
  set_bit(data.StatusWord, StatusBit::InLimitation, forces_.in_limitation);
  set_bit(data.StatusWord, StatusBit::InClamping, forces_.in_clamping);
  data.StatusTorqueData.CommandAdditiveTorqueActive = forces_.additive.owner != nullptr ? 1 : 0;
  data.StatusTorqueData.CommandTorqueRangeActive = forces_.range.owner != nullptr ? 1 : 0;
}

// ---- Fixed stop
// --------------------------------------------------------------------------------------------------

/// The axis pushes against something: it lags behind a setpoint that moves on, or that it should have
/// reached.
bool Axis::pushes_against_a_stop() const noexcept {
  const double error = data.StatusPositioning.FollowingError;
  if (!(std::abs(error) > data.Clamping.FollowingErrorDeviation)) return false;
  if (power_state_ != PowerState::on || !position_controlled_ || motion_ == Motion::none) return false;
  if (setpoint_.velocity != 0.0) return setpoint_.velocity * error > 0.0;
  if (motion_ != Motion::single_axis) return jobs_[kBase] != nullptr || led();
  // A job that has only just begun may lead away from what the axis pushes against already.
  return jobs_[kBase] != nullptr && (single_.finished() || single_.way_left(error > 0.0 ? 1 : -1) > 0.0);
}

void Axis::watch_fixed_stop() noexcept {
  if (forces_.stop_side != 0) return watch_clamping();
  if (!pushes_against_a_stop()) return;
  forces_.stop_side = data.StatusPositioning.FollowingError > 0.0 ? 1 : -1;
  forces_.clamped_at = actual_;
  forces_.in_clamping = true;
  end_all_jobs(JobPhase::aborted, ErrorId::none);
  freeze_setpoint();
}

/// The setpoint stays where it is, and with it the following error: a published step of the velocity.
void Axis::freeze_setpoint() noexcept {
  absorb_superimposed();
  leave_synchronous();
  motion_ = Motion::single_axis;
  setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  last_setpoint_ = setpoint_;  // the fine interpolation has nothing left to do
  single_.stand(setpoint_);
}

void Axis::watch_clamping() noexcept {
  if (power_state_ != PowerState::on) return leave_fixed_stop();
  const double moved = difference(actual_, forces_.clamped_at, modulo_).rounded();
  forces_.in_clamping = std::abs(moved) <= data.Clamping.PositionTolerance;
  const bool has_job = jobs_[kBase] != nullptr || jobs_[kSuperimposed] != nullptr;
  if (forces_.in_clamping) {
    if (!has_job || forces_.stop_side * setpoint_.velocity <= 0.0) return;
    // A job that has been let go away from the stop has turned towards it.
    end_all_jobs(JobPhase::failed, ErrorId::towards_fixed_stop);
    freeze_setpoint();
    return;
  }
  const bool retreats = forces_.stop_side * moved < 0.0 && has_job;
  leave_fixed_stop();
  if (!retreats) raise(alarm::kClamping);
}

void Axis::leave_fixed_stop() noexcept {
  forces_.stop_side = 0;
  forces_.in_clamping = false;
}

/// Whether a job may start at the fixed stop: only motions away from it, under position control.
ErrorId Axis::check_at_fixed_stop(const Job& job) const noexcept {
  const int side = forces_.stop_side;
  switch (job.kind) {
    case JobKind::MC_Halt:
    case JobKind::MC_Stop:
    case JobKind::MC_HaltSuperimposed:
      return ErrorId::none;
    case JobKind::MC_MoveAbsolute:
      return away_from_stop(absolute_distance(job, setpoint_.position.value, modulo_), side);
    case JobKind::MC_MoveRelative:
    case JobKind::MC_MoveSuperimposed:
      return away_from_stop(job.position, side);
    case JobKind::MC_MoveVelocity:
      if (!job.position_controlled) return ErrorId::fixed_stop_position_control;
      return away_from_stop(job.current ? 0.0 : job.velocity, side);
    case JobKind::MC_MoveJog:
      if (!job.position_controlled) return ErrorId::fixed_stop_position_control;
      return away_from_stop(job.direction, side);
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

ErrorId Axis::away_from_stop(double way, int side) noexcept {
  return side * way > 0.0 ? ErrorId::towards_fixed_stop : ErrorId::none;
}

}  // namespace lockstep
