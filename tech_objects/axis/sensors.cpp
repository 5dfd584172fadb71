// What an axis shows of its encoders, MC_SetSensor, and the adjustment of absolute encoders.
// @source S7-1500T axis functions, encoders of an axis, MC_SetSensor
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

// ---- At the start, and after a restart
// ----------------------------------------------------------------------------

/// Every encoder begins at the position that the axis has; an absolute one that is adjusted knows better.
void AxisOrders::begin_encoders(AxisPosition here) noexcept {
  const std::size_t operative = encoders_.operative();
  encoders_.begin(encoders_.origin_at(operative, here, play()));
  if (encoders_.absolute(operative)) {
    const AxisPosition origin = adjusted_origin(operative);
    shift_positions(encoders_.distance_to_origin(origin));
    encoders_.begin(origin);
    counted_from_ = 0;
    homed_ = encoder_adjustments[operative].adjusted;
  }
  for (std::size_t i = 0; i < Encoders::kCount; ++i) {
    if (!encoders_.beside(i)) continue;
    const AxisPosition origin =
        encoders_.absolute(i) ? adjusted_origin(i) : encoders_.origin_at(i, actual_, play());
    encoders_.begin_beside(i, origin, play());
  }
}

/// Where an absolute encoder shows 0, by the adjustment that has been kept.
AxisPosition AxisOrders::adjusted_origin(std::size_t encoder) noexcept {
  EncoderAdjustment& kept = encoder_adjustments[encoder];
  if (!kept.adjusted || !std::isfinite(kept.offset)) kept = {};
  data.StatusSensor[encoder].AbsEncoderOffset = kept.offset;
  data.StatusSensor[encoder].Adjusted = kept.adjusted ? 1 : 0;
  return encoders_.adjusted_origin(encoder, kept.offset);
}

/// The encoder is adjusted to the positions as they are now.
/// @param store whether an offset of an absolute encoder that is kept already is replaced
void AxisOrders::adjust_encoder(std::size_t encoder, bool store) noexcept {
  data.StatusSensor[encoder].Adjusted = 1;
  EncoderAdjustment& kept = encoder_adjustments[encoder];
  if (!encoders_.absolute(encoder) || (kept.adjusted && !store)) return;
  kept = {true, encoders_.offset(encoder, counted_from_)};
  data.StatusSensor[encoder].AbsEncoderOffset = kept.offset;
}

// ---- What is shown
// --------------------------------------------------------------------------------------------------

/// What there is of the encoders, as long as nothing is wrong with them.
void AxisOrders::show_sensor() noexcept {
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

void AxisOrders::show_place(std::size_t encoder, AxisPosition place) noexcept {
  data.StatusSensor[encoder].Position = place.value;
  data.StatusSensor[encoder].ModuloCycle = static_cast<DINT>(place.turns - counted_from_);
}

/// Of an axis with encoders beside that of the drive: reads and shows them all.
void AxisOrders::read_encoders(DriveActual& now) noexcept {
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
// ---------------------------------------------------------------------------------------------------

ErrorId Axis::set_sensor(const SensorJob& job) noexcept {
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
void AxisOrders::place_encoder(std::size_t encoder, AxisPosition place) noexcept {
  encoders_.place(encoder, place, actual_, play());
  if (encoder == encoders_.operative()) deviate(place);
}

void AxisOrders::switch_encoder(std::size_t encoder, bool aligned) noexcept {
  if (aligned) encoders_.place(encoder, actual_, actual_, play());
  const AxisPosition told = encoders_.position(encoder, actual_);
  actual_velocity_ = encoders_.switch_to(encoder, actual_);
  show_sensor();
  if (!aligned) deviate(told);
}

/// The actual position is another one from now on; with a smoothing time position control notices bit by bit.
void AxisOrders::deviate(AxisPosition place) noexcept {
  const double by = rounded_difference(place, actual_, modulo_);
  actual_ = place;
  hand_over_.make_due(motion_ == Motion::none);  // the setpoint is there as well
  loop_.deviate(by, data.PositionControl.SmoothingTimeByChangeDifference);
}

}  // namespace lockstep
