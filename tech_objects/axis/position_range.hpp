/// The range of positions that an axis can represent, and its end.
/// @source S7-1500/S7-1500T alarms and error IDs, 307, 308
#pragma once

#include <cmath>

#include "tech_objects/axis/reactions.hpp"
#include "tech_objects/axis/rounding.hpp"

namespace lockstep {

/// Where an axis comes to rest at the latest that nears the end of its range [u]: before the end by more than
/// the stop may be rounded.
inline constexpr double kEndOfRange = kPositionRange * (1.0 - kRelativeRounding);

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
/// or without such limits, `RangeOrders` look closely. From few operations and without a division:
/// `maximum_stopping_distance` ≤ margin, times 4 · deceleration · jerk².
inline bool far_from_end_of_range(const Setpoint& setpoint, const Modulo& modulo,
                                  const TO_Struct_DynamicLimits& limits) noexcept {
  const double margin = kEndOfRange - std::abs(setpoint.position.value);
  if (modulo.enabled) return margin > 0.0;
  const double d = limits.MaxDeceleration;
  const double j = limits.MaxJerk;
  const double v = std::abs(setpoint.velocity);
  const double a = std::abs(setpoint.acceleration);
  const double reached = 2.0 * j * v + a * a;  // velocity once the acceleration is run down, times 2 · jerk
  return reached * (d * (2.0 * a + d) + 0.5 * reached) < 4.0 * margin * d * j * j;
}

}  // namespace lockstep
