/// Benchmarks of single parts: profiles, the gear function, expressions, loading a project.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lockstep::bench {

/// Some work on a part that can be repeated.
struct Part {
  std::string name;
  std::function<void(int calls)> work;
  int calls = 1000;  ///< so many make a run that is long enough
};

/// @param quick only as much as shows that it works
std::vector<Part> parts(bool quick);
/// Of leading values that cross to other controllers.
std::vector<Part> telegram_parts();

}  // namespace lockstep::bench
