/// Shifts of a synchronous axis: MC_Phasing… and MC_Offset…
/// @source S7-1500T synchronous operation V7, 4.5
#pragma once

#include "tech_objects/axis/job_dynamics.hpp"

namespace lockstep {

/// Jobs, and the coupling whose shifts they are.
struct ShiftingParts {
  JobSlots& jobs_;
  const MotionLimits& limits_;
  const double& period_;
  SynchronousMotion& synchronous_;
  JobEnds& ends_;
  JobDynamics& dynamics_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class ShiftOrders : private ShiftingParts {
 public:
  explicit ShiftOrders(const ShiftingParts& parts) noexcept : ShiftingParts(parts) {}

  void begin(Job& job) noexcept;
  /// Profile 5: ends a shift that waits; one that runs and the shift in effect stay.
  void cancel_waiting(Job& job) noexcept;
  /// What the coupling depends on in this tick: ratio, leading value, shifts. @param job that couples
  void look_at_coupling(const Job& job) noexcept {
    if (job.kind == JobKind::MC_GearInVelocity) take_ratio(job);
    synchronous_.look_at_leading();
    if (synchronous_.shifted()) advance();
  }
  /// The ratio that an MC_GearInVelocity asks for, if it is to be renewed.
  void take_ratio(const Job& job) noexcept;
  /// Phase shift and offset of this tick; behind the look at the leading value.
  void advance() noexcept;

 private:
  void show(Slot slot, Job& job, const Shift& shift, Shift::Event event) noexcept;
  void end(Slot slot, Shift::Event event) noexcept;
};

}  // namespace lockstep
