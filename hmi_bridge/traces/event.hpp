/// Events in words, as messages and LCM show them.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
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
  std::int64_t utime = 0;  ///< wall clock [µs] since 1970-01-01 UTC; 0 in virtual time
  std::string object;      ///< of a job: the axis, or other object, that carries it out

  // Of an alarm, where it is known.
  std::string cause;       ///< what has happened, in general
  std::string remedy;      ///< what is to be done about it
  std::string address;     ///< which of several causes, limits, sensors, inputs or objects is meant
  int cause_number = 0;    ///< value of AlarmCause
  int sensor = 0;          ///< number of the sensor, from 1
  std::string value_name;  ///< what was measured; empty: nothing
  std::string limit_name;  ///< what it was held against; empty: nothing
  std::string unit;        ///< of both
  double value = std::numeric_limits<double>::quiet_NaN();
  double limit = std::numeric_limits<double>::quiet_NaN();

  bool has_value() const noexcept { return !value_name.empty() && value == value; }
  bool has_limit() const noexcept { return !limit_name.empty() && limit == limit; }
};

/// What is known of an event besides, a line each: the values and the address, the cause, the remedy; none
/// where nothing is.
std::vector<std::string> detail_lines(const TraceEvent& event);

/// Short name of a kind of event: "alarm", "acknowledged", "job started", …
std::string_view event_kind_text(EventKind kind) noexcept;

/// Knows the names of a controller's objects and instances, which outlive it. Thread: one, once it is made.
class EventTexts {
 public:
  EventTexts() = default;
  /// @param epoch wall clock of t = 0 [µs since 1970-01-01 UTC]; 0: virtual time
  explicit EventTexts(const Controller& controller, std::int64_t epoch = 0);
  TraceEvent of(const Event& event, std::uint64_t lost) const;

 private:
  struct Name {
    std::string name;
    std::string type;
    TechnologyObject* object;
  };
  /// What may be meant by an alarm of an object.
  struct Inputs {
    std::string limits[2];  // tags of the hardware limit switches: negative, positive
    std::string units[5];   // by Unit, from none to jerk
  };
  void fill(TraceEvent& told, const Event& event) const;
  std::string address_of(const Event& event) const;
  std::string aborted_text(const Event& event) const;
  const Name* instance_with(const Job* job) const;

  std::int64_t epoch_ = 0;
  std::vector<Name> objects_, instances_;
  std::vector<Inputs> inputs_;                               // of the objects
  std::vector<std::pair<const void*, std::size_t>> blocks_;  // of the instances, by address
};

}  // namespace lockstep
