/// Jobs that couple an axis to another one, which leads it from then on.
/// @source S7-1500T synchronous operation V7, 6
#pragma once

#include <vector>

#include "tech_objects/axis/attention.hpp"
#include "tech_objects/axis/job_dynamics.hpp"

namespace lockstep {

/// Jobs, the coupling in effect and the one that is waited for.
struct FollowingParts {
  const LeadingObject& self_;
  JobSlots& jobs_;
  const std::vector<LeadingValue>& leading_values;
  const MotionLimits& limits_;
  Setpoint& setpoint_;
  const Setpoint& last_setpoint_;
  const AxisMotion& motion_;
  Job* const& simulated_;
  SuperimposedMotion& superimposed_;
  SynchronousMotion& synchronous_;
  SynchronousMotion& awaited_;
  const bool& awaited_axis_in_order;
  Attention& attention;
  JobEnds& ends_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
  PositionControlOrders& position_control_;
  JobDynamics& dynamics_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class FollowingOrders : private FollowingParts {
 public:
  explicit FollowingOrders(const FollowingParts& parts) noexcept : FollowingParts(parts) {}

  /// MC_GearIn, MC_GearInVelocity: at once.
  void begin_gear_in(Job& job) noexcept;
  /// MC_GearInPos, MC_CamIn. One that is rejected leaves what waits already.
  void begin_waiting(Job& job) noexcept;
  /// Each tick while a synchronous job waits: has the leading value met the start?
  void watch_waiting() noexcept;
  /// The leading value has reached an end of the cam. One that is passed once ends its job: the axis stands
  /// at the end, or brakes if the cam ends with a slope. @return whether it does, from the last setpoint on
  bool meet_cam_end() noexcept;

 private:
  void activate_waiting(AxisMotion motion) noexcept;
};

}  // namespace lockstep
