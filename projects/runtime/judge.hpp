/// Whether a simulated run came to what its project expects.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hmi_bridge/traces/event.hpp"
#include "projects/loader/project.hpp"

namespace lockstep {

struct Judgement {
  const Expectation* expectation;
  std::int64_t at = 0;  ///< time of the tick behind which it was looked at [ns]
  bool holds = false;
  std::string actual{};  ///< values behind that tick, such as "FALSE (step = 3, done = FALSE)"
};

/// Simulates a project that has just been loaded for its duration, and looks at its expectations. The
/// judgements are in their order and point into the project. Allocates; not for the thread of a cycle.
/// @param tell is given each alarm and each event of a job, as they come; empty: nobody asks
std::vector<Judgement> judge(Project& project, const std::function<void(const TraceEvent&)>& tell = {});

/// What an expectation is called: its text, or what is written.
std::string title_of(const Expectation& expectation);

}  // namespace lockstep
