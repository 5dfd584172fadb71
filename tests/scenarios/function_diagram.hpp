/// A published function diagram as a project: what it states is observed in the trace, in its order.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test {

inline Json diagrams() {
  std::ifstream file(LOCKSTEP_TEST_DATA "/scenario_function_diagrams.json");
  return Json::parse(file);
}

inline Json diagram(const std::string& id) {
  for (const Json& candidate : diagrams())
    if (candidate["id"] == id) return candidate;
  ADD_FAILURE() << "no diagram " << id;
  return {};
}

inline void enable(std::vector<Json>& calls, const std::string& axis) {
  calls.push_back(call("MC_Power", "power_" + axis, {{"Axis", axis}, {"Enable", true}}));
  calls.push_back(
      call("MC_Home", "home_" + axis, {{"Axis", axis}, {"Execute", "power_" + axis + ".Status"}}));
}

inline void run(std::vector<Json>& calls, const std::string& axis, double velocity) {
  calls.push_back(call("MC_MoveVelocity", "run_" + axis,
                       {{"Axis", axis}, {"Execute", "home_" + axis + ".Done"}, {"Velocity", velocity}}));
}

inline Json with_program(Json project, const std::vector<Json>& calls) {
  project["programs"].push_back({{"name", "Main"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", calls}});
  return project;
}

/// A value of a diagram as the trace shows it; axes stand for their numbers.
inline double number_of(const Json& value, const Json& project) {
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  if (value.is_number()) return value.get<double>();
  double number = 0.0;
  for (const auto& [name, object] : project["technology_objects"].items()) {
    ++number;
    if (name == value.get<std::string>()) return number;
  }
  ADD_FAILURE() << "no axis " << value;
  return -1.0;
}

/// The signals that the diagram observes, and positions and velocities of the axes.
inline std::string signals_of(const Json& diagram, const Json& project) {
  std::string names;
  std::vector<std::string> known;
  const auto add = [&](const std::string& name) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    known.push_back(name);
    names += (names.empty() ? "" : ",") + name;
  };
  for (const Json& step : diagram["steps"])
    for (const auto& [signal, value] : step["observed"].items()) add(signal);
  for (const auto& [axis, object] : project["technology_objects"].items()) {
    if (object.value("type", "").starts_with("TO_Cam")) continue;
    add(axis + ".Position");
    add(axis + ".Velocity");
  }
  return names;
}

inline bool holds(const CsvTable& table, std::size_t row, const Json& observed, const Json& project) {
  for (const auto& [signal, value] : observed.items())
    if (table[signal][row] != number_of(value, project)) return false;
  return true;
}

/// The rows in which the steps of a diagram begin; fewer if one is not observed.
inline std::vector<std::size_t> rows_of_steps(const Json& diagram, const CsvTable& table,
                                              const Json& project) {
  std::vector<std::size_t> rows;
  std::size_t row = 0;
  for (const Json& step : diagram["steps"]) {
    while (row < table.rows && !holds(table, row, step["observed"], project)) ++row;
    if (row == table.rows) {
      ADD_FAILURE() << diagram["id"] << ": not observed after the steps before it: " << step.dump();
      return rows;
    }
    rows.push_back(row);
  }
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_LT(rows[i - 1], rows[i]) << "steps are one after another";
  return rows;
}

}  // namespace lockstep::test
