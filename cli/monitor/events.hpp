/// Jobs and alarms, as they are told on the channels of events.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "lockstep/event_detail_t.hpp"
#include "lockstep/event_t.hpp"

namespace lockstep::cli {

/// A line of a list: what has happened when.
struct ToldEvent {
  std::string channel;
  event_t event;
  std::vector<std::string> details;  ///< what is known besides, a line each
};

/// What events say of one network. Anything may come: the lists have an end.
class HeardEvents {
 public:
  static constexpr std::size_t kMaximumAlarms = 200;
  static constexpr std::size_t kMaximumJobs = 500;
  static constexpr std::size_t kMaximumAnswers = 20;

  void accept(const std::string& channel, const event_t& event);
  /// What is known besides of an event that has come already.
  void accept(const std::string& channel, const event_detail_t& detail);

  /// Alarms and acknowledgements, newest first.
  const std::deque<ToldEvent>& alarms() const noexcept { return alarms_; }
  /// Alarms that have not been acknowledged since.
  std::size_t pending() const;
  /// Jobs that run, by channel and instance, as far as their start was heard.
  const std::map<std::pair<std::string, std::string>, event_t>& running() const noexcept { return running_; }
  /// Jobs that have ended lately, newest first.
  const std::deque<ToldEvent>& ended() const noexcept { return ended_; }
  /// What has become of commands, newest first.
  const std::deque<ToldEvent>& answers() const noexcept { return answers_; }
  std::int64_t overruns() const noexcept { return overruns_; }

 private:
  static void put(std::deque<ToldEvent>& list, ToldEvent told, std::size_t maximum);

  std::deque<ToldEvent> alarms_, ended_, answers_;
  std::map<std::pair<std::string, std::string>, event_t> running_;
  std::map<std::string, std::int64_t> times_;  // of the last event by channel, to see that a run is new
  std::int64_t overruns_ = 0;
};

}  // namespace lockstep::cli
