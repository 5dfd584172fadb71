// MC_Home: direct setting of positions, homing with a mark in passing or by a motion of its own, encoder
// adjustment.
#include <cmath>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {
namespace {

bool mode_is(const Job& job, std::initializer_list<DINT> modes) noexcept {
  for (const DINT mode : modes)
    if (job.mode == mode) return true;
  return false;
}

/// Modes that adjust an encoder: relative and absolute, incremental encoder.
bool adjusts_encoder(const Job& job) noexcept {
  return mode_is(job, {6, 7, 13});
}

}  // namespace

// ---- Taking a job over
// ------------------------------------------------------------------------------------------

ErrorId Axis::check_homing(const Job& job) const noexcept {
  const JobClass kind = class_of(job, true);
  if (kind == JobClass::home_cancel) return ErrorId::none;
  const bool seeks = kind == JobClass::home_active || kind == JobClass::home_passive;
  if ((seeks || job.mode == 13) && pending_alarm() != 0) return ErrorId::technology_alarm;
  if (seeks && (!enabled() || locked_by_stop())) return ErrorId::locked;
  if (adjusts_encoder(job)) {
    const std::size_t sensor = sensor_of(job);
    if (!data.Sensor[sensor].Existent) return ErrorId::sensor;
    const bool absolute = data.Sensor[sensor].Type != 0;
    if (job.mode == 13 && absolute) return ErrorId::homing_mode_absolute;
    if (job.mode != 13 && !absolute) return ErrorId::homing_mode_incremental;
    if (data.StatusSensor[sensor].State != kSensorValid) return ErrorId::actual_values_invalid;
  }
  const Job* base = running_[kBase];
  const JobKind running = base != nullptr ? base->kind : JobKind::MC_Halt;
  if (kind != JobClass::home_active && !position_controlled_ && !off())
    return ErrorId::not_position_controlled;
  if (kind == JobClass::home_passive && running == JobKind::MC_Home) return ErrorId::locked;
  const bool placed =
      couples_at_position(running) || (simulated_ != nullptr && couples_at_position(simulated_->kind));
  const bool coupled = placed || (leaves(running) && kind == JobClass::home_active);
  return coupled ? ErrorId::homing_while_coupled : ErrorId::none;
}

/// Alarm for what active and passive homing need and do not find; 0: all is there.
int Axis::missing_for_homing(const Job& job) const noexcept {
  const JobClass kind = class_of(job, true);
  const bool active = kind == JobClass::home_active;
  if (!active && kind != JobClass::home_passive) return 0;
  if (active && !(data.Homing.ApproachVelocity > 0.0 && data.Homing.ReferencingVelocity > 0.0))
    return alarm::kHomingData;
  if (!has_drive_) return 0;
  const auto mark = static_cast<HomingMark>(active ? data.Sensor[operative_].ActiveHoming.Mode
                                                   : data.Sensor[operative_].PassiveHoming.Mode);
  return has_mark(mark, home_switch(active), drive_settings.signals) ? 0 : alarm::kHomingNotSupported;
}

HomeSwitch Axis::home_switch(bool active) const noexcept {
  const auto& sensor = data.Sensor[operative_];
  if (active) return {sensor.ActiveHoming.DigitalInputAddress, sensor.ActiveHoming.SwitchLevel};
  return {sensor.PassiveHoming.DigitalInputAddress, sensor.PassiveHoming.SwitchLevel};
}

void Axis::home(Job& job) noexcept {
  switch (class_of(job, true)) {
    case JobClass::home_cancel:  // the override rules have ended what it ends
      job.phase = JobPhase::done;
      break;
    case JobClass::home_passive:
      begin_passive_homing(job);
      break;
    case JobClass::home_active:
      begin_active_homing(job);
      break;
    default:
      home_directly(job);
      break;
  }
  if (job.phase != JobPhase::failed) count_homing(job);
}

// ---- Direct homing and encoder adjustment
// -----------------------------------------------------------------------

/// Setpoint and actual position are shifted together; nothing moves.
void Axis::home_directly(Job& job) noexcept {
  if (adjusts_encoder(job) && sensor_of(job) != operative_) return home_sensor_beside(job);
  const bool to_setpoint = job.mode == 11;
  const bool relative = mode_is(job, {1, 6, 12});
  const double by = relative      ? job.position
                    : to_setpoint ? shortest_distance(setpoint_.position.value, job.position, modulo_)
                                  : position_shift(job.position);
  if (!positions_fit(by)) return job.fail(ErrorId::position);
  shift_positions(by);
  if (!adjusts_encoder(job)) shift_sensors_beside(by);
  if (to_setpoint || (!relative && !has_drive_)) {
    // No following error in between: the setpoint is the given position to the last bit.
    const AxisPosition exact = normalised({setpoint_.position.turns, job.position}, modulo_);
    setpoint_.position.value = exact.value;
    const bool idle = running_[kBase] == nullptr && !superimposed_.in_use();
    if (setpoint_.standing() && motion_ == Motion::single_axis && idle) single_.stand(setpoint_);
    if (!has_drive_) actual_ = setpoint_.position;
  }
  if (job.mode == 7) counted_from_ = actual_.turns;
  show_renamed();
  if (adjusts_encoder(job)) adjust_encoder(operative_, true);
  homed_ = true;
  job.mark_position = relative ? actual_.value : job.position;
  job.phase = JobPhase::done;
}

/// Whether the axis could still be used if it were shifted: inside the numeric range, and on its ring.
bool Axis::positions_fit(double by) const noexcept {
  const double shifted = advanced(setpoint_.position, by, modulo_).value;
  return std::isfinite(by) && std::abs(shifted) <= kPositionRange && modulo_.contains(shifted);
}

/// Modes 6, 7, 13 at an encoder that is not operative: only what that one tells changes.
void Axis::home_sensor_beside(Job& job) noexcept {
  const std::size_t sensor = sensor_of(job);
  Encoder& encoder = encoders_[sensor];
  const double by =
      job.mode == 6 ? job.position : shortest_distance(encoder.seen.value, job.position, modulo_);
  if (!std::isfinite(by) || !modulo_.contains(advanced(encoder.seen, by, modulo_).value))
    return job.fail(ErrorId::position);
  encoder.origin = advanced(encoder.origin, by - encoder.lent, modulo_);
  encoder.seen = advanced(encoder.seen, by, modulo_);
  encoder.lent = 0.0;
  show_place(sensor, encoder.seen);
  adjust_encoder(sensor, true);
  job.mark_position = job.mode == 6 ? encoder.seen.value : job.position;
  job.phase = JobPhase::done;
}

/// The encoder that a job is about; 0: the operative one.
std::size_t Axis::sensor_of(const Job& job) const noexcept {
  return job.sensor > 0 ? static_cast<std::size_t>(job.sensor - 1) : operative_;
}

void Axis::shift_sensors_beside(double by) noexcept {
  if (!several_encoders_) return;
  for (std::size_t i = 0; i < kSensors; ++i) {
    if (i == operative_) continue;
    encoders_[i].origin = advanced(encoders_[i].origin, by, modulo_);
    encoders_[i].seen = advanced(encoders_[i].seen, by, modulo_);
  }
}

/// The encoder is adjusted to the positions as they are now.
/// @param store whether an offset of an absolute encoder that is kept already is replaced
void Axis::adjust_encoder(std::size_t sensor, bool store) noexcept {
  data.StatusSensor[sensor].Adjusted = 1;
  EncoderAdjustment& kept = encoder_adjustments[sensor];
  if (!absolute_encoder(sensor) || (kept.adjusted && !store)) return;
  const AxisPosition origin = sensor == operative_ ? encoder_origin_ : encoders_[sensor].origin;
  const DoubleDouble turns =
      modulo_.enabled ? to_double_double(origin.turns - counted_from_) * modulo_.length : DoubleDouble{};
  const DoubleDouble offset = turns + two_difference(origin.value, encoder_start(sensor));
  kept = {true, offset.rounded()};
  data.StatusSensor[sensor].AbsEncoderOffset = kept.offset;
}

/// What an absolute encoder reports where the machine is at the beginning [u].
double Axis::encoder_start(std::size_t sensor) const noexcept {
  const double sign = sensor == operative_ ? encoder_sign_ : encoders_[sensor].sign;
  return sign * (sensor == 0 ? drive_settings.signals.start_position : sensor_model(sensor).start_position);
}

/// At the start and after a restart an absolute encoder tells where the axis is.
void Axis::restore_encoder(std::size_t sensor) noexcept {
  if (!absolute_encoder(sensor)) return;
  EncoderAdjustment& kept = encoder_adjustments[sensor];
  if (!kept.adjusted || !std::isfinite(kept.offset)) kept = {};
  const DoubleDouble place = two_sum(encoder_start(sensor), kept.offset);
  const AxisPosition origin = normalised(0, place, modulo_);
  data.StatusSensor[sensor].AbsEncoderOffset = kept.offset;
  data.StatusSensor[sensor].Adjusted = kept.adjusted ? 1 : 0;
  if (sensor != operative_) {
    encoders_[sensor].origin = origin;
    return;
  }
  const double by = rounded_difference(origin, encoder_origin_, modulo_);
  shift_positions(by);
  encoder_origin_ = origin;
  counted_from_ = 0;
  homed_ = kept.adjusted;
}

// ---- Homing with a mark
// -----------------------------------------------------------------------------------------

/// Beside whatever moves the axis.
void Axis::begin_passive_homing(Job& job) noexcept {
  if (job.mode == 10) job.position = data.Homing.HomePosition;
  if (!positions_fit(position_shift(job.position))) return job.fail(ErrorId::position);
  end_job(kPassiveHoming, JobPhase::aborted, ErrorId::none);
  running_[kPassiveHoming] = &job;
  job.phase = JobPhase::active;
  homing_now_ = true;
  if (job.mode != 2) homed_ = false;
  if (has_drive_) search_mark(false, passive_direction(data.Sensor[operative_].PassiveHoming.Direction));
}

void Axis::begin_active_homing(Job& job) noexcept {
  const auto& settings = data.Sensor[operative_].ActiveHoming;
  if (job.mode == 5) job.position = data.Homing.HomePosition;
  const double mark = job.position - settings.HomePositionOffset;
  if (!positions_fit(position_shift(mark)) || !positions_fit(position_shift(job.position)))
    return job.fail(ErrorId::position);
  // What acts on a coupling ends with it.
  for (const Slot slot : {kPhasing, kOffset, kWaitingOut}) end_job(slot, JobPhase::aborted, ErrorId::none);
  homed_ = false;
  homing_now_ = true;
  homing_ = {.phase = HomingPhase::search,
             .direction = settings.Direction == 0 ? 1 : -1,
             .mark = mark,
             .approach_velocity = data.Homing.ApproachVelocity,
             .referencing_velocity = data.Homing.ReferencingVelocity,
             .positive_side = settings.SideInput};
  job.direction = homing_.direction;
  job.velocity = homing_.referencing_velocity;
  if (!has_drive_) {  // it has no marks: one is taken to be where it is
    homing_.phase = HomingPhase::travel;
    job.mark_position = mark;
    assign_position(actual_, mark);
  } else if (settings.Mode != static_cast<DINT>(HomingMark::zero_mark)) {
    homing_.phase = HomingPhase::approach;
    job.direction = data.Homing.ApproachDirection ? -1 : 1;
  }
  if (homing_.phase != HomingPhase::search) job.velocity = homing_.approach_velocity;
  if (has_drive_) search_mark(true, homing_.direction);
  begin_base_motion(job);
  if (!job.running()) leave_homing(job);
}

PlanResult Axis::plan_homing(const Job& job, const Dynamics& dynamics) noexcept {
  if (homing_.phase != HomingPhase::travel)
    return single_.run_at(setpoint_, job.direction * dynamics.velocity, dynamics);
  return move_by(to_double_double(shortest_distance(setpoint_.position.value, job.position, modulo_)), job,
                 dynamics);
}

void Axis::search_mark(bool active, int direction) noexcept {
  const auto& sensor = data.Sensor[operative_];
  const DINT mark = active ? sensor.ActiveHoming.Mode : sensor.PassiveHoming.Mode;
  const bool positive_side = active ? homing_.positive_side : sensor.PassiveHoming.SideInput;
  // The machine may lie the other way round than the axis counts.
  begin_search(mark_search_, static_cast<HomingMark>(mark), direction, positive_side,
               encoder_sign_ * encoder_ratio() < 0.0);
  on_home_switch_ = false;
  signals_watched_ = true;
}

/// Each interpolator tick of a homing, before the setpoint is made.
void Axis::step_homing() noexcept {
  Job* base = running_[kBase];
  const bool active = base != nullptr && base->kind == JobKind::MC_Home;
  if (active && homing_.phase == HomingPhase::travel) return;
  if (!has_drive_ || (mark_search_.found() && homing_.phase != HomingPhase::back)) return take_mark();
  if (active) guide_active_homing(*base);
}

/// From one phase of an active homing to the next.
void Axis::guide_active_homing(Job& job) noexcept {
  const int direction = homing_.direction;
  if (homing_reverses() && limit_switches_[job.direction > 0 ? 1 : 0].pressed)
    return reverse_at_limit_switch(job);
  const auto& settings = data.Sensor[operative_].ActiveHoming;
  switch (homing_.phase) {
    case HomingPhase::approach: {
      if (!on_home_switch_) break;
      // An edge that is met from outside, in the homing direction, is left behind first.
      const bool met_from_outside = settings.Mode == static_cast<DINT>(HomingMark::switch_edge) &&
                                    (homing_.positive_side ? 1 : -1) != direction;
      if (met_from_outside) return head_for(job, HomingPhase::clear, -direction);
      return head_for(job, HomingPhase::search, direction);
    }
    case HomingPhase::clear:
      if (!on_home_switch_) head_for(job, HomingPhase::search, direction);
      break;
    case HomingPhase::back:
      if (!mark_search_.found()) break;
      search_mark(true, direction);
      return head_for(job, HomingPhase::search, direction);
    default:
      break;
  }
}

/// Once: on the way to the switch the other way is tried; a zero mark is looked for beyond, to be met in the
/// homing direction.
void Axis::reverse_at_limit_switch(Job& job) noexcept {
  const bool to_zero_mark =
      data.Sensor[operative_].ActiveHoming.Mode == static_cast<DINT>(HomingMark::zero_mark);
  const bool can_turn =
      homing_.phase == HomingPhase::approach || (homing_.phase == HomingPhase::search && to_zero_mark);
  if (homing_.reversed || !can_turn) return raise(alarm::kMarkNotFound);
  homing_.reversed = true;
  if (homing_.phase == HomingPhase::approach) return head_for(job, HomingPhase::approach, -job.direction);
  search_mark(true, -homing_.direction);
  head_for(job, HomingPhase::back, -homing_.direction);
}

void Axis::head_for(Job& job, HomingPhase phase, int direction) noexcept {
  homing_.phase = phase;
  job.direction = direction;
  job.velocity = phase == HomingPhase::search ? homing_.referencing_velocity : homing_.approach_velocity;
  in_window_ticks_ = 0;
  since_target_ticks_ = 0;
  remember_limits();
  Dynamics dynamics = own_dynamics(job);
  if (const int alarm_number = zero_limit(dynamics); alarm_number != 0) return raise(alarm_number);
  if (advancing_base_) leave_to_superimposed(&job, dynamics);
  if (plan(job, dynamics) == PlanResult::ok) return;
  end_job(kBase, JobPhase::failed, ErrorId::unspecified);
  begin_stop(maximum_dynamics(), false);
}

/// The mark has been passed; a virtual axis has none, and takes the place where it is.
void Axis::take_mark() noexcept {
  const DoubleDouble way = two_difference(mark_search_.place(), drive_settings.signals.start_position);
  const double backlash = operative_ == 0 ? backlash_offset() : 0.0;
  const DoubleDouble load_way = way * (encoder_ratio() * encoder_sign_) - DoubleDouble{backlash, 0.0};
  const AxisPosition place = has_drive_ ? advanced(encoder_origin_, load_way, modulo_) : actual_;
  mark_search_.end();
  Job* const passive = running_[kPassiveHoming];
  Job& job = passive != nullptr ? *passive : *running_[kBase];
  job.mark_position = passive != nullptr ? job.position : homing_.mark;
  if (!assign_position(place, job.mark_position)) return raise(alarm::kHomingNotPossible);
  if (passive != nullptr) return end_job(kPassiveHoming, JobPhase::done, ErrorId::none);
  signals_watched_ = signals_always_watched();
  head_for(job, HomingPhase::travel, 0);
}

/// A place gets a position, and everything is shifted by the difference; the turns are counted anew.
bool Axis::assign_position(AxisPosition place, double position) noexcept {
  const double by = shortest_distance(place.value, position, modulo_);
  if (!positions_fit(by)) return false;
  shift_positions(by);
  shift_sensors_beside(by);
  if (modulo_.enabled && !absolute_encoder()) {
    counted_from_ = first_turn(advanced(place, by, modulo_), modulo_);
  }
  show_renamed();
  homed_ = true;
  adjust_encoder(operative_, false);
  return true;
}

/// What leads the axis has the new names as well, so that nothing moves.
void Axis::shift_coupling(double by) noexcept {
  synchronous_.shift_following(by);
  if (coupled_.cam == nullptr || motion_ == Motion::desynchronizing) return;
  data.StatusSynchronizedMotion.SlaveOffset = synchronous_.following_offset_at_start();
  Job* const offset = running_[kOffset];
  const bool relative = offset != nullptr && offset->kind == JobKind::MC_OffsetRelative;
  if (relative) offset->shift_base = offset->shift_base + by;
}

/// A running homing ends, whatever the reason.
void Axis::leave_homing(const Job& /*job*/) noexcept {
  mark_search_.end();
  homing_ = {};
  homing_now_ = false;
  signals_watched_ = signals_always_watched();
}

// ---- Positions
// --------------------------------------------------------------------------------------------------

/// Way from the actual position to a home position; on a ring the shorter one.
double Axis::position_shift(double home_position) const noexcept {
  return shortest_distance(actual_.value, home_position, modulo_);
}

void Axis::shift_positions(double by) noexcept {
  setpoint_.position = advanced(setpoint_.position, by, modulo_);
  last_setpoint_.position = advanced(last_setpoint_.position, by, modulo_);
  base_.position = advanced(base_.position, by, modulo_);
  actual_ = advanced(actual_, by, modulo_);
  shift_leading(by);
  single_.shift(by);
  // What waits to blend may have another distance to its target: that is where the axis calls it so then.
  if (running_[kBuffered] != nullptr && running_[kBase] != nullptr && motion_ == Motion::single_axis)
    plan_blending();
  shift_coupling(by);
  if (has_drive_) shift_servo(by);
}

/// What has been shown in this tick is where it was, and has other names now: the target of a running
/// positioning, and what MC_Servo shows.
void Axis::show_renamed() noexcept {
  const bool positioning = motion_ == Motion::single_axis && running_[kBase] != nullptr &&
                           single_.aim() == SingleAxisMotion::Aim::position;
  if (positioning) show_target(single_.target());
  if (!has_drive_) return;
  for (std::size_t i = 0; i < kSensors; ++i)
    if (i == operative_ || sensor_exists(i)) show_place(i, sensor_position(i));
}

}  // namespace lockstep
