/// lockstep doctor: what it says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/doctor/verdict.hpp"

namespace lockstep::cli {

/// What was found.
struct Findings {
  std::int64_t servo_cycle = 0;  ///< that is asked for [ns]
  std::int64_t duration = 0;     ///< of the measurement [ns]
  int processor = -1;            ///< that was measured on; negative: any
  std::uint64_t wakeups = 0;
  std::int64_t median = 0, one_percent = 0, rarest = 0, worst = 0;  ///< lateness [ns]; of 50, 99, 99.99 %
  SystemFacts facts;
  RealTimeRights rights;
  Verdict verdict;
  std::vector<Advice> advice;
};

/// For people.
std::string report_text(const Findings& findings);
/// For programs: JSON.
std::string report_json(const Findings& findings);

/// "250 µs", "1 ms": [ns] in the unit that needs no more than three digits before its point.
std::string time_text(std::int64_t time);

}  // namespace lockstep::cli
