/// The range of positions that an axis can represent, and its end.
/// @source S7-1500/S7-1500T alarms and error IDs, 307, 308
#pragma once

#include "tech_objects/axis/reactions.hpp"

namespace lockstep {

/// The setpoint made for this cycle, the one before it, and what can be done instead.
struct RangeParts {
  const AxisData& data;
  const JobSlots& jobs_;
  const MotionLimits& limits_;
  const PowerState& power_state_;
  Setpoint& setpoint_;
  const Setpoint& last_setpoint_;
  const Modulo& modulo_;
  const double& period_;
  const AxisMotion& motion_;
  SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class RangeOrders : private RangeParts {
 public:
  explicit RangeOrders(const RangeParts& parts) noexcept : RangeParts(parts) {}

  /// Near the end of what it can represent, the axis stops with maximum dynamics while it still comes to rest
  /// inside (307). One that passes the end all the same, because it is too fast already or its setpoint is
  /// given, loses its enable (308) and brakes from the last setpoint on, beyond the end. Acknowledged there,
  /// it may come back.
  void watch() noexcept;

 private:
  bool keep_in(int side) noexcept;
  void pass_end() noexcept;
};

/// Whether an axis, stopped with maximum dynamics, comes to rest far inside of the range of positions. Else,
/// or without such limits, `RangeOrders` look closely.
bool far_from_end_of_range(const Setpoint& setpoint, const Modulo& modulo,
                           const TO_Struct_DynamicLimits& limits) noexcept;

}  // namespace lockstep
