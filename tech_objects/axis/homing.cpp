// MC_Home: direct setting of positions, homing with a mark in passing or by a motion of its own, encoder
// adjustment.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Modes that adjust an encoder: relative and absolute, incremental encoder.
bool adjusts_encoder(HomeMode mode) noexcept {
  return mode == HomeMode::adjust_absolute_relative || mode == HomeMode::adjust_absolute ||
         mode == HomeMode::adjust_incremental;
}

/// Modes whose position is a distance from where the axis is.
bool is_relative(HomeMode mode) noexcept {
  return mode == HomeMode::direct_relative || mode == HomeMode::adjust_absolute_relative ||
         mode == HomeMode::setpoint_relative;
}

}  // namespace

// ---- Taking a job over
// ------------------------------------------------------------------------------------------

ErrorId AxisOrders::check_homing(const Job& job) const noexcept {
  const JobClass kind = class_of(job, true);
  if (kind == JobClass::home_cancel) return ErrorId::none;
  const bool seeks = kind == JobClass::home_active || kind == JobClass::home_passive;
  const HomeMode mode = job.as<HomingJob>().mode;
  if ((seeks || mode == HomeMode::adjust_incremental) && pending_alarm() != 0)
    return ErrorId::technology_alarm;
  if (seeks && (!enabled() || jobs_.locked())) return ErrorId::locked;
  if (adjusts_encoder(mode)) {
    const std::size_t sensor = sensor_of(job);
    if (!data.Sensor[sensor].Existent) return ErrorId::sensor;
    const bool absolute = data.Sensor[sensor].Type != SensorType::INCREMENTAL;
    if (mode == HomeMode::adjust_incremental && absolute) return ErrorId::homing_mode_absolute;
    if (mode != HomeMode::adjust_incremental && !absolute) return ErrorId::homing_mode_incremental;
    if (data.StatusSensor[sensor].State != SensorState::valid) return ErrorId::actual_values_invalid;
  }
  const Job* base = jobs_[kBase];
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
int AxisOrders::missing_for_homing(const Job& job) const noexcept {
  const JobClass kind = class_of(job, true);
  const bool active = kind == JobClass::home_active;
  if (!active && kind != JobClass::home_passive) return 0;
  if (active && !(data.Homing.ApproachVelocity > 0.0 && data.Homing.ReferencingVelocity > 0.0))
    return alarm::kHomingData;
  if (!has_drive_) return 0;
  const auto mark = static_cast<HomingMark>(active ? data.Sensor[encoders_.operative()].ActiveHoming.Mode
                                                   : data.Sensor[encoders_.operative()].PassiveHoming.Mode);
  return has_mark(mark, home_switch(active), drive_->signals()) ? 0 : alarm::kHomingNotSupported;
}

HomeSwitch AxisOrders::home_switch(bool active) const noexcept {
  const auto& sensor = data.Sensor[encoders_.operative()];
  if (active) return {sensor.ActiveHoming.DigitalInputAddress, sensor.ActiveHoming.SwitchLevel};
  return {sensor.PassiveHoming.DigitalInputAddress, sensor.PassiveHoming.SwitchLevel};
}

void AxisOrders::home(Job& job) noexcept {
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
void AxisOrders::home_directly(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  const bool adjusts = adjusts_encoder(asked.mode);
  if (adjusts && sensor_of(job) != encoders_.operative()) return home_sensor_beside(job);
  const bool to_setpoint = asked.mode == HomeMode::setpoint;
  const bool relative = is_relative(asked.mode);
  const double by = relative      ? asked.position
                    : to_setpoint ? shortest_distance(setpoint_.position.value, asked.position, modulo_)
                                  : position_shift(asked.position);
  if (!positions_fit(by)) return job.fail(ErrorId::position);
  shift_positions(by);
  if (!adjusts) encoders_.shift_beside(by);
  if (to_setpoint || (!relative && !has_drive_)) {
    // No following error in between: the setpoint is the given position to the last bit.
    const AxisPosition exact = normalised({setpoint_.position.turns, asked.position}, modulo_);
    setpoint_.position.value = exact.value;
    const bool idle = jobs_[kBase] == nullptr && !superimposed_.in_use();
    if (setpoint_.standing() && motion_ == Motion::single_axis && idle) single_.stand(setpoint_);
    if (!has_drive_) actual_ = setpoint_.position;
  }
  if (asked.mode == HomeMode::adjust_absolute) counted_from_ = actual_.turns;
  show_renamed();
  if (adjusts) adjust_encoder(encoders_.operative(), true);
  homed_ = true;
  asked.mark_position = relative ? actual_.value : asked.position;
  job.phase = JobPhase::done;
}

/// Whether the axis could still be used if it were shifted: inside the numeric range, and on its ring.
bool AxisOrders::positions_fit(double by) const noexcept {
  const double shifted = advanced(setpoint_.position, by, modulo_).value;
  return std::isfinite(by) && std::abs(shifted) <= kPositionRange && modulo_.contains(shifted);
}

/// Modes 6, 7, 13 at an encoder that is not operative: only what that one tells changes.
void AxisOrders::home_sensor_beside(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  const std::size_t sensor = sensor_of(job);
  const AxisPosition seen = encoders_.position(sensor, actual_);
  const bool relative = asked.mode == HomeMode::adjust_absolute_relative;
  const double by = relative ? asked.position : shortest_distance(seen.value, asked.position, modulo_);
  const AxisPosition renamed = advanced(seen, by, modulo_);
  if (!std::isfinite(by) || !modulo_.contains(renamed.value)) return job.fail(ErrorId::position);
  encoders_.rename(sensor, by);
  show_place(sensor, renamed);
  adjust_encoder(sensor, true);
  asked.mark_position = relative ? renamed.value : asked.position;
  job.phase = JobPhase::done;
}

/// The encoder that a job is about; 0: the operative one.
std::size_t AxisOrders::sensor_of(const Job& job) const noexcept {
  const DINT sensor = job.as<HomingJob>().sensor;
  return sensor > 0 ? static_cast<std::size_t>(sensor - 1) : encoders_.operative();
}

// ---- Homing with a mark
// -----------------------------------------------------------------------------------------

/// Beside whatever moves the axis.
void AxisOrders::begin_passive_homing(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  if (asked.mode == HomeMode::passive_configured) asked.position = data.Homing.HomePosition;
  if (!positions_fit(position_shift(asked.position))) return job.fail(ErrorId::position);
  end_job(kPassiveHoming, JobPhase::aborted, ErrorId::none);
  jobs_.put(kPassiveHoming, job, JobPhase::active);
  homing_now_ = true;
  if (asked.mode != HomeMode::passive) homed_ = false;
  if (has_drive_)
    search_mark(false, passive_direction(data.Sensor[encoders_.operative()].PassiveHoming.Direction));
}

void AxisOrders::begin_active_homing(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  const auto& settings = data.Sensor[encoders_.operative()].ActiveHoming;
  if (asked.mode == HomeMode::active_configured) asked.position = data.Homing.HomePosition;
  const double mark = asked.position - settings.HomePositionOffset;
  if (!positions_fit(position_shift(mark)) || !positions_fit(position_shift(asked.position)))
    return job.fail(ErrorId::position);
  // What acts on a coupling ends with it.
  for (const Slot slot : {kPhasing, kOffset, kWaitingOut}) end_job(slot, JobPhase::aborted, ErrorId::none);
  homed_ = false;
  homing_now_ = true;
  const bool has_switch = settings.Mode != static_cast<DINT>(HomingMark::zero_mark);
  using Phase = HomingCourse::Phase;
  homing_.begin({.direction = settings.Direction == 0 ? 1 : -1,
                 .mark = mark,
                 .approach_velocity = data.Homing.ApproachVelocity,
                 .referencing_velocity = data.Homing.ReferencingVelocity,
                 .positive_side = settings.SideInput},
                // A virtual axis has no marks: one is taken to be where it is.
                !has_drive_  ? Phase::travel
                : has_switch ? Phase::approach
                             : Phase::search);
  job.velocity = homing_.velocity();
  asked.direction = homing_.settings().direction;
  if (!has_drive_) {
    asked.mark_position = mark;
    assign_position(actual_, mark);
  } else {
    if (has_switch) asked.direction = data.Homing.ApproachDirection ? -1 : 1;
    search_mark(true, homing_.settings().direction);
  }
  begin_base_motion(job);
  if (!job.running()) leave_homing();
}

PlanResult AxisOrders::plan_homing(const Job& job, const Dynamics& dynamics) noexcept {
  const auto& asked = job.as<HomingJob>();
  if (!homing_.travels()) return single_.run_at(setpoint_, asked.direction * dynamics.velocity, dynamics);
  return move_by(to_double_double(shortest_distance(setpoint_.position.value, asked.position, modulo_)), job,
                 dynamics);
}

void AxisOrders::search_mark(bool active, int direction) noexcept {
  const auto& sensor = data.Sensor[encoders_.operative()];
  const DINT mark = active ? sensor.ActiveHoming.Mode : sensor.PassiveHoming.Mode;
  const bool positive_side = active ? homing_.settings().positive_side : sensor.PassiveHoming.SideInput;
  homing_.search(static_cast<HomingMark>(mark), direction, positive_side, encoders_.ratio() < 0.0);
  signals_watched_ = true;
}

/// Each interpolator tick of a homing, before the setpoint is made.
void AxisOrders::step_homing() noexcept {
  Job* base = jobs_[kBase];
  const bool active = base != nullptr && base->kind == JobKind::MC_Home;
  if (active && homing_.travels()) return;
  const bool met = homing_.found() && homing_.phase() != HomingCourse::Phase::back;
  if (!has_drive_ || met) return take_mark();
  if (active) guide_active_homing(*base);
}

/// From one phase of an active homing to the next.
void AxisOrders::guide_active_homing(Job& job) noexcept {
  const auto mark = static_cast<HomingMark>(data.Sensor[encoders_.operative()].ActiveHoming.Mode);
  const int direction = job.as<HomingJob>().direction;
  const bool at_limit_switch = homing_reverses() && limit_switches_.pressed(direction);
  const HomingCourse::Leg leg = homing_.guide(mark, direction, at_limit_switch);
  if (leg.kind == HomingCourse::Leg::Kind::gives_up) return raise(alarm::kMarkNotFound);
  if (leg.kind == HomingCourse::Leg::Kind::goes_on) return;
  if (leg.search != 0) search_mark(true, leg.search);
  head_for(job, leg.phase, leg.direction);
}

void AxisOrders::head_for(Job& job, HomingCourse::Phase phase, int direction) noexcept {
  homing_.enter(phase);
  job.as<HomingJob>().direction = direction;
  job.velocity = homing_.velocity();
  arrival_.begin();
  limits_.remember();
  Dynamics dynamics = own_dynamics(job);
  if (const int alarm_number = limits_.zero_limit(dynamics); alarm_number != 0) return raise(alarm_number);
  if (superimposed_.advancing_base()) leave_to_superimposed(&job, dynamics);
  if (plan(job, dynamics) == PlanResult::ok) return;
  end_job(kBase, JobPhase::failed, ErrorId::unspecified);
  begin_stop(limits_.maximum(), false);
}

AxisPosition AxisOrders::place_of_mark() const noexcept {
  const double start = drive_->signals().start_position;
  return encoders_.position_of_machine(two_difference(homing_.mark_position(), start), play());
}

/// The mark has been passed; a virtual axis has none, and takes the place where it is.
void AxisOrders::take_mark() noexcept {
  const AxisPosition place = has_drive_ ? place_of_mark() : actual_;
  homing_.end_search();
  Job* const passive = jobs_[kPassiveHoming];
  Job& job = passive != nullptr ? *passive : *jobs_[kBase];
  auto& asked = job.as<HomingJob>();
  asked.mark_position = passive != nullptr ? asked.position : homing_.settings().mark;
  if (!assign_position(place, asked.mark_position)) return raise(alarm::kHomingNotPossible);
  if (passive != nullptr) return end_job(kPassiveHoming, JobPhase::done, ErrorId::none);
  signals_watched_ = signals_always_watched();
  head_for(job, HomingCourse::Phase::travel, 0);
}

/// A place gets a position, and everything is shifted by the difference; the turns are counted anew.
bool AxisOrders::assign_position(AxisPosition place, double position) noexcept {
  const double by = shortest_distance(place.value, position, modulo_);
  if (!positions_fit(by)) return false;
  shift_positions(by);
  encoders_.shift_beside(by);
  if (modulo_.enabled && !encoders_.absolute(encoders_.operative())) {
    counted_from_ = first_turn(advanced(place, by, modulo_), modulo_);
  }
  show_renamed();
  homed_ = true;
  adjust_encoder(encoders_.operative(), false);
  return true;
}

/// What leads the axis has the new names as well, so that nothing moves.
void AxisOrders::shift_coupling(double by) noexcept {
  synchronous_.shift_following(by);
  if (coupled_.cam == nullptr || motion_ == Motion::desynchronizing) return;
  data.StatusSynchronizedMotion.SlaveOffset = synchronous_.following_offset_at_start();
  Job* const offset = jobs_[kOffset];
  if (offset == nullptr || offset->kind != JobKind::MC_OffsetRelative) return;
  auto& shift = offset->as<ShiftJob>();
  shift.base = shift.base + by;
}

/// A running homing ends, whatever the reason.
void AxisOrders::leave_homing() noexcept {
  homing_.end();
  homing_now_ = false;
  signals_watched_ = signals_always_watched();
}

// ---- Positions
// --------------------------------------------------------------------------------------------------

/// Way from the actual position to a home position; on a ring the shorter one.
double AxisOrders::position_shift(double home_position) const noexcept {
  return shortest_distance(actual_.value, home_position, modulo_);
}

void AxisOrders::shift_positions(double by) noexcept {
  setpoint_.position = advanced(setpoint_.position, by, modulo_);
  last_setpoint_.position = advanced(last_setpoint_.position, by, modulo_);
  superimposed_.shift_base(by, modulo_);
  actual_ = advanced(actual_, by, modulo_);
  shift_leading(by);
  single_.shift(by);
  // What waits to blend may have another distance to its target: that is where the axis calls it so then.
  if (jobs_[kBuffered] != nullptr && jobs_[kBase] != nullptr && motion_ == Motion::single_axis)
    plan_blending();
  shift_coupling(by);
  if (has_drive_) shift_servo(by);
}

/// What has been shown in this tick is where it was, and has other names now: the target of a running
/// positioning, and what MC_Servo shows.
void AxisOrders::show_renamed() noexcept {
  const bool positioning = motion_ == Motion::single_axis && jobs_[kBase] != nullptr &&
                           single_.aim() == SingleAxisMotion::Aim::position;
  if (positioning) show_target(single_.target());
  if (!has_drive_) return;
  for (std::size_t i = 0; i < Encoders::kCount; ++i)
    if (i == encoders_.operative() || encoders_.beside(i)) show_place(i, encoders_.position(i, actual_));
}

}  // namespace lockstep
