/// MC_Home with a mark, in passing or by a motion of its own.
/// @source S7-1500T axis functions, homing
#pragma once

#include "tech_objects/axis/position_names.hpp"

namespace lockstep {

/// Jobs, the course to the mark, and what moves the axis there.
struct HomingParts {
  const AxisData& data;
  JobSlots& jobs_;
  const AxisPosition& actual_;
  bool& homed_;
  bool& homing_now_;
  const bool& has_drive_;
  const std::unique_ptr<Drive>& drive_;
  HomingCourse& homing_;
  const Encoders& encoders_;
  const LimitSwitches& limit_switches_;
  Arrival& arrival_;
  MotionLimits& limits_;
  const SuperimposedMotion& superimposed_;
  SwitchOrders& switches_;
  JobEnds& ends_;
  StopOrders& stops_;
  const SensorOrders& sensors_;
  JobDynamics& dynamics_;
  MotionOrders& motion_orders_;
  PositionNames& names_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class HomingOrders : private HomingParts {
 public:
  explicit HomingOrders(const HomingParts& parts) noexcept : HomingParts(parts) {}

  /// Beside whatever moves the axis.
  void begin_in_passing(Job& job) noexcept;
  void begin_active(Job& job) noexcept;
  /// Each interpolator tick of a homing, before the setpoint is made.
  void step() noexcept;

 private:
  void guide(Job& job) noexcept;
  void head_for(Job& job, HomingCourse::Phase phase, int direction) noexcept;
  AxisPosition place_of_mark() const noexcept;
  void take_mark() noexcept;
};

}  // namespace lockstep
