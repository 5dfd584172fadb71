/// Motion of an axis of its own: positioning, endless motion, jogging and stopping.
#pragma once

#include <cstdint>

#include "tech_objects/axis/arrival.hpp"
#include "tech_objects/axis/junction.hpp"

namespace lockstep {

/// Jobs, the setpoint, and what generates it without another axis.
struct MotionParts {
  AxisData& data;
  JobSlots& jobs_;
  MotionLimits& limits_;
  Setpoint& setpoint_;
  const Modulo& modulo_;
  AxisMotion& motion_;
  EmergencyRamp& emergency_ramp_;
  SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  Arrival& arrival_;
  const HomingCourse& homing_;
  const std::int64_t& counted_from_;
  JobEnds& ends_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
  PositionControlOrders& position_control_;
  PowerOrders& power_;
  JobDynamics& dynamics_;
  JunctionOrders& junction_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class MotionOrders : private MotionParts {
 public:
  explicit MotionOrders(const MotionParts& parts) noexcept : MotionParts(parts) {}

  /// A job of MC_Move…, MC_Halt, MC_Stop or an active homing begins.
  void begin(Job& job) noexcept;
  /// The one before it has gone beyond its target by this [u]: from there the distances of the next one
  /// count.
  void count_from_before(const DoubleDouble& beyond) noexcept { beyond_target_ = beyond; }
  /// Whether a job would leave the range of positions by where it ends, begun at this moment. On a ring every
  /// place is inside; targets themselves are checked where they come in.
  ErrorId refusal(const Job& job) const noexcept;
  /// The profile of a job, from the present setpoint.
  PlanResult plan(Job& job, const Dynamics& dynamics) noexcept;
  /// Limits and override count at once; so do the inputs of a jogging block.
  void follow_changes(Job& job) noexcept;
  /// In the data block.
  void show_target(const AxisPosition& target) noexcept;

 private:
  PlanResult plan_stop(const StopJob& asked, const Dynamics& given) noexcept;
  PlanResult plan_homing(const Job& job, const Dynamics& dynamics) noexcept;
  PlanResult move_by(DoubleDouble distance, const Job& job, const Dynamics& dynamics) noexcept;
  Dynamics maximum_for_current(Dynamics dynamics) const noexcept;

  DoubleDouble beyond_target_;
  Job jogged_;  // inputs of MC_MoveJog that are planned for
};

}  // namespace lockstep
