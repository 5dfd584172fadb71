/// The triggers of all pages, judged on every row of the run, whether a page looks or not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>

#include "hmi_bridge/studio/handler.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/feed.hpp"
#include "projects/studio/shots.hpp"
#include "projects/studio/trigger.hpp"

namespace lockstep {

struct StudioMessage;

/// A page has one trigger at most. Thread: the server's.
class StudioTriggers {
 public:
  static constexpr std::int64_t kLongest = 50'000'000'000;  ///< before and after the occasion together [ns]

  StudioTriggers(const Project& project, StudioFeed& feed, StudioShots& shots)
      : project_(project), feed_(feed), shots_(shots) {}

  /// A message `trigger`; answers it. @throws studio_api::BadRequest
  void obey(StudioClient& client, const StudioMessage& message);
  /// @return whether the page had a trigger
  bool forget(StudioClient& client) noexcept { return armed_.erase(&client) != 0; }
  void event(const TraceEvent& event);

  /// Judges the rows that have come. Calls `caught` with each new shot.
  template <class Caught>
  void look(Caught caught) {
    for (auto armed = armed_.begin(); armed != armed_.end();) {
      judge_rows(armed->second);
      come_by_itself(armed->second);
      if (const StudioShot* shot = shot_of(armed->second)) caught(*shot);
      armed = armed->second.is_over ? armed_.erase(armed) : std::next(armed);
    }
  }
  /// Calls `add` with each signal that is wanted.
  template <class Add>
  void wanted(Add add) const {
    for (const auto& [client, armed] : armed_) {
      if (armed.signal) add(*armed.signal);
      if (armed.second) add(armed.second->signal);
    }
  }

 private:
  struct Second {
    StudioTrigger trigger;
    NamedSignal signal;
    std::size_t index;
  };
  struct Armed {
    StudioTrigger trigger;
    std::string reason{};
    std::optional<NamedSignal> signal{};
    std::size_t index = 0;                // of the signal in the store
    std::optional<Second> second{};       // that has to hold as well
    std::int64_t before = 0, after = 0;   // [ns]
    bool is_repeated = false;             // it waits again after a shot
    std::int64_t patience = 0;            // after which it comes by itself [ns]; 0: never
    std::optional<std::int64_t> until{};  // when it does [ns]
    bool is_by_itself = false;
    std::uint64_t row = 0;                   // that is judged next
    std::optional<std::int64_t> occasion{};  // [ns]
    bool is_over = false;
  };

  Armed armed_by(const StudioMessage& message) const;
  NamedSignal signal_of(const std::string& path) const;
  void judge_rows(Armed& armed) const;
  void come_by_itself(Armed& armed) const;
  const StudioShot* shot_of(Armed& armed);

  const Project& project_;
  StudioFeed& feed_;
  StudioShots& shots_;
  std::map<StudioClient*, Armed> armed_;
};

}  // namespace lockstep
