#include "tech_objects/axis/job_checks.hpp"

#include "tech_objects/axis/coupling_chain.hpp"
#include "tech_objects/axis/direct_homing.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

ErrorId JobChecks::refusal(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_Home) return check_homing(job);
  const bool stronger = job.kind == JobKind::MC_Stop && JobSlots::stop_rank(job.as<StopJob>().mode) >=
                                                            static_cast<int>(data.ErrorDetail.Reaction);
  if (data.ErrorDetail.Number != 0 && !stronger) return ErrorId::technology_alarm;
  if (power_state_ != PowerState::on) return ErrorId::locked;
  if (jobs_.locked() && job.kind != JobKind::MC_Stop) return ErrorId::locked;
  if (const ErrorId error = check_synchronous(job); error != ErrorId::none) return error;
  const bool at_once = job.buffer_mode == BufferMode::mcAborting || jobs_[kBase] == nullptr;
  return at_once ? motion_orders_.refusal(job) : ErrorId::none;
}

/// Conditions of synchronous jobs, and of values given on top of a motion.
ErrorId JobChecks::check_synchronous(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MotionInSuperimposed && !position_controlled_)
    return led(motion_) ? ErrorId::velocity_gear_active : ErrorId::not_position_controlled;
  if (!couples(job.kind) && !is_shift(job.kind) && !leaves(job.kind)) return ErrorId::none;
  if (simulated_ != nullptr) return ErrorId::simulated;
  if (couples(job.kind)) {
    const LeadingObject* const master = master_of(job);
    if (master == &self_) return ErrorId::recursive_coupling;
    // A waiting job couples nothing yet; it is looked at again when it would become active.
    const bool recursive = !couples_at_position(job.kind) && led_by(self_, master);
    if (recursive) return ErrorId::recursive_coupling;
    return job.kind == JobKind::MC_CamIn ? check_cam(job) : ErrorId::none;
  }
  const Job* base = jobs_[kBase];
  if (base != nullptr && base->kind == JobKind::MC_GearInVelocity) return ErrorId::velocity_gear_active;
  const bool cam_out = job.kind == JobKind::MC_CamOut;
  if (leaves(job.kind) && !jobs_.runs_or_waits(cam_out)) return cam_out ? ErrorId::no_cam : ErrorId::no_gear;
  if (leaves(job.kind)) return ErrorId::none;
  const auto& shift = job.as<ShiftJob>();
  if (shift.profile == ShiftProfileReference::cancel_waiting) return ErrorId::none;
  const bool in_time = is_phasing(job.kind) && shift.profile == ShiftProfileReference::dynamics;
  if (in_time && base != nullptr && base->kind == JobKind::MC_CamIn) return ErrorId::phasing_in_time;
  if (motion_ != AxisMotion::synchronous) return ErrorId::not_synchronous;
  // A leading axis that is not interconnected at all is an alarm.
  const bool of_another = is_phasing(job.kind) && shift.master != coupled_.leading &&
                          find_leading_value(leading_values, shift.master) != nullptr;
  return of_another ? ErrorId::not_synchronous : ErrorId::none;
}

ErrorId JobChecks::check_cam(const Job& job) const noexcept {
  const auto& asked = job.as<CamJob>();
  if (asked.cam->restarting()) return ErrorId::restarting;
  if (asked.cam->in_interpolation()) return ErrorId::cam_in_interpolation;
  const Job* base = jobs_[kBase];
  const bool camming =
      base != nullptr && base->kind == JobKind::MC_CamIn && motion_ == AxisMotion::synchronous;
  return asked.profile == SyncProfileReference::at_cam_end && !camming ? ErrorId::no_camming : ErrorId::none;
}

ErrorId JobChecks::check_homing(const Job& job) const noexcept {
  const JobClass kind = class_of(job, true);
  if (kind == JobClass::home_cancel) return ErrorId::none;
  const bool seeks = kind == JobClass::home_active || kind == JobClass::home_passive;
  const HomeMode mode = job.as<HomingJob>().mode;
  if ((seeks || mode == HomeMode::adjust_incremental) && data.ErrorDetail.Number != 0)
    return ErrorId::technology_alarm;
  if (seeks && (power_state_ != PowerState::on || jobs_.locked())) return ErrorId::locked;
  if (adjusts_encoder(mode)) {
    const std::size_t sensor = sensors_.sensor_of(job);
    if (!data.Sensor[sensor].Existent) return ErrorId::sensor;
    const bool absolute = data.Sensor[sensor].Type != SensorType::INCREMENTAL;
    if (mode == HomeMode::adjust_incremental && absolute) return ErrorId::homing_mode_absolute;
    if (mode != HomeMode::adjust_incremental && !absolute) return ErrorId::homing_mode_incremental;
    if (data.StatusSensor[sensor].State != SensorState::valid) return ErrorId::actual_values_invalid;
  }
  const Job* base = jobs_[kBase];
  const JobKind running = base != nullptr ? base->kind : JobKind::MC_Halt;
  if (kind != JobClass::home_active && !position_controlled_ && power_state_ != PowerState::off)
    return ErrorId::not_position_controlled;
  if (kind == JobClass::home_passive && running == JobKind::MC_Home) return ErrorId::locked;
  const bool placed =
      couples_at_position(running) || (simulated_ != nullptr && couples_at_position(simulated_->kind));
  const bool coupled = placed || (leaves(running) && kind == JobClass::home_active);
  return coupled ? ErrorId::homing_while_coupled : ErrorId::none;
}

MissingPrecondition JobChecks::missing_precondition(const Job& job) const noexcept {
  if (job.kind == JobKind::MC_MoveAbsolute && !homed_) return {alarm::kNotHomed};
  if (job.kind == JobKind::MC_Home) return missing_for_homing(job);
  if (!couples(job.kind) && !is_phasing(job.kind)) return {};
  const LeadingObject* const master = master_of(job);
  const std::uint16_t leader = master != nullptr ? static_cast<std::uint16_t>(master->number) : 0;
  const LeadingValue* leading = find_leading_value(leading_values, master);
  if (leading == nullptr) return {alarm::kLeadingAxis, {.cause = AlarmCause::not_assigned, .object = leader}};
  if (is_phasing(job.kind)) return {};
  if (!master->actual_values_valid())
    return {alarm::kLeadingAxis, {.cause = AlarmCause::values_invalid, .object = leader}};
  if (job.kind == JobKind::MC_CamIn && !job.as<CamJob>().cam->interpolated())
    return {alarm::kCamNotInterpolated, {.object = static_cast<std::uint16_t>(job.as<CamJob>().cam->number)}};
  const bool controlled = job.kind == JobKind::MC_GearInVelocity || master->position_controlled() ||
                          leading->coupling != Coupling::setpoint;
  if (!controlled) return {alarm::kLeadingAxisNotPositionControlled, {.object = leader}};
  if (couples_at_position(job.kind) && !homed_) return {alarm::kNotHomed};
  return {};
}

/// What active and passive homing need and do not find.
MissingPrecondition JobChecks::missing_for_homing(const Job& job) const noexcept {
  const JobClass kind = class_of(job, true);
  const bool active = kind == JobClass::home_active;
  if (!active && kind != JobClass::home_passive) return {};
  const double approach = data.Homing.ApproachVelocity, referencing = data.Homing.ReferencingVelocity;
  if (active && !(approach > 0.0))
    return {alarm::kHomingData, {.cause = AlarmCause::approach_velocity, .value = approach, .limit = 0.0}};
  if (active && !(referencing > 0.0))
    return {alarm::kHomingData,
            {.cause = AlarmCause::referencing_velocity, .value = referencing, .limit = 0.0}};
  if (!has_drive_) return {};
  const std::size_t sensor = encoders_.operative();
  const auto mark = static_cast<HomingMark>(active ? data.Sensor[sensor].ActiveHoming.Mode
                                                   : data.Sensor[sensor].PassiveHoming.Mode);
  const AlarmCause missing = missing_mark(mark, switches_.home_switch(active), drive_->signals());
  if (missing == AlarmCause::none) return {};
  return {alarm::kHomingNotSupported, {.cause = missing, .sensor = static_cast<std::uint8_t>(sensor + 1)}};
}

}  // namespace lockstep
