/// Events in words, as messages and LCM show them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/controller.hpp"

namespace lockstep {

/// An event with all that is known of it.
struct TraceEvent {
  EventKind kind{};
  std::int64_t t = 0;      ///< [ns] since the start of the run
  std::uint64_t tick = 0;  ///< number of the servo tick
  std::uint64_t lost = 0;  ///< events that could not be kept since the start of the run
  std::string source;      ///< name of the object or instance; empty: the run
  std::string type;        ///< such as TO_SynchronousAxis or MC_GearIn
  int number = 0;          ///< of the alarm; ErrorID of a job that has failed
  std::string text;        ///< meaning of the number
  int reaction = 0;        ///< of an alarm
  std::string reaction_text;
};

/// Short name of a kind of event: "alarm", "acknowledged", "job started", …
std::string_view event_kind_text(EventKind kind) noexcept;

/// Knows the names of a controller's objects and instances, which outlive it. Thread: one, once it is made.
class EventTexts {
 public:
  EventTexts() = default;
  explicit EventTexts(const Controller& controller);
  TraceEvent of(const Event& event, std::uint64_t lost) const;

 private:
  struct Name {
    std::string name;
    std::string type;
    TechnologyObject* object;
  };
  std::vector<Name> objects_, instances_;
};

}  // namespace lockstep
