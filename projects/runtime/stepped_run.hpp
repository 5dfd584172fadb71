/// A run in virtual time that its owner steps, with its trace and its events in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hmi_bridge/traces/columns.hpp"
#include "hmi_bridge/traces/event.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/stored_trace.hpp"
#include "scheduler/events.hpp"
#include "scheduler/trace_ring.hpp"

namespace lockstep {

/// Steps a project as `lockstep run --simulate` does: stimuli apply, and the same file gives the same bits.
/// It starts no threads, opens no files and no connections, so that as many as the machine bears may run side
/// by side. One thread at a time.
class SteppedRun {
 public:
  /// What is wanted of it.
  struct Options {
    std::vector<NamedSignal> signals{};  ///< of the trace; empty: none is kept
    bool jobs = false;                   ///< jobs of blocks are events too
  };

  SteppedRun(Project project, const Options& options);
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  /// Runs servo ticks.
  /// @throws std::bad_alloc if there is no memory for the trace: what ran up to then counts
  void step(std::uint64_t ticks);

  /// Up to now.
  const StoredTrace& trace() const noexcept { return trace_; }
  /// Alarms and their acknowledgement, and jobs where they are wanted, oldest first.
  const std::vector<TraceEvent>& events() const noexcept { return events_; }
  Project& project() noexcept { return project_; }
  const Project& project() const noexcept { return project_; }

 private:
  void take_rows();
  void take_events();

  SteppedRun(Project project, const TraceColumns& columns, bool jobs);

  Project project_;
  TraceRing ring_;
  EventQueue queue_;
  EventTexts texts_;
  StoredTrace trace_;
  std::vector<TraceEvent> events_;
};

}  // namespace lockstep
