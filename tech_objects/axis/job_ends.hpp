/// How the jobs of an axis end, and what their ends leave behind.
#pragma once

#include "tech_objects/axis/attention.hpp"
#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/axis/homing_course.hpp"
#include "tech_objects/axis/job_slots.hpp"
#include "tech_objects/axis/switches.hpp"
#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {

/// The jobs, and what ends with them.
struct JobEndParts {
  AxisData& data;
  JobSlots& jobs_;
  SynchronousMotion& synchronous_;
  Job* const& simulated_;
  const bool& position_controlled_;
  HomingCourse& homing_;
  bool& homing_now_;
  Attention& attention;
  SwitchOrders& switches_;
};

/// Ends jobs, and shows of it what is not written in every cycle. Moves nothing, raises nothing. Thread: the
/// cycle.
class JobEnds : private JobEndParts {
 public:
  explicit JobEnds(const JobEndParts& parts) noexcept : JobEndParts(parts) {}

  void end(Slot slot, JobPhase phase, ErrorId error) noexcept;
  /// Aborts a job, and notes what it was; nothing where the slot is empty.
  void abort(Slot slot, AbortedBy by, const Job* job = nullptr) noexcept;
  /// Those that are handed over as well; the lock of MC_Stop falls unless that is done.
  void end_all(JobPhase phase, ErrorId error, AbortedBy by = AbortedBy::unknown) noexcept;
  /// What acts on a coupling is aborted with it.
  void abort_shifts(AbortedBy by, const Job* job = nullptr) noexcept;
  /// Ends the running jobs that a new one overrides; false if one of them forbids it.
  bool override_running(JobClass new_job, Job& job) noexcept;
  /// A running homing ends, whatever the reason.
  void leave_homing() noexcept;

  // ---- What is shown of the jobs that run

  void show_waiting() noexcept;
  void show_superimposed_command() noexcept;
  void show_motion_in_command() noexcept;
};

}  // namespace lockstep
