/// What is added to the base motion: MC_MoveSuperimposed, MC_MotionInSuperimposed, MC_HaltSuperimposed.
#pragma once

#include "tech_objects/axis/job_dynamics.hpp"

namespace lockstep {

/// Both motions, and the limits that they share.
struct SuperimposedParts {
  AxisData& data;
  JobSlots& jobs_;
  MotionLimits& limits_;
  Setpoint& setpoint_;
  const Modulo& modulo_;
  const AxisMotion& motion_;
  const bool& position_controlled_;
  Job* const& simulated_;
  SingleAxisMotion& single_;
  SuperimposedMotion& superimposed_;
  JobEnds& ends_;
  StopOrders& stops_;
  PositionControlOrders& position_control_;
  JobDynamics& dynamics_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class SuperimposedOrders : private SuperimposedParts {
 public:
  explicit SuperimposedOrders(const SuperimposedParts& parts) noexcept : SuperimposedParts(parts) {}

  void begin(Job& job) noexcept;

  // ---- One cycle: before the base motion, and behind it

  void advance() noexcept;
  /// A halt, or a stop for which no job asks any more, leaves a margin as other base motions do, but does not
  /// turn back: where it runs its deceleration down already, it keeps the jerk that it needs for that.
  void replan_stop() noexcept;
  /// The setpoint is that of both. One that is over is a part of the base motion once that rests.
  void finish() noexcept;

 private:
  void take_position_control() noexcept;
  void follow_job() noexcept;
  void follow_share() noexcept;
  void follow_given(Job& job) noexcept;
};

}  // namespace lockstep
