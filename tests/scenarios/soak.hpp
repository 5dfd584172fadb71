/// What the days of virtual time have in common: the memory of a process, and projects that use much.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr long kMayGrow = 300'000;  // [KiB] the sanitizer keeps what has been released, up to 256 MiB
#else
inline constexpr long kMayGrow = 256;  // [KiB]
#endif

/// Memory of a process in the machine [KiB].
inline long resident(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::atol(line.c_str() + 6);
  return -1;
}

/// Adds a flight recorder, and channels with fewer rows and with those around occasions that come and go.
inline void add_recorders(Json& json, const std::string& flight) {
  const Json signal = json["trace"]["signals"][json["trace"]["signals"].size() - 1];
  json["flight_recorder"] = {{"before", "10s"}, {"after", "1s"}, {"file", flight}};
  json["trace"]["channels"] = Json::parse(R"([
    {"channel": "SLOW", "signals": [], "every": 100},
    {"channel": "EDGE", "signals": [], "every": 3,
     "trigger": {"on": "rising", "signal": "", "before": "5s", "after": "1s"}}])");
  for (Json& channel : json["trace"]["channels"]) channel["signals"].push_back(signal);
  json["trace"]["channels"][1]["trigger"]["signal"] = signal;
}

/// Adds a tag that changes in every millisecond and an array of which one element after the other does, both
/// kept. Of an array that is not changed at all nothing is to be written again.
inline Json with_kept_values(Json json) {
  json["tags"]["beat"] = {{"type", "DINT"}, {"retain", true}};
  json["tags"]["beats"] = {{"type", "ARRAY[0..499] OF DINT"}, {"retain", true}};
  json["tags"]["recipe"] = {
      {"type", "ARRAY[1..50] OF TO_Cam_Struct_PointData"}, {"init", {{1.0, 2.5}}}, {"retain", true}};
  json["programs"].push_back(
      {{"name", "Beat"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls", {assignment("beat", "beat + 1"), assignment("beats[beat MOD 500]", "beat")}}});
  return json;
}

}  // namespace lockstep::test
