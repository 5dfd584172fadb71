/// The thread that carries rows from the ring to the sinks.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"
#include "scheduler/trace_ring.hpp"

namespace lockstep {

/// Where the recorder finds events, and what it knows of their sources.
struct EventSource {
  EventQueue* queue = nullptr;  ///< nullptr: none; it must outlive the recorder
  EventTexts texts;
  bool rows_follow = true;  ///< an event waits for the row of its tick, so that both have one order
};

/// Drains a ring into sinks until it is stopped. The cycle neither wakes it nor waits for it: it looks every
/// few milliseconds. Writing to a closed pipe or beyond a file size limit is an error of the sink, not a
/// signal.
class TraceRecorder {
 public:
  /// How often an idle recorder looks for rows. A ring should hold several times as many rows as arrive
  /// meanwhile.
  static constexpr std::chrono::milliseconds kPoll{2};
  /// Events of the bridge that wait at most; those beyond are counted as lost.
  static constexpr std::size_t kMaximumTold = 4096;
  /// How long rows stay in a sink's buffer at most.
  static constexpr std::chrono::milliseconds kFlush{250};

  /// Starts the thread. `signals` describes the ring's columns, in their order.
  /// The ring must outlive the recorder.
  TraceRecorder(TraceRing& ring, std::vector<TraceSignal> signals,
                std::vector<std::unique_ptr<TraceSink>> sinks, EventSource events = {});
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;
  ~TraceRecorder();  ///< stops

  /// Writes out everything that is in the ring, ends the sinks and joins the thread. To be called after the
  /// last `push`; a second call does nothing. The thread that made the recorder.
  void stop();

  /// Gives an event of the bridge to the sinks, in the order of time among those of the cycle; how many
  /// events are lost it is told here. Nothing after `stop`. Any thread but the cycle's.
  void tell(TraceEvent event);

  /// What is missing from the trace so far: for each sink that failed, and for the ring when it overflowed, a
  /// text such as "trace incomplete: 12 rows lost in run.csv: No space left on device". Empty if nothing is
  /// missing. Any thread but the cycle's.
  std::vector<std::string> losses() const;
  /// Whether rows are missing from a sink with this name, or from the ring and so from all of them. Any
  /// thread but the cycle's.
  bool has_lost(std::string_view name) const;
  /// What a sink holds up that is being written to at this moment, as a text of the same kind; empty: none.
  /// For one that does not come back. Any thread but the cycle's, while the recorder lives.
  std::string held_up() const;

 private:
  struct Loss {
    std::string name;
    std::uint64_t rows;
    std::string reason;
  };

  void record();
  template <class Call>
  void guarded(TraceSink& sink, std::uint64_t rows, Call call) noexcept;
  void begin_sinks() noexcept;
  bool drain() noexcept;
  void take_told() noexcept;
  std::uint64_t lost_events() const noexcept;
  void give_queued(const Event& event) noexcept;
  void give_event(const Event& event) noexcept;
  void give_event(const TraceEvent& event) noexcept;
  void give_told(std::int64_t until) noexcept;
  void flush_sinks() noexcept;
  void end_sinks() noexcept;
  void report() noexcept;

  TraceRing& ring_;
  const std::vector<TraceSignal> signals_;
  const std::vector<std::unique_ptr<TraceSink>> sinks_;
  const EventSource events_;
  std::atomic<const TraceSink*> busy_{nullptr};  // sink that has been called and has not come back
  bool finishing_ = false;                       // no more rows will follow
  std::int64_t given_t_ = 0;                     // of the last row
  std::uint64_t given_tick_ = 0;
  std::vector<TraceEvent> waiting_;  // events of the bridge, for the row of their tick

  mutable std::mutex mutex_;  // guards the four below; the cycle never takes it
  std::condition_variable wake_;
  bool stop_ = false;
  std::vector<Loss> losses_;
  std::vector<TraceEvent> told_;
  std::atomic<std::uint64_t> lost_told_{0};

  std::thread thread_;
};

}  // namespace lockstep
