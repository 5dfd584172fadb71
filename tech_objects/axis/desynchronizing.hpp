/// Out of a synchronous motion: MC_GearOut, MC_CamOut.
#pragma once

#include <cstdint>

#include "tech_objects/axis/arrival.hpp"
#include "tech_objects/axis/job_dynamics.hpp"

namespace lockstep {

/// Jobs, the coupling, and the motion that comes after it.
struct LeavingParts {
  AxisData& data;
  JobSlots& jobs_;
  const MotionLimits& limits_;
  Setpoint& setpoint_;
  const Setpoint& last_setpoint_;
  const Modulo& modulo_;
  AxisMotion& motion_;
  SingleAxisMotion& single_;
  SynchronousMotion& synchronous_;
  Arrival& arrival_;
  JobEnds& ends_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
  JobDynamics& dynamics_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class LeavingOrders : private LeavingParts {
 public:
  /// What makes the setpoint of this tick.
  enum class Next : std::uint8_t {
    coupling,      ///< the candidate stays
    own_motion,    ///< the axis goes on by a motion of its own
    distance_out,  ///< it is led on the way out
    nothing        ///< it stays where it is
  };

  explicit LeavingOrders(const LeavingParts& parts) noexcept : LeavingParts(parts) {}

  /// What waits has been cancelled by the override rules; an active gear (cam) is left when the start is met.
  void begin(Job& job) noexcept;
  /// Each tick while desynchronizing waits. It looks at where the axis is with all that is superimposed.
  Next watch(const Setpoint& candidate) noexcept;
  /// The following axis has come to rest at its stop position.
  void end() noexcept;

 private:
  Next activate(Job& job, const Dynamics& dynamics) noexcept;
};

}  // namespace lockstep
