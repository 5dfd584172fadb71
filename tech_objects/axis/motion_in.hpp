/// Setpoints given by the program: MC_MotionInVelocity, MC_MotionInPosition.
#pragma once

#include "tech_objects/axis/position_control.hpp"
#include "tech_objects/axis/stops.hpp"

namespace lockstep {

/// Jobs and the setpoint.
struct GivenParts {
  AxisData& data;
  JobSlots& jobs_;
  const MotionLimits& limits_;
  Setpoint& setpoint_;
  const Modulo& modulo_;
  const double& period_;
  AxisMotion& motion_;
  SingleAxisMotion& single_;
  JobEnds& ends_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
  PositionControlOrders& position_control_;
};

/// Thread: the cycle.
class GivenOrders : private GivenParts {
 public:
  explicit GivenOrders(const GivenParts& parts) noexcept : GivenParts(parts) {}

  /// No profile leads there: the first values given count in this very cycle.
  void begin(Job& job) noexcept;
  /// The values of the last call. Without Enable they go to zero at once, and the position stays.
  /// @return whether the axis brakes instead, by a motion of its own
  bool step() noexcept;
};

}  // namespace lockstep
