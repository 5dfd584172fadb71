#include "tech_objects/axis/axis.hpp"

#include <utility>

#include "tech_objects/drive/drive_models.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

Axis::Axis(ObjectKind object_kind, std::string object_name, DB_ANY object_number)
    : AxisFamilies(object_kind, std::move(object_name), object_number) {
  drive_model = kDriveModels;
  if (!has_position()) data.Units.VelocityUnit = kTurnsPerMinute;
}

void Axis::configure(double servo_period, int ratio) {
  servo_period_ = servo_period;
  ratio_ = ratio;
  period_ = servo_period * ratio;
  start_values_ = data;
  position_controlled_ = has_position_;
  provide_if_asked(data.CrossPlcSynchronousOperation);
  take_start_values();
  setpoint_ = Setpoint{};
  setpoint_.position = normalised({0, 0.0}, modulo_);
  last_setpoint_ = setpoint_;
  actual_ = setpoint_.position;
  single_.stand(setpoint_);
  reset_leading(actual_);
  for (const LeadingValue& leading : leading_values)
    if (leading.coupling == Coupling::actual) leading.source->lead_by_actual_value();
  if (!is_virtual()) configure_servo();
  sensors_.show();
  publish();
}

void Axis::take_start_values() noexcept {
  const bool simulated = data.Simulation.Mode == Activation::active && !is_virtual();
  has_drive_ = !is_virtual() && !simulated;
  always_in_full_ = has_drive_ || never_plain;
  set_bit(data.StatusWord, StatusBit::AxisSimulation, simulated);
  modulo_ = {data.Modulo.Enable, data.Modulo.Length, data.Modulo.StartValue};
  // Without a position it may turn for ever.
  if (!has_position_) modulo_ = {true, 1e6, 0.0};
  single_.configure(modulo_, period_);
  superimposed_.configure(period_);
  arrival_.configure(period_);
  blending_.configure(period_);
  hand_over_.configure(period_);
  emergency_ramp_ = EmergencyRamp::none;
  const double tolerance = data.Synchronization.MasterReversionTolerance;
  synchronous_.configure(modulo_, period_, tolerance, additive_);
  awaited_.configure(modulo_, period_, tolerance, additive_);
  configure_leading(period_, data.Extrapolation);
  configure_provided(period_, data.CrossPlcSynchronousOperation);
}

void Axis::configure_servo() {
  encoders_ = {};
  servo_.take_settings();
  drive_ = drive_model->make();
  drive_properties_ = drive_->configure(drive_settings, servo_period_, servo_.motor_angle_per_unit());
  switches_.renew_watch();
  loop_.configure_controller(servo_.control_settings());
  names_.begin_encoders(setpoint_.position);
  position_control_.begin_anew({setpoint_.position, 0.0});
  servo_.show_execution_time();
}

// ---- Restart

/// The start values count from now on. The axis is where it was, on a ring of its own perhaps.
void Axis::restart() noexcept {
  ends_.end_all(JobPhase::aborted, ErrorId::none, AbortedBy::restart);
  jobs_.unlock();
  coupling_.end_simulated(JobPhase::aborted, ErrorId::none);
  additive_request = {};
  data = start_values_;
  shown_before_.drive = ShownBefore::kNothing;
  start_values_changed = false;
  homed_ = false;
  position_controlled_ = has_position_;
  take_start_values();
  setpoint_ = {normalised({0, setpoint_.position.value}, modulo_), 0.0, 0.0};
  last_setpoint_ = setpoint_;
  actual_ = normalised({0, actual_.value}, modulo_);
  single_.stand(setpoint_);
  reset_leading(actual_);
  counted_from_ = 0;
  limit_switches_ = {};
  drive_control_.release_free_bits();
  if (!is_virtual()) restart_servo();
  sensors_.show();
  restarted = true;
  ++restarts_;
  attention.coupling_has_changed();
}

/// The encoder goes on from where it is, at the position that the axis has now.
void Axis::restart_servo() noexcept {
  servo_.take_settings();
  switches_.renew_watch();
  backlash_ = {};
  names_.begin_encoders(actual_);
  position_control_.begin_anew({setpoint_.position, 0.0});
  servo_.show_execution_time();
}

// ---- Torque

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

// ---- Couplings

namespace {

/// The axis that an object is; nullptr for others, which depend on nothing.
Axis* as_axis(LeadingObject* leading) noexcept {
  return leading != nullptr && among(leading->kind, kAnyAxis) ? static_cast<Axis*>(leading) : nullptr;
}

}  // namespace

Axis* Axis::coupled_leading_axis() const noexcept {
  return as_axis(coupled_to());
}

Axis* Axis::awaited_leading_axis() const noexcept {
  return jobs_[kWaiting] != nullptr ? as_axis(master_of(*jobs_[kWaiting])) : nullptr;
}

}  // namespace lockstep
