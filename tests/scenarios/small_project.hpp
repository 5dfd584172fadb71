/// Small projects of a test, as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/scenarios/csv_table.hpp"

namespace lockstep::test {

using Json = nlohmann::ordered_json;

/// A project with a clock and nothing else.
inline Json empty_project(const std::string& servo_cycle = "1ms", int ratio = 1) {
  return Json{{"lockstep", 1},
              {"name", "small"},
              {"clock", {{"servo_cycle", servo_cycle}, {"interpolator_ratio", ratio}}},
              {"technology_objects", Json::object()},
              {"tags", Json::object()},
              {"programs", Json::array()},
              {"stimuli", Json::array()}};
}

/// A virtual TO_SynchronousAxis; `leading` are the names of its leading values.
inline Json virtual_axis(const std::vector<std::string>& leading = {}) {
  Json axis{{"type", "TO_SynchronousAxis"}, {"config", {{"VirtualAxis", {{"Mode", 1}}}}}};
  for (const std::string& name : leading) axis["leading_values"].push_back({{"to", name}});
  return axis;
}

inline Json call(const std::string& block, const std::string& name, Json pins) {
  return Json{{"fb", block}, {"name", name}, {"in", std::move(pins)}};
}

inline Json assignment(const std::string& place, Json value) {
  return Json{{"set", place}, {"to", std::move(value)}};
}

inline Json stimulus(const std::string& at, const std::string& tag, Json value) {
  return Json{{"at", at}, {"set", {{tag, std::move(value)}}}};
}

/// An example project, for a test to change.
inline Json example_json(const std::string& name) {
  return Json::parse(content(example(name)));
}

/// Simulates a project given as JSON; `signals` are recorded.
inline CsvTable simulate(const Json& project, const std::string& duration, const std::string& signals) {
  const Directory directory;
  return simulate(directory.write("project.json", project.dump(1)), duration, {"--signals", signals});
}

}  // namespace lockstep::test
