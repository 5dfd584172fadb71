/// Which job ends which: the override tables as data.
/// @source S7-1500T synchronous operation V7, 12.3.1, 12.3.2 and 12.3.3
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "tech_objects/jobs/job.hpp"

namespace lockstep {

/// Rows and columns of the tables. A waiting job and the same job once active are two of them.
enum class JobClass : std::uint8_t {
  home_passive,  ///< MC_Home Mode 2, 8, 10
  home_active,   ///< MC_Home Mode 3, 5
  motion,        ///< MC_Halt, MC_MoveAbsolute, MC_MoveRelative, MC_MoveVelocity, MC_MoveJog
  stop,          ///< MC_Stop
  superimposed,  ///< MC_MoveSuperimposed, MC_MotionInSuperimposed, MC_HaltSuperimposed
  motion_in,     ///< MC_MotionInVelocity, MC_MotionInPosition
  gear_in,
  gear_in_velocity,
  gear_in_pos_waiting,
  gear_in_pos_active,
  cam_in_waiting,
  cam_in_active,
  phasing,                 ///< MC_PhasingAbsolute, MC_PhasingRelative
  offset,                  ///< MC_OffsetAbsolute, MC_OffsetRelative
  leading_value_additive,  ///< MC_LeadingValueAdditive
  gear_out_waiting,
  gear_out_active,
  cam_out_waiting,
  cam_out_active,
  measuring,        ///< MC_MeasuringInput, MC_MeasuringInputCyclic
  measuring_abort,  ///< MC_AbortMeasuringInput; never a running job
  home_cancel,      ///< MC_Home Mode 9; never a running job
  home_direct       ///< MC_Home Mode 0, 1, 6, 7, 11, 12, 13: ends nothing; MC_Reset and jobs of cams as well
};
inline constexpr int kRunningClasses = 20;  ///< columns: all up to measuring

/// What becomes of the running job when a new one starts.
enum class OverrideEffect : std::uint8_t {
  none,          ///< the running job goes on
  abort,         ///< the running job ends with CommandAborted
  reject,        ///< the running job goes on, the new one is rejected
  abort_by_rank  ///< MC_Stop against MC_Stop: aborted by the same or a stronger stop reaction
};

/// Class of a job: its row when it starts (`active` false for a job that waits) or its column while it runs.
JobClass class_of(const Job& job, bool active) noexcept;

/// Effect of a new job on a running one. Pure; bounded.
/// @param position_controlled whether the following axis is position-controlled (footnote 5)
OverrideEffect override_effect(JobClass new_job, JobClass running, bool position_controlled) noexcept;

/// One row of the table as it is written, for `describe` and the tests.
struct OverrideRow {
  JobClass new_job;
  std::string_view codes;    ///< a letter per running class; see override.cpp
  std::array<int, 3> lines;  ///< lines of the manual's text, in 12.3.1, 12.3.2 and 12.3.3; 0: none
};

/// A cell in which Lockstep differs from the printed tables on purpose.
struct OverrideException {
  JobClass new_job;
  JobClass running;
  OverrideEffect effect;
  std::string_view reason;
};

std::array<OverrideRow, 23> override_rows() noexcept;
std::array<OverrideException, 4> override_exceptions() noexcept;

}  // namespace lockstep
