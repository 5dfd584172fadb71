/// How an axis comes to rest from what it does, whatever that is.
#pragma once

#include "tech_objects/axis/axis_coupling.hpp"
#include "tech_objects/axis/job_ends.hpp"
#include "tech_objects/axis/superimposed_motion.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"

namespace lockstep {

/// The setpoint and what generates it.
struct StopParts {
  AxisData& data;
  Setpoint& setpoint_;
  Setpoint& last_setpoint_;
  AxisMotion& motion_;
  SingleAxisMotion& single_;
  SuperimposedMotion& superimposed_;
  const MotionLimits& limits_;
  JobEnds& ends_;
  AxisCoupling& coupling_;
};

/// The coupling is left, and what is superimposed becomes a part of the motion that goes on. Thread: the
/// cycle.
class StopOrders : private StopParts {
 public:
  explicit StopOrders(const StopParts& parts) noexcept : StopParts(parts) {}

  /// To rest, from the present setpoint.
  void begin(const Dynamics& dynamics, bool abort_acceleration) noexcept;
  /// At rest where the setpoint is, at once.
  void stand() noexcept;
  /// The setpoint stays where it is, and with it the following error: a published step of the velocity.
  void freeze() noexcept;

  /// Before any base motion begins anew: it takes over from what the axis does in all, and the superimposed
  /// part is one of the base motion from now on. Within a step, before the base motion has been advanced,
  /// that is the last setpoint.
  void absorb_superimposed() noexcept;

  /// Velocity that is left, in the direction of the present acceleration, up to the limit [u/s] ≥ 0; to a
  /// base motion beside what is superimposed.
  double margin_to_limit() const noexcept;
  /// An acceleration that cannot be run down below the velocity limit any more is cut.
  void cut_acceleration() noexcept {
    setpoint_.acceleration = limits_.tolerable_acceleration(setpoint_.acceleration, margin_to_limit());
  }
};

}  // namespace lockstep
