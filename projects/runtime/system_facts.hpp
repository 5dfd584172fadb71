/// What the system gives to a run in real time, as it tells it itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/real_time.hpp"

namespace lockstep {

/// How the kernel lets a task that has become ready interrupt it.
enum class Preemption : std::uint8_t {
  none,       ///< at its own points only
  dynamic,    ///< chosen when it starts, by `preempt=`
  full,       ///< but for what holds a spin lock or serves an interrupt
  real_time,  ///< nearly everywhere: PREEMPT_RT
};

struct SystemFacts {
  std::string kernel;                        ///< its release, such as "6.1.0-18-amd64"
  Preemption preemption = Preemption::none;  ///< as it was built
  std::string preemption_now;                ///< of a dynamic one, such as "voluntary"; empty: not told
  std::string processors;                    ///< that work, such as "0-3"
  std::string isolated;                      ///< that the kernel keeps free; empty: none
  std::vector<std::string> governors;        ///< of their frequencies, each once; empty: not told
  std::int64_t priority_limit = 0;           ///< of SCHED_FIFO, without privileges; RLIMIT_RTPRIO
  std::int64_t memory_limit = 0;             ///< that may be locked [byte]; negative: no limit
};

/// What is not told is empty. @param root stands before the paths of /sys
SystemFacts read_system_facts(const std::string& root = "");

/// The preemption in the kernel's word: "PREEMPT_RT", "PREEMPT_DYNAMIC (voluntary)", …
std::string preemption_text(const SystemFacts& facts);

/// Whether a processor is one of a list such as "1,3-5".
bool is_in_list(int processor, const std::string& list);
/// How many there are in such a list, and the highest; -1: none.
int count_in_list(const std::string& list);
int highest_in_list(const std::string& list);

/// What a run has got, in a line.
/// @param processor of the cycle; negative: any
std::string system_text(const SystemFacts& facts, const RealTimeRights& rights, int processor);

}  // namespace lockstep
