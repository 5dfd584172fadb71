#include "tech_objects/objects/load_position.hpp"

#include "tech_objects/profile/fine_interpolation.hpp"

namespace lockstep {

void LoadPosition::watch(const LeadingObject& object, double servo_period, int ratio,
                         bool setpoint) noexcept {
  object_ = &object;
  period_ = servo_period * ratio;
  ratio_ = ratio;
  tick_ = 0;
  setpoint_ = setpoint;
  begun_ = false;
}

/// Of a virtual axis, and of a setpoint.
AxisPosition LoadPosition::fine_position() noexcept {
  const Setpoint& from = object_->last_setpoint();
  const Setpoint& to = object_->setpoint();
  velocity_ = to.velocity;
  if (tick_ >= ratio_) return to.position;
  const Modulo modulo = object_->modulo();
  const double distance = rounded_difference(to.position, from.position, modulo);
  const double part = static_cast<double>(tick_) / ratio_;
  const FineSetpoint fine = fine_setpoint(distance, from.velocity, to.velocity, period_, part);
  velocity_ = fine.velocity;
  return advanced(from.position, fine.distance, modulo);
}

void LoadPosition::servo() noexcept {
  ++tick_;
  const bool measured = this->measured();
  const AxisPosition now = measured ? object_->actual_position() : fine_position();
  const DoubleDouble line = measured ? object_->measured_line() : line_ + virtual_distance(now);
  distance_ = begun_ ? line - line_ : DoubleDouble{};
  line_ = line;
  begun_ = true;
  position_ = now;
  renamed_ = object_->renamed();
  restarts_ = object_->restarts();
}

/// What a virtual axis has moved. It stands while it is restarted, and may be on another ring then.
DoubleDouble LoadPosition::virtual_distance(AxisPosition now) const noexcept {
  if (!begun_) return difference(now, {}, object_->modulo());
  if (restarts_ != object_->restarts()) return {};
  return difference(now, position_, object_->modulo()) - (object_->renamed() - renamed_);
}

}  // namespace lockstep
