/// Values, signals, events and jobs as JSON.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/traces/columns.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/derived.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/shots.hpp"
#include "projects/studio/units.hpp"

namespace lockstep::studio_api {

/// A number, or a text for what JSON has no number for: "nan", "inf", "-inf".
Json number_json(double number);
/// What may exceed 2^53 is a text of decimal digits.
Json value_json(Value value, Type type);
Json event_json(const TraceEvent& event);
Json job_json(const StudioJob& job);
Json shot_json(const StudioShot& shot);

/// The derived signal that an expression over paths of a project makes; nullptr: `problem` says why there is
/// none.
std::unique_ptr<StudioDerived> derived_at(const Project& project, std::string_view text,
                                          std::string& problem);
/// The signal at a path, or why there is none; of a derived one nothing but its type.
std::optional<NamedSignal> signal_at(const Project& project, const std::string& path, std::string& problem);

/// What is read at a path: a signal, or those that hold the characters of a STRING.
struct ReadPlace {
  std::string path;
  std::vector<NamedSignal> signals;
  std::size_t capacity = 0;  ///< characters of the STRING; 0: it is none
};
/// @return none: `problem` says why there is no such place
std::optional<ReadPlace> read_place_at(const Project& project, const std::string& path, std::string& problem);
/// What stands there, by the values of its signals.
Json reading_json(const ReadPlace& place, std::span<const Value> values, const StudioUnits& units);

}  // namespace lockstep::studio_api
