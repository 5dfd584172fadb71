#include "tech_objects/sensing/external_encoder.hpp"

#include <cmath>
#include <utility>

#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/jobs/override.hpp"
#include "tech_objects/objects/object_alarms.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

ExternalEncoder::ExternalEncoder(std::string object_name, DB_ANY object_number)
    : LeadingObject(ObjectKind::TO_ExternalEncoder, std::move(object_name), object_number) {}

void ExternalEncoder::configure(double servo_period, int ratio) {
  servo_period_ = servo_period;
  period_ = servo_period * ratio;
  unseen_ = 0.0;
  start_values_ = data;
  position_controlled_ = false;  // it has no setpoint that could lead
  provide_if_asked(data.CrossPlcSynchronousOperation);
  take_start_values();
  source_.configure(source_settings, servo_period, ratio, static_cast<std::uint32_t>(number));
  actual_ = last_actual_ = normalised({0, 0.0}, modulo_);
  reset_leading(actual_);
  publish();
}

void ExternalEncoder::take_start_values() noexcept {
  modulo_ = {data.Modulo.Enable, data.Modulo.Length, data.Modulo.StartValue};
  configure_leading(period_, data.Extrapolation);
  configure_provided(period_, data.CrossPlcSynchronousOperation);
}

// ---- MC_Servo
// ---------------------------------------------------------------------------------------------------

void ExternalEncoder::servo(std::int64_t /*now*/) noexcept {
  const EncoderReading reading = source_.read();
  const bool was_heard = std::exchange(heard_, reading.valid);
  if (reading.awaited) return;
  if (!reading.valid) return fault(alarm::kEncoder);
  const bool inverse = data.Sensor.InverseDirection;
  const DoubleDouble line = inverse ? -reading.position : reading.position;
  const DoubleDouble true_line = inverse ? -reading.true_position : reading.true_position;
  last_true_line_ = was_heard ? true_line_ : true_line;
  true_line_ = true_line;
  if (!begun_) return begin(line);
  if (faulty() || !was_heard) return go_on_from_here(line);
  if (!follow(line)) return;
  data.StatusSensor.Position = actual_.value;
  if (!mark_search_.active()) return;
  const double place = reading.true_position.rounded();
  mark_search_.step(place, home_switch().active(source_settings.signals, place, turn()),
                    source_settings.signals.zero_marks);
}

/// The first reading is where the encoder is; nothing has moved.
void ExternalEncoder::begin(DoubleDouble line) noexcept {
  begun_ = true;
  line_ = line;
  origin_ = {};
  actual_ = last_actual_ = advanced(origin_, line, modulo_);
  reset_leading(actual_);
}

/// What it has gone unseen, or in a fault, is no distance: it is where it was seen last.
void ExternalEncoder::go_on_from_here(DoubleDouble line) noexcept {
  line_ = line;
  origin_ = advanced(actual_, -line_, modulo_);
}

/// Takes a reading over; false where it cannot be one.
bool ExternalEncoder::follow(DoubleDouble line) noexcept {
  const double distance = (line - line_).rounded();
  const double maximum = leads_by_actual_value() ? 0.5 * modulo_.length : modulo_.length;
  line_ = line;
  if (modulo_.enabled && std::abs(distance) > maximum) {
    fault(alarm::kActualValueRange, {.value = std::abs(distance), .limit = maximum});
    return false;
  }
  const AxisPosition here = advanced(origin_, line, modulo_);
  if (!(std::abs(here.value) <= kPositionRange)) {
    fault(alarm::kPositionRangeExceeded, {.value = here.value, .limit = kPositionRange});
    return false;
  }
  actual_ = here;
  return true;
}

/// The position is not known any more: it stays where it was seen last.
void ExternalEncoder::fault(int alarm_number, const AlarmDetail& detail) noexcept {
  lost |= !faulty();
  homed_ = false;
  data.StatusSensor.Adjusted = 0;
  end_passive_homing(JobPhase::failed, ErrorId::technology_alarm);
  data.StatusSensor.State = SensorState::not_valid;
  data.StatusSensor.Error = alarm_number == alarm::kEncoder;
  raise_alarm(alarm_number, ProcessingEnd::external_encoder, *this, data, detail);
}

// ---- MC_Interpolator
// --------------------------------------------------------------------------------------------

void ExternalEncoder::before_axes() noexcept {
  source_.interpolated();
  new_jobs_.take([this](Job& job) { start(job); });
  if (mark_search_.found()) take_mark();
  const double time = period_ + std::exchange(unseen_, 0.0);
  const double velocity = rounded_difference(actual_, last_actual_, modulo_) / time;
  data.ActualAcceleration = (velocity - actual_velocity_) / time;
  actual_velocity_ = velocity;
  last_actual_ = actual_;
  if (leads_by_actual_value() || provides()) extrapolate(actual_, actual_velocity_, data.Extrapolation);
  power_state_ = power.enable && actual_values_valid() ? PowerState::on : PowerState::off;
  if (!enabled()) end_passive_homing(JobPhase::aborted, ErrorId::none);
  enable_removed_ = faulty();
  standstill_.watch(actual_velocity_, data.StandstillSignal, period_);
  if (provides()) provide(ahead_of_delay(), enabled(), data.StatusProvidedLeadingValue);
  publish();
}

void ExternalEncoder::publish() noexcept {
  data.ActualPosition = actual_.value;
  data.ActualVelocity = actual_velocity_;
  data.ActualModuloCycle = static_cast<DINT>(actual_.turns - counted_from_);
  data.StatusSensor.State = actual_values_valid() ? SensorState::valid : SensorState::not_valid;
  data.StatusSensor.CommunicationOK = heard_;
  data.StatusSensor.Control = true;
  data.StatusSensor.Position = actual_.value;
  data.StatusSensor.Velocity = actual_velocity_;
  data.StatusSensor.ModuloCycle = data.ActualModuloCycle;
  set_bit(data.StatusWord, StatusBit::Enable, enabled());
  set_bit(data.StatusWord, StatusBit::Error, faulty());
  set_bit(data.StatusWord, StatusBit::OnlineStartValuesChanged, start_values_changed);
  set_bit(data.StatusWord, StatusBit::HomingDone, homed_);
  set_bit(data.StatusWord, StatusBit::HomingCommand, homing());
  set_bit(data.StatusWord, StatusBit::Done, enabled());
  set_bit(data.StatusWord, StatusBit::Standstill, standstill_.stands());
  if (leads_by_actual_value()) publish_extrapolation(data.Extrapolation, data.StatusExtrapolation);
}

// ---- Jobs
// -------------------------------------------------------------------------------------------------------

void ExternalEncoder::start(Job& job) noexcept {
  ErrorId error = ErrorId::no_technology_object;
  if (job.kind == JobKind::MC_Reset) error = reset(job.as<ResetJob>().restart);
  if (job.kind == JobKind::MC_Home) error = home(job);
  if (error != ErrorId::none) return job.fail(error);
  if (job.kind == JobKind::MC_Home) count_homing(job);
  if (passive_ != &job) job.phase = JobPhase::done;
}

ErrorId ExternalEncoder::reset(bool restart) noexcept {
  if (restart && power.enable) {
    raise_alarm(alarm::kRestartNotCarriedOut, ProcessingEnd::external_encoder, *this, data,
                {.cause = AlarmCause::enabled});
    return ErrorId::restart_refused;
  }
  if (faulty()) go_on_from_here(line_);
  clear_alarms(*this, data);
  data.StatusSensor.Error = false;
  if (!restart) return ErrorId::none;
  end_passive_homing(JobPhase::aborted, ErrorId::none);
  counted_from_ = 0;
  data = start_values_;
  start_values_changed = false;
  homed_ = false;
  take_start_values();
  actual_ = last_actual_ = normalised({0, actual_.value}, modulo_);
  origin_ = advanced(actual_, -line_, modulo_);
  reset_leading(actual_);
  ++restarts_;
  restarted = lost = true;
  return ErrorId::none;
}

// ---- Homing
// -----------------------------------------------------------------------------------------------------

ErrorId ExternalEncoder::home(Job& job) noexcept {
  const JobClass kind = class_of(job, true);
  if (kind == JobClass::home_cancel) {
    end_passive_homing(JobPhase::aborted, ErrorId::none);
    return ErrorId::none;
  }
  if (!actual_values_valid()) return ErrorId::actual_values_invalid;
  if (kind == JobClass::home_passive) return begin_passive_homing(job);
  auto& asked = job.as<HomingJob>();
  if (asked.mode == HomeMode::adjust_absolute_relative || asked.mode == HomeMode::adjust_absolute)
    return ErrorId::homing_mode_incremental;
  const bool adjusts = asked.mode == HomeMode::adjust_incremental;
  const bool relative = asked.mode == HomeMode::direct_relative;
  if (asked.mode != HomeMode::direct_absolute && !relative && !adjusts) return ErrorId::mode;
  const double by = relative ? asked.position : shortest_distance(actual_.value, asked.position, modulo_);
  if (!fits(by)) return ErrorId::position;
  shift(by);
  homed_ = true;
  if (adjusts) data.StatusSensor.Adjusted = 1;
  asked.mark_position = relative ? actual_.value : asked.position;
  return ErrorId::none;
}

/// Beside whatever moves the encoder.
ErrorId ExternalEncoder::begin_passive_homing(Job& job) noexcept {
  if (!enabled()) return ErrorId::locked;
  auto& asked = job.as<HomingJob>();
  if (asked.mode == HomeMode::passive_configured) asked.position = data.Homing.HomePosition;
  if (!fits(shortest_distance(actual_.value, asked.position, modulo_))) return ErrorId::position;
  const auto& settings = data.Sensor.PassiveHoming;
  const auto mark = static_cast<HomingMark>(settings.Mode);
  const AlarmCause missing = missing_mark(mark, home_switch(), source_settings.signals);
  if (missing != AlarmCause::none) {
    fault(alarm::kHomingNotSupported, {.cause = missing, .sensor = 1});
    return ErrorId::technology_alarm;
  }
  end_passive_homing(JobPhase::aborted, ErrorId::none);
  passive_ = &job;
  job.phase = JobPhase::active;
  if (asked.mode != HomeMode::passive) homed_ = false;
  begin_search(mark_search_, mark, passive_direction(settings.Direction), settings.SideInput,
               data.Sensor.InverseDirection);
  return ErrorId::none;
}

/// The mark has been passed: its place gets the home position, and the turns are counted anew.
void ExternalEncoder::take_mark() noexcept {
  auto& asked = passive_->as<HomingJob>();
  const double place = mark_search_.place();
  const AxisPosition mark =
      advanced(origin_, to_double_double(data.Sensor.InverseDirection ? -place : place), modulo_);
  const double by = shortest_distance(mark.value, asked.position, modulo_);
  if (!fits(by)) return fault(alarm::kHomingNotPossible, {.value = asked.position, .limit = kPositionRange});
  shift(by);
  if (modulo_.enabled) counted_from_ = first_turn(advanced(mark, by, modulo_), modulo_);
  homed_ = true;
  data.StatusSensor.Adjusted = 1;
  asked.mark_position = asked.position;
  end_passive_homing(JobPhase::done, ErrorId::none);
}

void ExternalEncoder::end_passive_homing(JobPhase phase, ErrorId error) noexcept {
  mark_search_.end();
  if (passive_ == nullptr) return;
  passive_->phase = phase;
  passive_->error = error;
  passive_ = nullptr;
}

/// Whether it could still be used if it were called by another name: in the numeric range, and on its ring.
bool ExternalEncoder::fits(double by) const noexcept {
  const double shifted = advanced(actual_, by, modulo_).value;
  return std::isfinite(by) && std::abs(shifted) <= kPositionRange && modulo_.contains(shifted);
}

HomeSwitch ExternalEncoder::home_switch() const noexcept {
  const auto& settings = data.Sensor.PassiveHoming;
  return {settings.DigitalInputAddress, settings.SwitchLevel};
}

void ExternalEncoder::shift(double by) noexcept {
  origin_ = advanced(origin_, by, modulo_);
  actual_ = advanced(actual_, by, modulo_);
  last_actual_ = advanced(last_actual_, by, modulo_);
  shift_leading(by);
}

}  // namespace lockstep
