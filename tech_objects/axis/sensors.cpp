#include "tech_objects/axis/sensors.hpp"

#include <cmath>

#include "tech_objects/jobs/job.hpp"
#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

std::size_t SensorOrders::sensor_of(const Job& job) const noexcept {
  const DINT sensor = job.as<HomingJob>().sensor;
  return sensor > 0 ? static_cast<std::size_t>(sensor - 1) : encoders_.operative();
}

// ---- Adjustment

AxisPosition SensorOrders::adjusted_origin(std::size_t encoder) noexcept {
  EncoderAdjustment& kept = encoder_adjustments[encoder];
  if (!kept.adjusted || !std::isfinite(kept.offset)) kept = {};
  data.StatusSensor[encoder].AbsEncoderOffset = kept.offset;
  data.StatusSensor[encoder].Adjusted = kept.adjusted ? 1 : 0;
  return encoders_.adjusted_origin(encoder, kept.offset);
}

void SensorOrders::adjust(std::size_t encoder, bool store) noexcept {
  data.StatusSensor[encoder].Adjusted = 1;
  EncoderAdjustment& kept = encoder_adjustments[encoder];
  if (!encoders_.absolute(encoder) || (kept.adjusted && !store)) return;
  kept = {true, encoders_.offset(encoder, counted_from_)};
  data.StatusSensor[encoder].AbsEncoderOffset = kept.offset;
}

// ---- What is shown

void SensorOrders::show() noexcept {
  data.OperativeSensor = static_cast<UDINT>(encoders_.operative() + 1);
  for (std::size_t i = 0; i < Encoders::kCount; ++i) {
    auto& status = data.StatusSensor[i];
    status.Control = i == encoders_.operative();
    if (!status.Control && !(has_drive_ && encoders_.exists(i))) continue;
    status.State = encoders_.valid(i) ? SensorState::valid : SensorState::not_valid;
    status.CommunicationOK = true;
  }
  data.StatusDrive.CommunicationOK = true;
}

void SensorOrders::show_place(std::size_t encoder, AxisPosition place) noexcept {
  data.StatusSensor[encoder].Position = place.value;
  data.StatusSensor[encoder].ModuloCycle = static_cast<DINT>(place.turns - counted_from_);
}

void SensorOrders::show_places() noexcept {
  for (std::size_t i = 0; i < Encoders::kCount; ++i)
    if (i == encoders_.operative() || encoders_.beside(i)) show_place(i, encoders_.position(i, actual_));
}

void SensorOrders::read(DriveActual& now) noexcept {
  encoders_.read(now, *drive_);
  for (std::size_t i = 0; i < Encoders::kCount; ++i) {
    if (!encoders_.beside(i)) continue;
    auto& status = data.StatusSensor[i];
    encoders_.watch(i, play(), status);
    status.State = encoders_.valid(i) ? SensorState::valid : SensorState::not_valid;
    show_place(i, encoders_.position(i, actual_));
  }
}

// ---- MC_SetSensor

ErrorId SensorOrders::set(const SensorJob& job) noexcept {
  const auto exists = [this](DINT number) { return data.Sensor[number - 1].Existent; };
  const auto valid = [this](DINT number) {
    return data.StatusSensor[number - 1].State == SensorState::valid;
  };
  if (!exists(job.sensor)) return ErrorId::sensor;
  const bool from_reference = job.mode == SetSensorMode::copy_from_reference;
  const bool from_axis = job.mode == SetSensorMode::copy_from_axis;
  if (from_reference && (!exists(job.reference) || job.reference == job.sensor))
    return ErrorId::reference_sensor;
  if (homing_now_) return ErrorId::homing_active;
  if (!valid(job.sensor) || (from_reference && !valid(job.reference)) || (from_axis && encoders_.lost()))
    return ErrorId::actual_values_invalid;
  const auto target = static_cast<std::size_t>(job.sensor - 1);
  if (from_axis) {
    place_encoder(target, actual_);
  } else if (from_reference) {
    place_encoder(target, encoders_.position(static_cast<std::size_t>(job.reference - 1), actual_));
  } else if (target != encoders_.operative()) {
    switch_encoder(target, job.mode == SetSensorMode::switch_aligned);
  }
  return ErrorId::none;
}

/// An encoder tells this position from now on, where it is. Of the operative one the difference acts as a
/// control deviation.
void SensorOrders::place_encoder(std::size_t encoder, AxisPosition place) noexcept {
  encoders_.place(encoder, place, actual_, play());
  if (encoder == encoders_.operative()) deviate(place);
}

void SensorOrders::switch_encoder(std::size_t encoder, bool aligned) noexcept {
  if (aligned) encoders_.place(encoder, actual_, actual_, play());
  const AxisPosition told = encoders_.position(encoder, actual_);
  actual_velocity_ = encoders_.switch_to(encoder, actual_);
  show();
  if (!aligned) deviate(told);
}

/// The actual position is another one from now on; with a smoothing time position control notices bit by bit.
void SensorOrders::deviate(AxisPosition place) noexcept {
  const double by = rounded_difference(place, actual_, modulo_);
  actual_ = place;
  hand_over_.make_due(motion_ == AxisMotion::none);  // the setpoint is there as well
  loop_.deviate(by, data.PositionControl.SmoothingTimeByChangeDifference);
}

}  // namespace lockstep
