/// The example project with something changed, and problems as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "example_project.hpp"
#include "projects/json/problem.hpp"

namespace lockstep {

using Json = nlohmann::ordered_json;

/// Places and texts alone.
inline std::string lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems)
    text += to_string("FILE", {.place = problem.place, .text = problem.text}) + "\n";
  return text;
}

/// The example project with one place replaced by some JSON; an empty text removes the place.
inline std::string changed(const std::string& pointer, const std::string& value) {
  Json project = Json::parse(kExampleProject);
  if (value.empty()) {
    const Json::json_pointer place(pointer);
    if (project.at(place.parent_pointer()).is_array())
      project.at(place.parent_pointer()).erase(std::stoul(place.back()));
    else
      project.at(place.parent_pointer()).erase(place.back());
  } else {
    project[Json::json_pointer(pointer)] = Json::parse(value);
  }
  return project.dump();
}

}  // namespace lockstep
