/// The jobs of an axis: those handed over, those that run or wait, and which of them a new one ends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/jobs/job.hpp"
#include "tech_objects/jobs/override.hpp"

namespace lockstep {

/// Places of running jobs: the base motion, synchronous and desynchronizing jobs that wait, shifts, what is
/// superimposed on the base motion, the next base motion, homing in passing.
enum Slot : std::uint8_t {
  kBase,
  kWaiting,
  kWaitingOut,
  kPhasing,
  kOffset,
  kSuperimposed,
  kBuffered,
  kPassiveHoming,
  kSlots
};

/// What a new job does to those that run.
struct Overriding {
  ErrorId refusal = ErrorId::none;  ///< one of them forbids the new job; then none of them ends
  std::array<bool, kSlots> ends{};  ///< which of them it ends
};

/// Each running job in its slot. They live in the blocks that ask, and stay there until they have ended.
/// Thread: the cycle.
class JobSlots {
 public:
  Job* operator[](std::size_t slot) const noexcept { return running_[slot]; }
  bool empty(Slot slot) const noexcept { return running_[slot] == nullptr; }
  /// Whether no job runs or waits but, perhaps, in slots of a set: bits 1 << Slot.
  bool none_but(unsigned slots) const noexcept { return (taken_ & ~slots) == 0; }
  /// Address of the slots, for the prefetch.
  const void* address() const noexcept { return running_.data(); }

  /// @param phase that the job has from now on
  void put(Slot slot, Job& job, JobPhase phase) noexcept {
    put_back(slot, job);
    job.phase = phase;
  }
  /// A job goes on from where it has been put aside.
  void put_back(Slot slot, Job& job) noexcept {
    running_[slot] = &job;
    taken_ = static_cast<std::uint8_t>(taken_ | 1u << slot);
  }
  /// The job leaves its slot, and goes on or ends elsewhere; nullptr: there is none.
  Job* take(Slot slot) noexcept {
    Job* const job = running_[slot];
    running_[slot] = nullptr;
    taken_ = static_cast<std::uint8_t>(taken_ & ~(1u << slot));
    return job;
  }

  /// A job ends. An alarm shows at MC_Stop as CommandAborted.
  static void end(Job& job, JobPhase phase, ErrorId error) noexcept;

  // ---- Handed over

  /// With no space left the job fails with 16#8014 at once.
  void submit(Job& job) noexcept;
  bool has_new() const noexcept { return new_count_ != 0; }
  /// Hands each to `start`, in order, and forgets them.
  template <class Start>
  void take_new(Start start) noexcept {
    for (std::size_t i = 0; i < new_count_; ++i) start(*new_[i]);
    new_count_ = 0;
  }
  void end_new(JobPhase phase, ErrorId error) noexcept;

  // ---- Rules

  /// What a job, as of a class, does to the others by the override rules.
  Overriding overriding(JobClass new_job, const Job& job, bool position_controlled) const noexcept;
  /// Whether a gear (a cam) runs, waits or is about to be left.
  bool runs_or_waits(bool cam) const noexcept;

  // ---- MC_Stop

  /// Strength of its stop reaction: emergency stop over maximum dynamics over given dynamics.
  static int stop_rank(StopMode mode) noexcept;
  /// MC_Stop locks the axis while it runs, and while it is done with its Execute TRUE.
  void lock(const Job& stop) noexcept { stop_ = &stop; }
  void unlock() noexcept { stop_ = nullptr; }
  /// Whether some MC_Stop may lock the axis; `locked` looks whether it does.
  bool lockable() const noexcept { return stop_ != nullptr; }
  /// One that is done keeps the axis locked until its Execute falls.
  void unlock_unless_done() noexcept {
    if (stop_ != nullptr && stop_->phase != JobPhase::done) stop_ = nullptr;
  }
  bool locked() const noexcept {
    return stop_ != nullptr &&
           (stop_->running() || (stop_->phase == JobPhase::done && stop_->as<StopJob>().hold));
  }
  /// Whether a running MC_Stop stops harder than an alarm asks for: then it goes on.
  /// @source S7-1500T axis functions, MC_Stop, rank of stop reactions
  bool stops_harder_than(AlarmReaction reaction) const noexcept;

 private:
  static constexpr std::size_t kNewJobs = 16;

  std::array<Job*, kSlots> running_{};  // a line of the cache
  std::array<Job*, kNewJobs> new_{};    // handed over, in order
  const Job* stop_ = nullptr;           // the MC_Stop that may lock the axis
  std::uint8_t new_count_ = 0;          // last, beside what an axis touches in every cycle
  std::uint8_t taken_ = 0;              // slots with a job: bits 1 << Slot
};

}  // namespace lockstep
