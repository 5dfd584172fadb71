/// Running the cycle in real time: a thread of its own on the grid of servo ticks.
/// @source contract of the project file, section 4
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "scheduler/controller.hpp"
#include "scheduler/waiting_clock.hpp"

namespace lockstep {

enum class OverrunPolicy : std::uint8_t {
  report,  ///< overruns are counted
  stop     ///< three overrun interpolator cycles in a row stop the axes and the run
};

/// What a run in real time looks like from outside; every member may be read by any thread while it goes on.
struct RealTimeStatus {
  std::atomic<std::uint64_t> ticks{0};         ///< servo ticks executed
  std::atomic<std::uint64_t> missed_ticks{0};  ///< ticks of the grid that were left out
  std::atomic<std::uint64_t> overruns{0};  ///< interpolator cycles that were not over at the next one's time
  std::atomic<std::int64_t> worst_lateness{0};  ///< latest start of a tick after its time [ns]
  std::atomic<std::int64_t> longest_tick{0};    ///< [ns]
  std::atomic<std::int64_t> busy{0};            ///< time of all ticks together [ns]
  std::atomic<std::int64_t> time{0};            ///< time of the controller [ns]
  std::atomic<std::int64_t> start{0};           ///< of its clock when that time is 0 [ns]; 0: not known yet
  std::atomic<bool> stopped_by_overrun{false};
  std::atomic<bool> at_rest{
      false};  ///< the axes are off, or the time for it is over; ticks go on until `wait`
};

/// What the system has given to the thread of a cycle.
struct RealTimeRights {
  bool priority = false;  ///< of SCHED_FIFO, `kCyclePriority`
  bool memory = false;    ///< is locked
};

/// Owns the thread of the cycle. Threads: one that starts, stops and waits.
class RealTimeRun {
 public:
  /// @param duration runs the ticks with t < duration [ns]; negative: until `stop`
  /// @param processor of the cycle, which others have left (`leave_processor`); negative: any
  /// @param clock that it waits for; it outlives this
  RealTimeRun(Controller& controller, OverrunPolicy policy, std::int64_t duration, int processor = -1,
              WaitingClock& clock = monotonic_clock());
  ~RealTimeRun();
  RealTimeRun(const RealTimeRun&) = delete;
  RealTimeRun& operator=(const RealTimeRun&) = delete;

  /// Has the ticks begin at a whole multiple of `cycle` of the clock that several controllers share, so that
  /// equal cycles are in phase, and notes in the controller what that is when its time is 0. Before `start`.
  /// @param offset what the shared clock shows more than the one that this waits for [ns]
  void align(std::int64_t cycle, std::int64_t offset) noexcept {
    aligned_to_ = cycle;
    shared_offset_ = offset;
  }

  /// Starts the thread with real-time priority and locked memory as far as the system permits.
  /// @return what was not permitted, as plain warnings
  std::vector<std::string> start();
  /// What it permitted. After `start`.
  const RealTimeRights& rights() const noexcept { return rights_; }

  /// Asks the run to end: axes are brought to rest, then ticks go on until somebody waits for the end. Any
  /// thread.
  void stop() noexcept { stop_requested_.store(true, std::memory_order_relaxed); }
  /// Lets it end once the axes are at rest, and waits for that. One whole tick comes after this call, so that
  /// whatever was handed to the cycle before it is taken.
  void wait();

  const RealTimeStatus& status() const noexcept { return status_; }

 private:
  void run() noexcept;
  std::int64_t first_tick() noexcept;
  void count_overrun(bool overrun) noexcept;
  void interpolate_cams() noexcept;

  Controller& controller_;
  OverrunPolicy policy_;
  std::int64_t duration_;
  int processor_;
  WaitingClock& clock_;
  std::int64_t aligned_to_ = 0;  // [ns]; 0: to nothing
  std::int64_t shared_offset_ = 0;
  RealTimeRights rights_;
  std::atomic<bool> stop_requested_{false};
  std::atomic<bool> may_end_{false};
  RealTimeStatus status_;
  int overruns_in_a_row_ = 0;
  std::thread thread_;
  std::atomic<bool> interpolating_{false};
  std::thread interpolation_;  // of cams; none without cams
};

}  // namespace lockstep
