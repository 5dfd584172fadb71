/// MC_Home at once: direct setting of positions, encoder adjustment.
/// @source S7-1500T axis functions, homing
#pragma once

#include "tech_objects/axis/position_names.hpp"

namespace lockstep {

/// Modes that adjust an encoder: relative and absolute, incremental encoder.
bool adjusts_encoder(HomeMode mode) noexcept;

/// Setpoint, actual value and what they are called.
struct DirectHomingParts {
  const JobSlots& jobs_;
  Setpoint& setpoint_;
  const Modulo& modulo_;
  AxisPosition& actual_;
  std::int64_t& counted_from_;
  bool& homed_;
  const bool& has_drive_;
  const AxisMotion& motion_;
  SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  Encoders& encoders_;
  SensorOrders& sensors_;
  PositionNames& names_;
};

/// Thread: the cycle.
class DirectHoming : private DirectHomingParts {
 public:
  explicit DirectHoming(const DirectHomingParts& parts) noexcept : DirectHomingParts(parts) {}

  /// Setpoint and actual position are shifted together; nothing moves.
  void home(Job& job) noexcept;

 private:
  void home_sensor_beside(Job& job) noexcept;
};

}  // namespace lockstep
