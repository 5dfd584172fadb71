/// What blocks without a job ask of an axis, and what a store keeps of it.
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/synchronous/leading_coupling.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// What MC_LeadingValueAdditive and MC_SynchronizedMotionSimulation want; written by the instance that was
/// enabled last.
struct AdditiveRequest {
  const void* owner = nullptr;  ///< nullptr: none is enabled
  bool counts = false;          ///< whether the value counts; else the job waits for the enable of the axis
  AdditiveLeadingValue value;
};
struct SimulationRequest {
  const void* owner = nullptr;  ///< nullptr: no instance has asked yet
  BOOL enable{};
  ErrorId error = ErrorId::none;  ///< written by the axis: why it has not begun, or cannot end
};

/// Adjustment of an absolute encoder, for a store that outlasts the controller.
struct EncoderAdjustment {
  bool adjusted = false;
  /// [u] StatusSensor[].AbsEncoderOffset: position of the axis less that of the encoder.
  double offset = 0.0;
};

}  // namespace lockstep
