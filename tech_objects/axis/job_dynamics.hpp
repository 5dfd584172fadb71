/// The dynamic values with which a job moves the axis.
#pragma once

#include "tech_objects/axis/reactions.hpp"

namespace lockstep {

/// Limits, and the two motions that share them.
struct JobDynamicsParts {
  const JobSlots& jobs_;
  const MotionLimits& limits_;
  const Setpoint& setpoint_;
  const AxisMotion& motion_;
  const SingleAxisMotion& single_;
  SuperimposedMotion& superimposed_;
  const StopOrders& stops_;
  Reactions& reactions_;
};

/// Where a job asks for more than the limits there is a warning. Thread: the cycle.
class JobDynamics : private JobDynamicsParts {
 public:
  explicit JobDynamics(const JobDynamicsParts& parts) noexcept : JobDynamicsParts(parts) {}

  /// Those of a job, cut to the limits.
  Dynamics effective(const Job& job) noexcept;
  /// For a motion of the axis' own that takes over from the present state, below the velocity limit.
  Dynamics own(const Job& job) noexcept;
  /// A base motion that is planned anew within a step leaves what is superimposed its share.
  void leave_to_superimposed(const Job* job, Dynamics& dynamics) noexcept;
  BaseMotion base_motion() const noexcept;

 private:
  void tell(const ExceededLimits& exceeded, const Job& job) noexcept;
};

}  // namespace lockstep
