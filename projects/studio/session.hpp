/// The studio of one run: what its pages may ask, and what they are told.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "hmi_bridge/studio/stream.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/feed.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/tree.hpp"

namespace lockstep {

struct StudioMessage;

/// Answers by the declarations of the project and by what has come from the cycle; it reads and never writes.
/// Thread: the server's, but for what is said to be another's.
class StudioSession final : public StudioHandler {
 public:
  static constexpr std::size_t kSubscribed = 512;  ///< paths of a subscription
  static constexpr std::size_t kRead = 1000;       ///< paths that are read at once
  static constexpr std::size_t kPoints = 20'000;   ///< of a window

  /// Before the run; `project` outlives this. @param epoch wall clock of t = 0 [µs since 1970]; 0: virtual
  StudioSession(const Project& project, std::int64_t epoch);

  /// The crossing for `Controller::tap`.
  SignalTap& tap() noexcept { return feed_.tap(); }
  /// What gives it the events of the run. Before the run.
  std::unique_ptr<TraceSink> sink() const { return std::make_unique<StudioSink>(inbox_); }

  void answer(const StudioRequest& request, Done done) override;
  void opened(StudioClient& client) override;
  void text(StudioClient& client, std::string_view text) override;
  void closed(StudioClient& client) noexcept override;
  void look() override;
  void ended() noexcept override { readings_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Page {
    StudioStream stream;
    std::map<std::uint32_t, std::vector<NamedSignal>> subscriptions;
    bool is_known = false;  ///< it has said hello
  };
  struct Reading {
    std::vector<NamedSignal> signals;
    std::vector<std::size_t> indices;
    std::uint64_t from;  ///< no older row answers
    Clock::time_point until;
    Done done;
  };

  /// A signal that has been read lately, and so perhaps is once more.
  struct Kept {
    NamedSignal signal;
    Clock::time_point until;
  };

  void obey(StudioClient& client, const StudioMessage& message);
  void hello(StudioClient& client, Page& page, const StudioMessage& message);
  void subscribe(StudioClient& client, Page& page, const StudioMessage& message);
  void unsubscribe(StudioClient& client, Page& page, const StudioMessage& message);
  void check_sum(std::size_t more, const Page& page, std::uint32_t id) const;
  StudioAnswer answer_get(const StudioRequest& request);
  StudioAnswer about() const;
  StudioAnswer signals(const StudioRequest& request);
  StudioAnswer traces() const;
  StudioAnswer part_of_trace(const StudioRequest& request);
  void read(const StudioRequest& request, Done done);
  void answer_readings();
  void tell_events();
  void tell_status();
  void send_rows();
  void want();

  const Project& project_;
  const StudioUnits units_;
  const std::int64_t epoch_;
  const std::string run_;  // number of this run, by chance
  std::vector<StudioSignal> all_;
  std::shared_ptr<StudioInbox> inbox_ = std::make_shared<StudioInbox>();
  StudioHistory history_;
  StudioFeed feed_;
  std::map<StudioClient*, Page> pages_;
  std::deque<Reading> readings_;
  bool wants_changed_ = false;
  std::map<std::string, Kept> kept_;  // by path
  Clock::time_point next_status_{};
};

}  // namespace lockstep
