/// Values of one instant that have been asked for.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/api_values.hpp"
#include "projects/studio/feed.hpp"

namespace lockstep {

/// Each is answered by the first row that has all of it. Thread: the server's.
class StudioReadings {
 public:
  static constexpr std::size_t kRead = 1000;  ///< paths that are read at once
  using Clock = std::chrono::steady_clock;
  using Done = StudioHandler::Done;

  StudioReadings(const Project& project, const StudioUnits& units, StudioFeed& feed)
      : project_(project), units_(units), feed_(feed) {}

  /// `POST /api/read`. @throws studio_api::BadRequest
  void read(const StudioRequest& request, Done done);
  /// Forgets what has not been read lately. @return whether anything is
  bool forget(Clock::time_point now);
  /// Answers what can be answered, and what has waited too long.
  void answer(Clock::time_point now);
  void end() noexcept { waiting_.clear(); }

  /// Calls `add` with each signal that is wanted, as one that has just been read perhaps is once more.
  template <class Add>
  void wanted(Add add) const {
    for (const auto& [path, kept] : kept_) add(kept.signal);
  }

 private:
  struct Reading {
    std::vector<studio_api::ReadPlace> places;
    studio_api::Json errors{};         // of what cannot be read, where the rest is wanted all the same
    std::vector<std::size_t> indices;  // in the store, of the signals of all places
    std::uint64_t from;                // no older row answers
    Clock::time_point until;
    Done done;
  };
  struct Kept {
    NamedSignal signal;
    Clock::time_point until;
  };

  bool is_there(const Reading& reading) const noexcept;
  StudioAnswer answer_of(const Reading& reading) const;

  const Project& project_;
  const StudioUnits& units_;
  StudioFeed& feed_;
  std::deque<Reading> waiting_;
  std::map<std::string, Kept> kept_;  // by path
};

}  // namespace lockstep
