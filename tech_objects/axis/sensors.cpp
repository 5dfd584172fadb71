// The encoders of an axis: the operative one, those beside it, and MC_SetSensor.
// @source S7-1500T axis functions, encoders of an axis, MC_SetSensor
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/drive/encoder_source.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {
namespace {

enum SensorMode : DINT {
  kSwitchAligned,      // the actual position goes along
  kSwitchAsItIs,       // the difference becomes a control deviation
  kCopyFromAxis,       // no switch-over
  kCopyFromReference,  // no switch-over
};

}  // namespace

// ---- At the start, and after a restart
// ----------------------------------------------------------------------------

/// Which encoders there are, how they lie, and which is operative.
void Axis::take_sensors() noexcept {
  several_encoders_ = false;
  for (std::size_t i = 0; i < kSensors; ++i) {
    const bool inverted = i == 0 ? drive_settings.inverted : sensor_model(i).inverted;
    encoders_[i].sign = data.Sensor[i].InverseDirection != inverted ? -1.0 : 1.0;
    encoders_[i].lent = 0.0;
    encoders_[i].failed = false;
    several_encoders_ |= i > 0 && sensor_exists(i);
  }
  operative_ = static_cast<std::size_t>(
      std::clamp<UDINT>(data.PositionControl.InitialOperativeSensor, 1, kSensors) - 1);
  if (!sensor_exists(operative_)) operative_ = 0;
  encoder_sign_ = encoders_[operative_].sign;
}

/// Every encoder begins at the position that the axis has; an absolute one that is adjusted knows better.
void Axis::begin_sensors(AxisPosition here) noexcept {
  encoder_origin_ = advanced(here, -travel(operative_), modulo_);
  restore_encoder(operative_);  // which may tell that the axis is elsewhere
  for (std::size_t i = 0; i < kSensors; ++i) {
    if (i == operative_ || !sensor_exists(i)) continue;
    encoders_[i].origin = advanced(actual_, -travel(i), modulo_);
    restore_encoder(i);
    encoders_[i].seen = advanced(encoders_[i].origin, travel(i), modulo_);
  }
}

bool Axis::sensor_exists(std::size_t sensor) const noexcept {
  return data.Sensor[sensor].Existent && (sensor == 0 || sensor_model(sensor).exists);
}

/// [u] that an encoder tells on the way of one unit of the machine.
double Axis::encoder_ratio() const noexcept {
  return operative_ == 0 ? 1.0 : sensor_model(operative_).ratio;
}

/// What the load has moved since the beginning, as an encoder has counted it [u].
DoubleDouble Axis::travel(std::size_t sensor) const noexcept {
  const double sign = sensor == operative_ ? encoder_sign_ : encoders_[sensor].sign;
  if (sensor == 0) return encoder_position_ * sign - DoubleDouble{backlash_offset(), 0.0};
  return encoders_[sensor].reading * sign;
}

/// What there is of the encoders, as long as nothing is wrong with them.
void Axis::show_sensor() noexcept {
  data.OperativeSensor = static_cast<UDINT>(operative_ + 1);
  for (std::size_t i = 0; i < kSensors; ++i) {
    auto& status = data.StatusSensor[i];
    status.Control = i == operative_;
    if (i != operative_ && !(has_drive_ && sensor_exists(i))) continue;
    status.State = (i == operative_ ? sensor_lost_ : encoders_[i].failed) ? 0 : kSensorValid;
    status.CommunicationOK = true;
  }
  data.StatusDrive.CommunicationOK = true;
}

// ---- Each servo cycle
// -----------------------------------------------------------------------------------------------

/// Of an axis with encoders beside that of the drive: reads and shows them all. What the operative one tells
/// takes the place of what the drive has told.
void Axis::read_sensors(DriveActual& now) noexcept {
  encoders_[0].velocity = now.velocity;
  bool failed[kSensors] = {now.encoder_failed};
  for (std::size_t i = 1; i < kSensors; ++i) {
    if (!sensor_exists(i)) continue;
    Encoder& encoder = encoders_[i];
    const SimulatedSensor& model = sensor_model(i);
    failed[i] = is_on(model.fault);
    if (failed[i]) {
      encoder.velocity = 0.0;
      continue;
    }
    const DoubleDouble before = encoder.reading;
    encoder.reading = drive_.machine_position() * model.ratio;
    if (model.resolution > 0.0) encoder.reading = quantised(encoder.reading, model.resolution);
    encoder.velocity = (encoder.reading - before).rounded() / servo_period_;
  }
  for (std::size_t i = 0; i < kSensors; ++i)
    if (i != operative_ && sensor_exists(i)) show_beside(i, failed[i]);
  if (operative_ == 0) return;
  now.position = encoders_[operative_].reading;
  now.velocity = encoders_[operative_].velocity;
  now.encoder_failed = failed[operative_];
  now.trouble = now.fault || now.silent || now.encoder_failed;
}

/// An encoder that is not operative. One that fails goes on from where it was seen last, unless it is an
/// absolute one; no alarm tells of it.
void Axis::show_beside(std::size_t sensor, bool failed) noexcept {
  Encoder& encoder = encoders_[sensor];
  auto& status = data.StatusSensor[sensor];
  const bool incremental = data.Sensor[sensor].Type == 0;
  if (failed && !encoder.failed && incremental) status.Adjusted = 0;
  if (!failed && encoder.failed && incremental)
    encoder.origin = advanced(encoder.seen, -travel(sensor), modulo_);
  encoder.failed = failed;
  status.Error = failed;
  status.State = failed ? 0 : kSensorValid;
  if (!failed) encoder.seen = advanced(encoder.origin, travel(sensor), modulo_);
  status.Velocity = failed ? 0.0 : encoder.velocity * encoder.sign;
  show_place(sensor, encoder.seen);
}

void Axis::show_place(std::size_t sensor, AxisPosition place) noexcept {
  data.StatusSensor[sensor].Position = place.value;
  data.StatusSensor[sensor].ModuloCycle = static_cast<DINT>(place.turns - counted_from_);
}

// ---- MC_SetSensor
// ---------------------------------------------------------------------------------------------------

ErrorId Axis::set_sensor(DINT sensor, DINT mode, DINT reference) noexcept {
  const auto exists = [this](DINT number) { return data.Sensor[number - 1].Existent; };
  const auto valid = [this](DINT number) { return data.StatusSensor[number - 1].State == kSensorValid; };
  if (!exists(sensor)) return ErrorId::sensor;
  if (mode == kCopyFromReference && (!exists(reference) || reference == sensor))
    return ErrorId::reference_sensor;
  if (homing_now_) return ErrorId::homing_active;
  if (!valid(sensor) || (mode == kCopyFromReference && !valid(reference)) ||
      (mode == kCopyFromAxis && sensor_lost_))
    return ErrorId::actual_values_invalid;
  const auto target = static_cast<std::size_t>(sensor - 1);
  if (mode == kCopyFromAxis) {
    place_sensor(target, actual_);
  } else if (mode == kCopyFromReference) {
    place_sensor(target, sensor_position(static_cast<std::size_t>(reference - 1)));
  } else if (target != operative_) {
    switch_sensor(target, mode == kSwitchAligned);
  }
  return ErrorId::none;
}

AxisPosition Axis::sensor_position(std::size_t sensor) const noexcept {
  return sensor == operative_ ? actual_ : encoders_[sensor].seen;
}

/// An encoder tells this position from now on, where it is. Of the operative one the difference acts as a
/// control deviation.
void Axis::place_sensor(std::size_t sensor, AxisPosition place) noexcept {
  Encoder& encoder = encoders_[sensor];
  const AxisPosition before = sensor_position(sensor);
  if (data.Sensor[sensor].Type != 0) encoder.lent += rounded_difference(place, before, modulo_);
  if (sensor == operative_) {
    encoder_origin_ = advanced(encoder_origin_, difference(place, before, modulo_), modulo_);
    return deviate(place);
  }
  encoder.origin = advanced(place, -travel(sensor), modulo_);
  encoder.seen = place;
}

/// From one encoder to another. What MC_SetSensor has added to an absolute one is given back by leaving it.
void Axis::switch_sensor(std::size_t sensor, bool aligned) noexcept {
  const AxisPosition before = actual_;
  if (aligned) place_sensor(sensor, before);
  Encoder& left = encoders_[operative_];
  left.origin = advanced(encoder_origin_, -left.lent, modulo_);
  left.seen = advanced(before, -left.lent, modulo_);
  left.lent = 0.0;
  operative_ = sensor;
  const Encoder& taken = encoders_[sensor];
  encoder_origin_ = taken.origin;
  encoder_sign_ = taken.sign;
  actual_velocity_ = taken.velocity * taken.sign;
  show_sensor();
  if (!aligned) deviate(taken.seen);
}

/// The actual position is another one from now on; with a smoothing time position control notices bit by bit.
void Axis::deviate(AxisPosition place) noexcept {
  const double by = rounded_difference(place, actual_, modulo_);
  actual_ = place;
  hand_over_due_ |= motion_ == Motion::none;  // the setpoint is there as well
  const double time = data.PositionControl.SmoothingTimeByChangeDifference;
  if (time <= 0.0) return smoothing_.set_behind(0.0);
  smoothing_.tune(time, servo_period_);
  smoothing_.set_behind(smoothing_.behind() + by);
}

}  // namespace lockstep
