/// What a device that sits on the load of an axis, or beside an encoder, sees of its motion.
#pragma once

#include <cstdint>

#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

/// The position of an axis or encoder in every servo cycle: of one with a drive or sensor its actual
/// position; of a virtual axis its setpoint as a drive would get it, fine-interpolated, at the end of the
/// interpolation one interpolator cycle later. Thread: the cycle.
class LoadPosition {
 public:
  /// @param servo_period [s] > 0  @param ratio servo ticks per interpolator tick
  /// @param setpoint whether its setpoint counts, although it may have a drive
  void watch(const LeadingObject& object, double servo_period, int ratio, bool setpoint = false) noexcept;

  /// Once in each servo tick, behind the object's own; the first call begins.
  void servo() noexcept;
  /// Once in each interpolator tick.
  void interpolated() noexcept { tick_ = 0; }

  bool begun() const noexcept { return begun_; }
  /// As the object counts it.
  AxisPosition position() const noexcept { return position_; }
  /// Its position on a line from where it was called 0 at the start [u]; homing does not change it.
  DoubleDouble line() const noexcept { return line_; }
  /// What it has moved since the servo tick before [u].
  DoubleDouble distance() const noexcept { return distance_; }
  /// Whether it is an actual position that is read here.
  bool measured() const noexcept { return !setpoint_ && object_->measured_in_servo(); }
  /// Of a setpoint its velocity at this position [u/s]; of an actual position 0.
  double setpoint_velocity() const noexcept { return velocity_; }

 private:
  AxisPosition fine_position() noexcept;
  DoubleDouble virtual_distance(AxisPosition now) const noexcept;

  const LeadingObject* object_ = nullptr;
  double period_ = 0.001;  // of the interpolator [s]
  int ratio_ = 1;
  int tick_ = 0;  // since the last interpolator tick
  bool setpoint_ = false;
  bool begun_ = false;
  double velocity_ = 0.0;  // [u/s]
  AxisPosition position_;
  DoubleDouble line_;
  DoubleDouble distance_;
  // Of the object, when it was last looked at.
  DoubleDouble renamed_;
  std::uint32_t restarts_ = 0;
};

}  // namespace lockstep
