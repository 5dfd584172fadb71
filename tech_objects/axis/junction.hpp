/// How the running positioning goes over into the job that waits for its end.
#pragma once

#include "tech_objects/axis/blending.hpp"
#include "tech_objects/axis/job_dynamics.hpp"

namespace lockstep {

/// Both motions.
struct JunctionParts {
  const JobSlots& jobs_;
  const MotionLimits& limits_;
  const Setpoint& setpoint_;
  const Modulo& modulo_;
  const SuperimposedMotion& superimposed_;
  SingleAxisMotion& single_;
  Blending& blending_;
  JobDynamics& dynamics_;
};

/// While a job is buffered. Thread: the cycle.
class JunctionOrders : private JunctionParts {
 public:
  explicit JunctionOrders(const JunctionParts& parts) noexcept : JunctionParts(parts) {}

  /// The running positioning passes its target with the velocity that the mode of the next job asks for.
  void plan() noexcept;
  /// Each tick until then.
  void speed_up() noexcept;

 private:
  NextMotion motion_after_target(const Job& job) noexcept;
};

}  // namespace lockstep
