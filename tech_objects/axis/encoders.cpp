#include "tech_objects/axis/encoders.hpp"

#include <algorithm>

#include "tech_objects/types/published.hpp"

namespace lockstep {

// ---- At the start, and after a restart
// ----------------------------------------------------------------------------

void Encoders::configure(const AxisData& data, const DriveSettings& machine, bool has_drive,
                         const Modulo& modulo, double cycle) noexcept {
  modulo_ = modulo;
  cycle_ = cycle;
  several_ = false;
  for (std::size_t i = 0; i < kCount; ++i) {
    Encoder& encoder = encoders_[i];
    const SimulatedSensor drive{
        .exists = true, .inverted = machine.inverted, .start_position = machine.signals.start_position};
    const SimulatedSensor& model = i == 0 ? drive : machine.sensors[i - 1];
    encoder.exists = data.Sensor[i].Existent && model.exists;
    encoder.absolute = has_drive && data.Sensor[i].Type != SensorType::INCREMENTAL;
    encoder.sign = data.Sensor[i].InverseDirection != model.inverted ? -1.0 : 1.0;
    encoder.ratio = model.ratio;
    encoder.start = model.start_position;
    encoder.lent = 0.0;
    encoder.failed = false;
    several_ |= i > 0 && encoder.exists;
  }
  operative_ =
      static_cast<std::size_t>(std::clamp<UDINT>(data.PositionControl.InitialOperativeSensor, 1, kCount) - 1);
  if (!exists(operative_)) operative_ = 0;
  sign_ = encoders_[operative_].sign;
}

void Encoders::begin_beside(std::size_t encoder, AxisPosition origin, double play) noexcept {
  encoders_[encoder].origin = origin;
  encoders_[encoder].seen = advanced(origin, travel(encoder, play), modulo_);
}

AxisPosition Encoders::origin_at(std::size_t encoder, AxisPosition here, double play) const noexcept {
  return advanced(here, -travel(encoder, play), modulo_);
}

AxisPosition Encoders::adjusted_origin(std::size_t encoder, double offset) const noexcept {
  return normalised(0, two_sum(sign(encoder) * encoders_[encoder].start, offset), modulo_);
}

double Encoders::distance_to_origin(AxisPosition origin) const noexcept {
  return rounded_difference(origin, origin_, modulo_);
}

/// What the load has moved since the beginning, as an encoder has counted it [u].
DoubleDouble Encoders::travel(std::size_t encoder, double play) const noexcept {
  if (encoder == 0) return counted_ * sign(0) - DoubleDouble{play, 0.0};
  return encoders_[encoder].reading * sign(encoder);
}

// ---- Each servo cycle
// -----------------------------------------------------------------------------------------------

void Encoders::read(DriveActual& now, Drive& drive) noexcept {
  encoders_[0].velocity = now.velocity;
  encoders_[0].fails = now.encoder_failed;
  for (std::size_t i = 1; i < kCount; ++i) {
    Encoder& encoder = encoders_[i];
    if (!encoder.exists) continue;
    const SensorActual told = drive.read_sensor(i);
    encoder.fails = told.failed;
    encoder.velocity = told.failed ? 0.0 : (told.position - encoder.reading).rounded() / cycle_;
    if (!told.failed) encoder.reading = told.position;
  }
  if (operative_ == 0) return;
  now.position = encoders_[operative_].reading;
  now.velocity = encoders_[operative_].velocity;
  now.encoder_failed = encoders_[operative_].fails;
  now.trouble = now.fault || now.silent || now.encoder_failed;
}

void Encoders::orient(DriveActual& now) const noexcept {
  if (sign_ >= 0.0) return;
  now.position = -now.position;
  now.velocity = -now.velocity;
}

void Encoders::watch(std::size_t encoder, double play, TO_Struct_StatusSensor& status) noexcept {
  Encoder& beside = encoders_[encoder];
  const bool failed = beside.fails;
  if (failed && !beside.failed && !beside.absolute) status.Adjusted = 0;
  if (!failed && beside.failed && !beside.absolute) beside.origin = origin_at(encoder, beside.seen, play);
  beside.failed = failed;
  if (!failed) beside.seen = advanced(beside.origin, travel(encoder, play), modulo_);
  status.Error = failed;
  status.Velocity = failed ? 0.0 : beside.velocity * beside.sign;
}

/// Its turn anew from the origin, so that nothing adds up over many turns.
AxisPosition Encoders::read_on_another_turn(const DoubleDouble& distance) noexcept {
  const AxisPosition position = position_at(distance);
  const auto passed = static_cast<std::int64_t>(static_cast<std::uint64_t>(position.turns) -
                                                static_cast<std::uint64_t>(origin_.turns));
  turn_ = position.turns;
  on_turn_ = to_double_double(origin_.value) - turns_distance(passed, modulo_.length);
  return position;
}

void Encoders::regain(AxisPosition here, double play) noexcept {
  lost_ = false;
  if (!absolute(operative_)) set_origin(origin_at(operative_, here, play));
}

// ---- MC_SetSensor
// ---------------------------------------------------------------------------------------------------

void Encoders::place(std::size_t encoder, AxisPosition position, AxisPosition actual, double play) noexcept {
  Encoder& placed = encoders_[encoder];
  const AxisPosition before = this->position(encoder, actual);
  if (placed.absolute) placed.lent += rounded_difference(position, before, modulo_);
  if (encoder == operative_) {
    set_origin(advanced(origin_, difference(position, before, modulo_), modulo_));
    return;
  }
  placed.origin = origin_at(encoder, position, play);
  placed.seen = position;
}

double Encoders::switch_to(std::size_t encoder, AxisPosition actual) noexcept {
  Encoder& left = encoders_[operative_];
  left.origin = advanced(origin_, -left.lent, modulo_);
  left.seen = advanced(actual, -left.lent, modulo_);
  left.lent = 0.0;
  operative_ = encoder;
  const Encoder& taken = encoders_[encoder];
  set_origin(taken.origin);
  sign_ = taken.sign;
  return taken.velocity * taken.sign;
}

// ---- Homing
// -----------------------------------------------------------------------------------------------------

void Encoders::shift_beside(double by) noexcept {
  if (!several_) return;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (i == operative_) continue;
    encoders_[i].origin = advanced(encoders_[i].origin, by, modulo_);
    encoders_[i].seen = advanced(encoders_[i].seen, by, modulo_);
  }
}

void Encoders::rename(std::size_t encoder, double by) noexcept {
  Encoder& renamed = encoders_[encoder];
  renamed.origin = advanced(renamed.origin, by - renamed.lent, modulo_);
  renamed.seen = advanced(renamed.seen, by, modulo_);
  renamed.lent = 0.0;
}

double Encoders::offset(std::size_t encoder, std::int64_t first) const noexcept {
  const AxisPosition origin = encoder == operative_ ? origin_ : encoders_[encoder].origin;
  const DoubleDouble turns =
      modulo_.enabled ? to_double_double(origin.turns - first) * modulo_.length : DoubleDouble{};
  return (turns + two_difference(origin.value, sign(encoder) * encoders_[encoder].start)).rounded();
}

AxisPosition Encoders::position_of_machine(const DoubleDouble& place, double play) const noexcept {
  const double behind = operative_ == 0 ? play : 0.0;
  return position_at(place * ratio() - DoubleDouble{behind, 0.0});
}

}  // namespace lockstep
