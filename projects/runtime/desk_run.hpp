/// A project in simulation that a studio drives: it stands still until somebody runs it, at the pace that is
/// asked for.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/shared_desk.hpp"
#include "projects/loader/simulation.hpp"
#include "projects/studio/session.hpp"
#include "scheduler/chosen_writes.hpp"

namespace lockstep {

/// How a desk is set up.
struct DeskOptions {
  std::string file{};               ///< of the project; empty: there is none, only traces
  std::string folder{};             ///< in or below which pages name traces by path; empty: nowhere
  std::vector<std::string> cams{};  ///< paths of cam files beside it
  bool read_only = false;  ///< pages only look; they may run the simulation no more than write into it
  std::function<std::optional<std::string>(const std::string&)> describe{};  ///< see StudioPowers
};

/// Writes of pages that a run has had, in their order.
struct DeskJournal {
  struct Entry {
    std::int64_t tick;  ///< at the start of which they were applied
    std::string body;   ///< of `POST /api/write`
  };
  std::vector<Entry> entries{};
  bool has_commands = false;  ///< axes were commanded as well, which is not repeated
};

/// One run of it, from t = 0. Its thread ticks; what pages ask for is on the server's, unless said otherwise.
class DeskRun final : public StudioSimulation {
 public:
  /// Asked for by a page, and done by whoever owns the run: another one in its place, which goes on to a time
  /// [ns] with the same writes; without a time it begins anew, without any. @throws as DeskRun; the run that
  /// is there stays then
  using Restart = std::function<void(std::optional<std::int64_t> t)>;

  /// @param files outlives this  @throws InvalidProject, UnreadableFile
  DeskRun(const DeskOptions& options, StudioTraceFiles& files, Restart restart);
  ~DeskRun() override;
  DeskRun(const DeskRun&) = delete;
  DeskRun& operator=(const DeskRun&) = delete;

  StudioSession& session() noexcept { return *session_; }
  /// Writes before a time. Thread: the server's.
  DeskJournal journal_before(std::int64_t t) const;
  /// Goes on to a time as fast as it can, with these writes at their ticks, and records some signals on the
  /// path. Before anything else is asked of it.
  void repeat(std::int64_t t, DeskJournal journal, const std::vector<std::string>& recorded);
  studio_api::Json state() const override;
  studio_api::Json obey(const studio_api::Json& request) override;
  bool while_paused(const std::function<void(std::int64_t tick)>& act) override;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kSlowest = 0.01, kFastest = 1000.0;

  void give_powers(const DeskOptions& options, StudioTraceFiles& files);
  void make_desk();
  void run() noexcept;
  void tick();
  bool is_due() const;
  void set_pace(double speed);
  void run_to(std::int64_t t);
  std::int64_t now() const { return project().controller->now(); }
  Project& project() const { return simulation_->project(); }

  std::unique_ptr<Simulation> simulation_;
  const Restart restart_;
  std::vector<Problem> warnings_;
  EventQueue events_;
  EventTexts texts_;
  std::unique_ptr<ProcessImage> image_;
  std::unique_ptr<SharedDesk> desk_;
  std::unique_ptr<StudioSession> session_;
  std::unique_ptr<TraceSink> sink_;

  mutable std::mutex mutex_;  // guards the project and what follows; held for a tick at most
  std::condition_variable wake_;
  bool runs_ = false;
  double speed_ = 1.0;       // 0: as fast as it can
  std::int64_t until_ = 0;   // [ns] where it stops by itself, if it is to
  bool stops_ = false;       // it is to
  std::int64_t from_t_ = 0;  // of the pace
  Clock::time_point from_{};
  bool end_ = false;
  DeskJournal journal_;
  std::vector<std::pair<std::int64_t, std::vector<ChosenWrite>>> repeated_;  // by their ticks
  std::size_t next_repeated_ = 0;
  ChosenWrites repeating_;
  std::thread thread_;
};

/// What stands behind the server of `lockstep studio`. Thread: the server's.
class DeskHandler final : public StudioHandler {
 public:
  /// @throws as DeskRun
  explicit DeskHandler(DeskOptions options);

  /// Begins to read a trace. Before the server starts. @return false: there are too many
  bool add_trace(const std::string& path);
  bool has_project() const noexcept { return !options_.file.empty(); }

  void answer(const StudioRequest& request, Done done) override {
    run_->session().answer(request, std::move(done));
  }
  void opened(StudioClient& client) override;
  void text(StudioClient& client, std::string_view message) override {
    run_->session().text(client, message);
  }
  void closed(StudioClient& client) noexcept override;
  void look() override;
  bool takes_uploads() const noexcept override { return run_->session().takes_uploads(); }
  void ended() noexcept override { run_->session().ended(); }

 private:
  void restart();
  void ask_for_another(std::optional<std::int64_t> t);

  const DeskOptions options_;
  StudioTraceFiles files_;
  std::vector<StudioClient*> clients_;
  std::unique_ptr<DeskRun> next_;         // it takes the place of the one that is there at the next look
  std::optional<std::int64_t> wanted_t_;  // to which it goes then
  std::unique_ptr<DeskRun> run_;
};

}  // namespace lockstep
