/// Whether the state of an axis permits a job at all.
#pragma once

#include <memory>
#include <vector>

#include "tech_objects/axis/motion.hpp"
#include "tech_objects/axis/sensors.hpp"

namespace lockstep {

/// What a job may find in its way.
struct JobCheckParts {
  const LeadingObject& self_;
  const AxisData& data;
  const JobSlots& jobs_;
  const std::vector<LeadingValue>& leading_values;
  const PowerState& power_state_;
  const bool& position_controlled_;
  const bool& homed_;
  const AxisMotion& motion_;
  const Coupled& coupled_;
  Job* const& simulated_;
  const bool& has_drive_;
  const std::unique_ptr<Drive>& drive_;
  const Encoders& encoders_;
  const SwitchOrders& switches_;
  const SensorOrders& sensors_;
  const MotionOrders& motion_orders_;
};

/// What a job needs and does not find.
struct MissingPrecondition {
  int alarm = 0;  ///< number of the alarm; 0: all is there
  AlarmDetail detail{};
};

/// Changes nothing. Thread: the cycle.
class JobChecks : private JobCheckParts {
 public:
  explicit JobChecks(const JobCheckParts& parts) noexcept : JobCheckParts(parts) {}

  /// Why the job is refused.
  ErrorId refusal(const Job& job) const noexcept;
  /// The precondition that is missing, where its absence is an alarm.
  MissingPrecondition missing_precondition(const Job& job) const noexcept;

 private:
  ErrorId check_synchronous(const Job& job) const noexcept;
  ErrorId check_cam(const Job& job) const noexcept;
  ErrorId check_homing(const Job& job) const noexcept;
  MissingPrecondition missing_for_homing(const Job& job) const noexcept;
};

}  // namespace lockstep
