/// A job that waits for the end of another.
#pragma once

#include "tech_objects/axis/motion.hpp"

namespace lockstep {

/// Jobs, and the motion at whose end one waits.
struct BufferParts {
  JobSlots& jobs_;
  const MotionLimits& limits_;
  const Setpoint& setpoint_;
  const Modulo& modulo_;
  const AxisMotion& motion_;
  Job* const& simulated_;
  const SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  Blending& blending_;
  JobEnds& ends_;
  StopOrders& stops_;
  JunctionOrders& junction_;
  MotionOrders& motion_orders_;
};

/// Thread: the cycle.
class BufferOrders : private BufferParts {
 public:
  explicit BufferOrders(const BufferParts& parts) noexcept : BufferParts(parts) {}

  /// Whether the job waits, or has been refused; false: nothing runs that it could wait for, and it starts at
  /// once.
  bool take(Job& job) noexcept;
  /// Each tick in which a job waits: the one before it may have ended, or have passed its target on the way.
  void watch() noexcept;
};

}  // namespace lockstep
