/// What happens in the cycle and is to be told outside of it: alarms, jobs, overruns.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fb/block.hpp"
#include "tech_objects/alarms/detail.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

enum class EventKind : std::uint8_t {
  alarm,         ///< a technology alarm has come
  acknowledged,  ///< the alarms of an object have been acknowledged
  job_started,
  job_done,
  job_aborted,
  job_failed,        ///< or was rejected
  job_ended,         ///< let go by its Enable
  overrun,           ///< an interpolator cycle was not over in time
  command_accepted,  ///< of a panel; told by the bridge, as the next
  command_refused,
  printed,        ///< a program of an object has printed a line
  program_error,  ///< of an object with programs of its own
  written,        ///< somebody has written a value by hand; told by the bridge, as the next
  write_refused
};

/// Whether the source is an object, and not an instance of a block.
constexpr bool of_object(EventKind kind) noexcept {
  return kind == EventKind::alarm || kind == EventKind::acknowledged || kind == EventKind::printed ||
         kind == EventKind::program_error;
}

struct Event {
  EventKind kind{};
  std::int16_t reaction = 0;  ///< of an alarm: value of ErrorDetail.Reaction; 0: none
  std::uint32_t source = 0;   ///< index of the object, or of the instance
  std::int32_t number = 0;    ///< of an alarm; ErrorID of a job that has failed
  std::int64_t t = 0;         ///< of the tick [ns] since the start of the run
  std::uint64_t tick = 0;     ///< number of the servo tick
  bool late = false;          ///< ticks were missed within a second before it
  AbortedBy aborted_by{};     ///< of an aborted job
  /// Number of the object that a job is of, from 1; 0: it is of none, or an alarm.
  std::uint16_t object = 0;
  AlarmDetail detail{};                 ///< of an alarm
  const Job* aborted_by_job = nullptr;  ///< of an aborted job: whose address tells the instance
  std::int32_t line = 0;                ///< of a program that has an error; its number is `reaction`
};

/// The crossing of events: a ring with one writer and one reader, neither of which waits for the other inside
/// a tick. Threads: the *cycle* pushes, the *runner* (the same thread, between two ticks) may wait, the
/// *recorder* reads.
class EventQueue {
 public:
  /// Allocates all memory; holds `size` events, rounded up to a power of two.
  explicit EventQueue(std::size_t size = 4096);

  /// Cycle. What finds the ring full is counted.
  void push(const Event& event) noexcept;

  /// Runner, between two ticks: returns when half of the ring is free, so that virtual time loses nothing.
  /// @return false if nobody will read any more
  bool wait_for_space() const noexcept;

  /// Any thread.
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

  /// Recorder: those that can be read now, oldest first, and giving them back.
  std::size_t readable() const noexcept {
    return written_.load(std::memory_order_acquire) - read_.load(std::memory_order_relaxed);
  }
  const Event& event(std::size_t index) const noexcept {
    return events_[(read_.load(std::memory_order_relaxed) + index) & mask_];
  }
  void pop(std::size_t events) noexcept {
    read_.store(read_.load(std::memory_order_relaxed) + events, std::memory_order_release);
  }
  /// Nothing will be read any more.
  void close() noexcept { closed_.store(true, std::memory_order_release); }

 private:
  const std::size_t mask_;
  std::vector<Event> events_;
  alignas(kCacheLine) std::atomic<std::uint64_t> written_{0};
  std::atomic<std::uint64_t> lost_{0};
  alignas(kCacheLine) std::atomic<std::uint64_t> read_{0};
  std::atomic<bool> closed_{false};
};

/// Which events of jobs are told.
enum class JobsTold : std::uint8_t {
  failures,  ///< those that have failed, and aborted shifts
  all
};

/// Looks at the outputs of an instance in every tick and tells when its job starts and how it ends. Thread:
/// the cycle.
class JobWatch {
 public:
  /// @param instance its index; a block without Busy has no jobs: `usable` is false then
  JobWatch(const BlockType& type, Block& block, std::uint32_t instance);

  bool usable(JobsTold told) const noexcept {
    return told == JobsTold::all ? busy_ != nullptr : error_ != nullptr;
  }

  /// Hands what has happened since the last look to `tell(kind, number)`.
  template <class Tell>
  void look(JobsTold told, Tell tell) noexcept {
    if (told == JobsTold::failures) return look_for_failures(tell);
    const auto on = [](const bool* pin) { return pin != nullptr && *pin; };
    const State now{on(execute_), *busy_, on(done_), on(aborted_), on(error_)};
    const State last = last_;
    last_ = now;
    if (now.busy && (!last.busy || (now.execute && !last.execute))) tell(EventKind::job_started, 0);
    if (now.error && !last.error) return tell(EventKind::job_failed, static_cast<int>(*error_id_));
    if (now.done && !last.done) return tell(EventKind::job_done, 0);
    if (now.aborted && !last.aborted) return tell(EventKind::job_aborted, 0);
    if (last.busy && !now.busy && !now.error && !now.done && !now.aborted) tell(EventKind::job_ended, 0);
  }
  std::uint32_t instance() const noexcept { return instance_; }
  /// Number of the object that carries the job out; 0: none is wired.
  std::uint16_t object() const noexcept;
  /// The job that the block shows; nullptr: none that tells more.
  const Job* job() const noexcept { return block_->shown_job(); }

 private:
  template <class Tell>
  void look_for_failures(Tell tell) noexcept {
    const bool failed = *error_, aborted = shifts_ && *aborted_;
    if (failed == last_.error && aborted == last_.aborted) return;
    if (failed && !last_.error) tell(EventKind::job_failed, static_cast<int>(*error_id_));
    if (aborted && !last_.aborted) tell(EventKind::job_aborted, 0);
    last_.error = failed;
    last_.aborted = aborted;
  }

  struct State {
    bool execute = false, busy = false, done = false, aborted = false, error = false;
  };

  std::uint32_t instance_;
  bool shifts_ = false;  // a phase shift or an offset
  const Block* block_;
  const void* object_ = nullptr;  // the pin, which holds its address
  const bool *execute_ = nullptr, *busy_ = nullptr, *done_ = nullptr, *aborted_ = nullptr, *error_ = nullptr;
  const WORD* error_id_ = nullptr;
  State last_;
};

}  // namespace lockstep
