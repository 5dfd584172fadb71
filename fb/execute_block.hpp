/// The contract of all blocks with an input Execute: edge, hand-over of a job, and outputs from its phase.
/// @source S7-1500T programming, function-block contract; decisions on retriggering in the README of this
/// folder
#pragma once

#include <array>

#include "fb/job_block.hpp"

namespace lockstep {

/// A rising edge of Execute takes the inputs over and hands a job to the object. Done, CommandAborted and
/// Error last while Execute is TRUE and at least for one call. A new edge starts a new job, which the outputs
/// show from then on.
class ExecuteBlock : public JobBlock {
 public:
  BOOL Execute{};
  BOOL Done{};

  void call(std::int64_t now) noexcept final;
  const Job* shown_job() const noexcept override { return job_; }

 protected:
  /// Carries the job out or hands it over. The default submits it to the target.
  virtual void hand_over(Job& job) noexcept;
  /// Shows the phase at outputs of the block's own.
  virtual void show(JobPhase /*phase*/) noexcept {}

  Job* job() noexcept { return job_; }

 private:
  void start() noexcept;
  Job& free_job() noexcept;

  bool last_execute_ = false;
  bool settled_ = false;  // an ended job has been shown twice, and nothing changes until Execute does
  Job* job_ = nullptr;    // the one that the outputs show
  // The job that moves the axis, one that waits and one that is being handed over may be three.
  std::array<Job, 3> jobs_{};
};

/// Pins that many blocks share, spelled once.
namespace pin {

inline constexpr Pin kExecute =
    in<&ExecuteBlock::Execute>("Execute", Unit::kNone, kAny, "a rising edge starts the job");
inline constexpr Pin kDone = out<&ExecuteBlock::Done>("Done", "the job is complete");

template <class T>
constexpr Pin velocity(std::string_view text, InputFacts facts = {.error = ErrorId::velocity}) {
  return in<&T::Velocity>("Velocity", Unit::kVelocity, kNotZero, text, facts);
}
template <class T>
constexpr Pin acceleration(InputFacts facts = {.error = ErrorId::acceleration}) {
  return in<&T::Acceleration>("Acceleration", Unit::kAcceleration, kNotZero,
                              "> 0: used; < 0: DynamicDefaults.Acceleration; 0 is not permitted", facts);
}
template <class T>
constexpr Pin deceleration(InputFacts facts = {.error = ErrorId::deceleration}) {
  return in<&T::Deceleration>("Deceleration", Unit::kAcceleration, kNotZero,
                              "> 0: used; < 0: DynamicDefaults.Deceleration; 0 is not permitted", facts);
}
template <class T>
constexpr Pin jerk(InputFacts facts = {.error = ErrorId::jerk}) {
  return in<&T::Jerk>("Jerk", Unit::kJerk, kFinite,
                      "> 0: used; 0: trapezoidal velocity profile; < 0: DynamicDefaults.Jerk", facts);
}
template <class T>
constexpr Pin abort_acceleration() {
  return in<&T::AbortAcceleration>("AbortAcceleration", Unit::kNone, kAny,
                                   "TRUE: an acceleration at the start is set to 0 at once");
}
inline constexpr Choice kBufferModes[] = {
    {0, "mcAborting: at once, the running job is aborted"},
    {1, "mcBuffered: when the running job has ended"},
    {2, "mcBlendingLow: at the target of the running job, passed with the lower velocity of both"},
    {3, "mcBlendingPrevious: … with the velocity of the running job"},
    {4, "mcBlendingNext: … with the velocity of the new job"},
    {5, "mcBlendingHigh: … with the higher velocity of both"}};
template <class T>
constexpr Pin buffer_mode() {
  return in<&T::BufferMode>("BufferMode", Unit::kNone, kAny, "MC_BUFFER_MODE: when the job begins",
                            {.error = ErrorId::mode, .choices = kBufferModes});
}

}  // namespace pin

}  // namespace lockstep
