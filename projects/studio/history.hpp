/// What has happened in a run, for pages that come later: events, alarms that stand, jobs as bars.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/traces/event.hpp"
#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// What an instance of a block has had an object do.
struct StudioJob {
  std::string instance;
  std::string type;        ///< of the block
  std::string object;      ///< that carries it out; empty: none is known
  std::int64_t begin = 0;  ///< [ns]
  std::int64_t end = -1;   ///< [ns]; -1: it goes on
  std::string ended;       ///< how, such as "job aborted"; empty: it goes on
  std::string text;        ///< why, where that is known
};

/// Made of events as they come. Not for several threads at once.
class StudioHistory {
 public:
  static constexpr std::size_t kEvents = 2000;  ///< the newest
  static constexpr std::size_t kJobs = 2000;    ///< the same, but for those that go on

  void add(TraceEvent event);

  const std::deque<TraceEvent>& events() const noexcept { return events_; }
  /// Alarms that nobody has acknowledged, oldest first.
  const std::vector<TraceEvent>& pending() const noexcept { return pending_; }
  const std::deque<StudioJob>& jobs() const noexcept { return jobs_; }

 private:
  void end_job(const TraceEvent& event);

  std::deque<TraceEvent> events_;
  std::vector<TraceEvent> pending_;
  std::deque<StudioJob> jobs_;
};

/// Takes events on the recorder's thread for the server's.
class StudioInbox {
 public:
  static constexpr std::size_t kWaiting = 10'000;

  /// Thread: any.
  void put(const TraceEvent& event);
  std::vector<TraceEvent> take();
  std::uint64_t lost() const;

 private:
  mutable std::mutex mutex_;
  std::vector<TraceEvent> events_;
  std::uint64_t lost_ = 0;
};

/// Gives the recorder's events to an inbox; rows are none of its business.
class StudioSink final : public TraceSink {
 public:
  explicit StudioSink(std::shared_ptr<StudioInbox> inbox) : inbox_(std::move(inbox)) {}

  void begin(std::span<const TraceSignal> /*signals*/) override {}
  void row(const TraceRow& /*row*/) override {}
  void event(const TraceEvent& event) override { inbox_->put(event); }
  void flush() override {}
  void end() override {}
  std::string_view name() const noexcept override { return "the studio"; }

 private:
  std::shared_ptr<StudioInbox> inbox_;
};

}  // namespace lockstep
