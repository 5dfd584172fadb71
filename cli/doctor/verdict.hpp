/// lockstep doctor: what the measurement means, and what would help.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "projects/runtime/system_facts.hpp"
#include "scheduler/real_time.hpp"

namespace lockstep::cli {

/// Servo cycles that are looked at for the shortest one [ns].
std::span<const std::int64_t> usual_servo_cycles() noexcept;

/// A servo cycle fits if so many times the worst lateness are not longer: a third of the cycle for what was
/// measured, a third for what is rarer than some seconds show, a third for the work of a tick.
inline constexpr std::int64_t kMargin = 3;

struct Verdict {
  bool fits = false;          ///< the lateness, into the servo cycle that is asked for
  bool holds = false;         ///< it fits, and the cycle has real-time priority: no other process counts
  std::int64_t shortest = 0;  ///< of the usual ones that fit [ns]; 0: none
};

/// @param worst, servo_cycle [ns]
Verdict judge(std::int64_t worst, std::int64_t servo_cycle, const RealTimeRights& rights);

/// Something that would help.
struct Advice {
  std::string
      key;  ///< for programs: "priority", "memory", "kernel", "preempt", "isolation", "processor", "governor"
  std::string text;     ///< what, and why
  std::string command;  ///< that does it
  std::string after;    ///< what has to follow, such as a restart; empty: nothing
};

/// What the machine does not do yet, what helps most first.
/// @param processor that was measured on; negative: any
std::vector<Advice> advise(const SystemFacts& facts, const RealTimeRights& rights, int processor);

}  // namespace lockstep::cli
