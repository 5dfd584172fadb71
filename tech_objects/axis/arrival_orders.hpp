/// The end of a motion: jobs that have arrived, and those that do not.
/// @source S7-1500T axis functions, positioning monitoring; alarm 541
#pragma once

#include "tech_objects/axis/arrival.hpp"
#include "tech_objects/axis/forces.hpp"
#include "tech_objects/axis/reactions.hpp"

namespace lockstep {

/// Where the axis is and is to be, and what tells whether that is of account.
struct ArrivalParts {
  const AxisData& data;
  const JobSlots& jobs_;
  const Setpoint& setpoint_;
  const Modulo& modulo_;
  const AxisPosition& actual_;
  const double& actual_velocity_;
  const SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  const HomingCourse& homing_;
  const AxisForces& forces_;
  const bool& has_drive_;
  const bool& position_controlled_;
  Arrival& arrival_;
  JobEnds& ends_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class ArrivalOrders : private ArrivalParts {
 public:
  explicit ArrivalOrders(const ArrivalParts& parts) noexcept : ArrivalParts(parts) {}

  /// Each tick of the base motion's job, once its profile is at its end.
  void watch(Job& job) noexcept;

 private:
  void watch_positioning() noexcept;
  void watch_standstill() noexcept;
  void take(Arrival::Verdict verdict) noexcept;
};

}  // namespace lockstep
