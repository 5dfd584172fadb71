/// The studio of one run: what its pages may ask, and what they are told.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/desk_folder.hpp"
#include "projects/studio/feed.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/pages.hpp"
#include "projects/studio/panels.hpp"
#include "projects/studio/powers.hpp"
#include "projects/studio/project_files.hpp"
#include "projects/studio/project_text.hpp"
#include "projects/studio/readings.hpp"
#include "projects/studio/shots.hpp"
#include "projects/studio/tap_cost.hpp"
#include "projects/studio/tree.hpp"
#include "projects/studio/triggers.hpp"
#include "projects/studio/writes.hpp"

namespace lockstep {

/// Answers by the declarations of the project and by what has come from the cycle; what pages may do besides
/// is given to it. Thread: the server's, but for what is said to be another's.
class StudioSession final : public StudioHandler {
 public:
  /// Before the run; `project` outlives this. @param epoch wall clock of t = 0 [µs since 1970]; 0: virtual
  /// @param history of the run that is kept [ns]
  StudioSession(const Project& project, std::int64_t epoch, std::int64_t history = 60'000'000'000);

  /// What pages may do besides looking. Before the first request; without it they only look.
  void empower(StudioPowers powers);
  /// What a body of `POST /api/write` writes here. Before the run, or where nothing of it goes on.
  std::vector<ChosenWrite> chosen_writes(const std::string& body) const { return writes_.chosen(body); }
  /// The signals that are recorded now, and has some recorded until pages have said which they want. Before
  /// the first request of a page.
  std::vector<std::string> recorded() const;
  void record(const std::vector<std::string>& paths);
  /// The crossing for `Controller::tap`.
  SignalTap& tap() noexcept { return feed_.tap(); }
  /// What gives it the events of the run. Before the run.
  std::unique_ptr<TraceSink> sink() const { return std::make_unique<StudioSink>(inbox_); }

  void answer(const StudioRequest& request, Done done) override;
  void opened(StudioClient& client) override { pages_.open(client); }
  void text(StudioClient& client, std::string_view text) override;
  void closed(StudioClient& client) noexcept override;
  void look() override;
  bool takes_uploads() const noexcept override {
    return powers_.files != nullptr && powers_.why_no_files.empty();
  }
  void ended() noexcept override {
    readings_.end();
    writes_.end();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void obey(StudioClient& client, const StudioMessage& message);
  void hello(StudioClient& client, const StudioMessage& message);
  StudioAnswer answer_post(const StudioRequest& request);
  StudioAnswer answer_get(const StudioRequest& request);
  StudioAnswer answer_project(const StudioRequest& request) const;
  StudioAnswer about() const;
  StudioAnswer signals(const StudioRequest& request);
  StudioAnswer events() const;
  StudioAnswer jobs() const;
  StudioAnswer traces() const;
  StudioAnswer part_of_trace(const StudioRequest& request) const;
  const StudioHistory& history_of(std::string_view id) const;
  StudioAnswer events_of(std::string_view id) const;
  StudioAnswer compare(const StudioRequest& request) const;
  StudioAnswer take_trace(const StudioRequest& request);
  StudioAnswer remove_trace(const StudioRequest& request);
  StudioAnswer derive(const StudioRequest& request);
  StudioAnswer change_simulation(const StudioRequest& request);
  studio_api::Json cams() const;
  StudioAnswer cam_named(const StudioRequest& request, const std::string& name) const;
  StudioAnswer answer_files(const StudioRequest& request);
  void tell_written(const StudioRequest& request, std::string_view name, const StudioAnswer& answer) const;
  bool read_at_once(const StudioRequest& request, const Done& done);
  const TraceStore* find_trace(std::string_view id) const;
  void tell_files();
  void tell_events();
  void tell_shots();
  void tell_panels(Clock::time_point now);
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
  StudioPowers powers_;
  StudioWrites writes_;
  StudioPanels panels_;
  StudioProjectText text_;
  StudioProjectFiles project_files_;
  DeskFolder trace_folder_;
  std::vector<NamedSignal> recorded_at_first_;  // until a page subscribes
  TapCost tap_cost_;
  bool wants_changed_ = false;
  Clock::time_point next_status_{};
};

}  // namespace lockstep
