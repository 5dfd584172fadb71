/// Jobs: what a function block asks of an axis, and how far the axis has come with it.
#pragma once

#include <cstdint>
#include <type_traits>
#include <variant>

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/jobs/families.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// The instruction that a job comes from.
enum class JobKind : std::uint8_t {
  MC_Home,
  MC_Reset,
  MC_Halt,
  MC_MoveAbsolute,
  MC_MoveRelative,
  MC_MoveVelocity,
  MC_MoveJog,
  MC_Stop,
  MC_MoveSuperimposed,
  MC_MotionInSuperimposed,
  MC_HaltSuperimposed,
  MC_MotionInVelocity,
  MC_MotionInPosition,
  MC_GearIn,
  MC_GearInVelocity,
  MC_GearInPos,
  MC_CamIn,
  MC_PhasingAbsolute,
  MC_PhasingRelative,
  MC_OffsetAbsolute,
  MC_OffsetRelative,
  MC_LeadingValueAdditive,
  MC_GearOut,
  MC_CamOut,
  MC_MeasuringInput,
  MC_MeasuringInputCyclic,
  MC_AbortMeasuringInput,
  MC_InterpolateCam,
  MC_CopyCamData,
  MC_SetSensor,
  MC_SetAxisSTW,
  MC_WriteParameter
};

/// Whether an axis carries it out in the call that hands it over, and not at its next tick.
constexpr bool acts_at_once(JobKind kind) noexcept {
  return kind == JobKind::MC_SetSensor || kind == JobKind::MC_SetAxisSTW ||
         kind == JobKind::MC_WriteParameter;
}
/// Whether it couples the axis to a leading value.
constexpr bool couples(JobKind kind) noexcept {
  return kind == JobKind::MC_GearIn || kind == JobKind::MC_GearInPos || kind == JobKind::MC_GearInVelocity ||
         kind == JobKind::MC_CamIn;
}
/// Whether it couples the axis at positions of both axes, and so may wait for its start.
constexpr bool couples_at_position(JobKind kind) noexcept {
  return kind == JobKind::MC_GearInPos || kind == JobKind::MC_CamIn;
}
/// Whether it leaves synchronous operation and rests at a position.
constexpr bool leaves(JobKind kind) noexcept {
  return kind == JobKind::MC_GearOut || kind == JobKind::MC_CamOut;
}
/// Whether its dynamic values are setpoints given by the program.
constexpr bool gives_values(JobKind kind) noexcept {
  return kind == JobKind::MC_MotionInVelocity || kind == JobKind::MC_MotionInPosition ||
         kind == JobKind::MC_MotionInSuperimposed;
}
/// Whether it has to do with a cam.
constexpr bool of_cam(JobKind kind) noexcept {
  return kind == JobKind::MC_CamIn || kind == JobKind::MC_CamOut;
}
constexpr bool is_phasing(JobKind kind) noexcept {
  return kind == JobKind::MC_PhasingAbsolute || kind == JobKind::MC_PhasingRelative;
}
/// Whether it shifts the leading or the following value.
constexpr bool is_shift(JobKind kind) noexcept {
  return is_phasing(kind) || kind == JobKind::MC_OffsetAbsolute || kind == JobKind::MC_OffsetRelative;
}

/// When a job begins that finds another one running.
/// @source PLCopen Motion Control Part 1 v2.0, 2.4.2 (MC_BUFFER_MODE)
enum class BufferMode : std::uint8_t {
  mcAborting,          ///< at once; the running one is aborted
  mcBuffered,          ///< when the running one has ended
  mcBlendingLow,       ///< at its target, which is passed with the lower velocity of both
  mcBlendingPrevious,  ///< at its target, with the velocity of the running one
  mcBlendingNext,      ///< at its target, with the velocity of the new one
  mcBlendingHigh       ///< at its target, with the higher velocity of both
};

/// How far a job is. A block derives its outputs from this alone.
enum class JobPhase : std::uint8_t {
  idle,         ///< not handed over
  handed_over,  ///< taken over by the axis at its next interpolator tick
  waiting,      ///< accepted; waits for its start condition and touches no motion
  active,       ///< moves the axis; not yet where it wants to be
  reached,      ///< InVelocity, InGear, InSync: the job goes on and its aim is met
  done,
  aborted,  ///< by another job or by disabling
  failed    ///< `error` tells why
};

/// What has aborted a job.
enum class AbortedBy : std::uint8_t {
  unknown,
  job,         ///< `Job::aborted_by_job`
  disabling,   ///< of the axis, by MC_Power or at the end of a run
  restart,     ///< of the object
  fixed_stop,  ///< that the axis has met
  end_of_cam   ///< of the coupling that it acts on
};

/// What a job asks for besides, by the family of its kind; nothing for a job that only names its object.
using JobFamily = std::variant<std::monostate, ResetJob, SensorJob, ControlBitsJob, LimitSwitchesJob,
                               HomingJob, MoveAbsoluteJob, DistanceJob, VelocityJob, JogJob, StopJob,
                               MotionInJob, GearJob, CamJob, LeavingJob, ShiftJob, MeasuringJob, CamCopyJob>;

/// A request and its fate: what all jobs have, and what a family of instructions asks for. It lives in the
/// block that asks; the object that carries it out writes `phase`, `error` and what its family says. Thread:
/// the cycle.
struct Job {
  /// The job of the same instance that waits behind another, and whose place this one takes; nullptr: none.
  const Job* replaces = nullptr;
  /// The job that has aborted this one, in the block that asked for it; nullptr: none has.
  const Job* aborted_by_job = nullptr;
  JobKind kind{};
  JobPhase phase = JobPhase::idle;
  ErrorId error = ErrorId::none;
  BufferMode buffer_mode{};
  AbortedBy aborted_by = AbortedBy::unknown;
  bool position_controlled = true;  ///< whether the axis is, from when the job moves it by a base motion

  // Dynamic values of a motion, where its instruction has them: > 0 is used, < 0 stands for the default of
  // the technology object (the block's pins decide what is permitted).
  LREAL velocity = -1.0;      ///< [u/s]; of MC_MoveVelocity with its sign
  LREAL acceleration = -1.0;  ///< [u/s²]
  LREAL deceleration = -1.0;  ///< [u/s²]
  LREAL jerk = -1.0;          ///< [u/s³]; 0: trapezoidal

  JobFamily asks;

  /// What a job of that family asks for; the kind says which it is.
  template <class Family>
  Family& as() noexcept {
    return std::get<Family>(asks);
  }
  template <class Family>
  const Family& as() const noexcept {
    return std::get<Family>(asks);
  }

  bool ended() const noexcept { return phase >= JobPhase::done; }
  bool running() const noexcept { return phase >= JobPhase::handed_over && phase <= JobPhase::reached; }
  void fail(ErrorId id) noexcept {
    phase = JobPhase::failed;
    error = id;
  }
};
static_assert(std::is_trivially_copyable_v<Job>, "a job is copied in the cycle");

/// The leading object that a job names: that of a coupling, or of a phase shift; nullptr: none.
inline LeadingObject* master_of(const Job& job) noexcept {
  if (const auto* gear = std::get_if<GearJob>(&job.asks)) return gear->master;
  if (const auto* cam = std::get_if<CamJob>(&job.asks)) return cam->master;
  const auto* shift = std::get_if<ShiftJob>(&job.asks);
  return shift != nullptr ? shift->master : nullptr;
}

}  // namespace lockstep
