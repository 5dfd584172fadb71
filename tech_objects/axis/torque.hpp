/// Torque limiting, torque data and the fixed stop of an axis with a drive.
/// @source S7-1500T axis functions, force and torque limiting, fixed stop detection, torque data
#pragma once

#include <memory>

#include "tech_objects/axis/clamping.hpp"
#include "tech_objects/axis/forces.hpp"
#include "tech_objects/axis/reactions.hpp"

namespace lockstep {

/// What the drive is told of forces, and what shows that the axis pushes against something.
struct TorqueParts {
  AxisData& data;
  const JobSlots& jobs_;
  const PowerState& power_state_;
  const Setpoint& setpoint_;
  const Modulo& modulo_;
  const AxisPosition& actual_;
  const AxisMotion& motion_;
  const SingleAxisMotion& single_;
  const bool& position_controlled_;
  const std::unique_ptr<Drive>& drive_;
  const DriveProperties& drive_properties_;
  const bool& drive_running_;
  const double& setpoint_sign_;
  const double& actual_torque_;
  AxisForces& forces_;
  Clamping& clamping_;
  JobEnds& ends_;
  StopOrders& stops_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class TorqueOrders : private TorqueParts {
 public:
  explicit TorqueOrders(const TorqueParts& parts) noexcept : TorqueParts(parts) {}

  /// Each interpolator cycle of an axis with a drive, before it moves.
  void step() noexcept;
  /// Whether a job may start at the fixed stop: only motions away from it, under position control.
  ErrorId check_at_fixed_stop(const Job& job) const noexcept;

 private:
  bool pushes_against_a_stop() const noexcept;
  void watch_fixed_stop() noexcept;
  void watch_clamping() noexcept;
};

}  // namespace lockstep
