/// The studio of one run: what its pages may ask, and what they are told.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/feed.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/pages.hpp"
#include "projects/studio/readings.hpp"
#include "projects/studio/shots.hpp"
#include "projects/studio/tree.hpp"
#include "projects/studio/triggers.hpp"

namespace lockstep {

/// Answers by the declarations of the project and by what has come from the cycle; it reads and never writes.
/// Thread: the server's, but for what is said to be another's.
class StudioSession final : public StudioHandler {
 public:
  /// Before the run; `project` outlives this. @param epoch wall clock of t = 0 [µs since 1970]; 0: virtual
  StudioSession(const Project& project, std::int64_t epoch);

  /// The crossing for `Controller::tap`.
  SignalTap& tap() noexcept { return feed_.tap(); }
  /// What gives it the events of the run. Before the run.
  std::unique_ptr<TraceSink> sink() const { return std::make_unique<StudioSink>(inbox_); }

  void answer(const StudioRequest& request, Done done) override;
  void opened(StudioClient& client) override { pages_.open(client); }
  void text(StudioClient& client, std::string_view text) override;
  void closed(StudioClient& client) noexcept override;
  void look() override;
  void ended() noexcept override { readings_.end(); }

 private:
  using Clock = std::chrono::steady_clock;

  void obey(StudioClient& client, const StudioMessage& message);
  void hello(StudioClient& client, const StudioMessage& message);
  StudioAnswer answer_get(const StudioRequest& request);
  StudioAnswer about() const;
  StudioAnswer project_answer() const;
  StudioAnswer signals(const StudioRequest& request);
  StudioAnswer events() const;
  StudioAnswer jobs() const;
  StudioAnswer traces() const;
  StudioAnswer part_of_trace(const StudioRequest& request) const;
  void tell_events();
  void tell_shots();
  void tell_status(Clock::time_point now);
  void want();

  const Project& project_;
  const StudioUnits units_;
  const std::int64_t epoch_;
  const std::string run_;  // number of this run, by chance
  std::vector<StudioSignal> all_;
  std::shared_ptr<StudioInbox> inbox_ = std::make_shared<StudioInbox>();
  StudioHistory history_;
  StudioFeed feed_;
  StudioPages pages_;
  StudioReadings readings_;
  StudioShots shots_;
  StudioTriggers triggers_;
  bool wants_changed_ = false;
  Clock::time_point next_status_{};
};

}  // namespace lockstep
