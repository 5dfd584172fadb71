/// By what an axis is led, and what shows of it.
#pragma once

#include "tech_objects/axis/attention.hpp"
#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {

/// The coupling of an axis, in effect or simulated.
struct AxisCouplingParts {
  AxisData& data;
  AxisMotion& motion_;
  SynchronousMotion& synchronous_;
  Coupled& coupled_;
  Job*& simulated_;
  Attention& attention;
};

/// Begins and forgets couplings; jobs are not ended by it, but for the gear that is simulated. Thread: the
/// cycle.
class AxisCoupling : private AxisCouplingParts {
 public:
  explicit AxisCoupling(const AxisCouplingParts& parts) noexcept : AxisCouplingParts(parts) {}

  /// The synchronous motion has taken over the coupling that a job asks for.
  void show(const Job& job, AxisMotion motion) noexcept;
  /// The axis moves on its own from now on.
  void leave() noexcept;
  /// The gear whose simulation goes on without the axis ends, and its coupling.
  void end_simulated(JobPhase phase, ErrorId error) noexcept;

 private:
  void forget() noexcept;
  void clear_cam_status() noexcept;
};

}  // namespace lockstep
