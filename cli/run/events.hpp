/// lockstep run: alarms, and jobs that fail, as messages.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep::cli {

/// On a terminal, takes the line of live values away that stands where a message goes.
void clear_line() noexcept;

/// What a run tells of events on standard error: alarms and their acknowledgement, jobs that fail, shifts
/// that are aborted, lines and errors of an object's own programs. What comes again soon, but for those
/// lines, is counted and told as a number, so that a program that asks again in every cycle fills no
/// terminal. Thread: the recorder's; `rest` when that has ended.
class EventMessages {
 public:
  /// The message of an event, of one or more whole lines; empty: it is not told, or not now.
  std::string of(const TraceEvent& event);
  /// What has been counted and not been told yet; empty: nothing.
  std::string rest();

 private:
  using Key = std::tuple<EventKind, std::string, int>;
  struct Seen {
    std::int64_t since = 0;  // [ns] t of the first message of the window
    int told = 0;            // messages of the window
    std::uint64_t more = 0;  // not told since
    std::string what;        // of one of them, for their number
  };
  bool may_tell(const TraceEvent& event);

  std::map<Key, Seen> seen_;
  std::string folded_;        // numbers of windows that have ended
  std::uint64_t more_ = 0;    // events of more kinds than are kept
  std::int64_t second_ = -1;  // [s] of t, of the last message
  int in_second_ = 0;         // messages told in it
};

}  // namespace lockstep::cli
