/// How positions are called: homing gives all of them other names, and nothing moves.
#pragma once

#include <cstdint>

#include "tech_objects/axis/clamping.hpp"
#include "tech_objects/axis/motion.hpp"
#include "tech_objects/axis/sensors.hpp"

namespace lockstep {

/// Whatever holds a position.
struct PositionNameParts {
  AxisData& data;
  LeadingObject& leading_;
  const std::array<EncoderAdjustment, Encoders::kCount>& encoder_adjustments;
  const JobSlots& jobs_;
  Setpoint& setpoint_;
  Setpoint& last_setpoint_;
  const Modulo& modulo_;
  AxisPosition& actual_;
  std::int64_t& counted_from_;
  bool& homed_;
  const bool& has_drive_;
  const AxisMotion& motion_;
  SingleAxisMotion& single_;
  SuperimposedMotion& superimposed_;
  SynchronousMotion& synchronous_;
  const Coupled& coupled_;
  Encoders& encoders_;
  Clamping& clamping_;
  PositionLoop& loop_;
  HandOverOrders& hand_over_;
  SensorOrders& sensors_;
  JunctionOrders& junction_;
  MotionOrders& motion_orders_;
};

/// Thread: the cycle.
class PositionNames : private PositionNameParts {
 public:
  explicit PositionNames(const PositionNameParts& parts) noexcept : PositionNameParts(parts) {}

  /// Whether the axis could still be used if it were shifted: inside the numeric range, and on its ring.
  bool fit(double by) const noexcept;
  /// From the actual position to a home position; on a ring the shorter one [u].
  double distance_to(double home_position) const noexcept;
  /// All are shifted [u].
  void shift(double by) noexcept;
  /// A place gets a position, and everything is shifted by the difference; the turns are counted anew.
  /// @return whether that fits
  bool assign(AxisPosition place, double position) noexcept;
  /// What has been shown in this tick is where it was, and has other names now: the target of a running
  /// positioning, and what MC_Servo shows.
  void show() noexcept;

  /// At the start, and after a restart, every encoder begins at the position that the axis has; an absolute
  /// one that is adjusted knows better.
  void begin_encoders(AxisPosition here) noexcept;

 private:
  void shift_coupling(double by) noexcept;
  void shift_servo(double by) noexcept;
};

}  // namespace lockstep
