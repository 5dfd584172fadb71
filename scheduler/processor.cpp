#include "scheduler/processor.hpp"

#include <sched.h>

#include <cerrno>
#include <cstring>

namespace lockstep {
namespace {

/// "0-3,6": the processors of a set.
std::string text_of(const cpu_set_t& set) {
  std::string text;
  for (int first = 0; first < CPU_SETSIZE; ++first) {
    if (!CPU_ISSET(static_cast<unsigned>(first), &set)) continue;
    int last = first;
    while (last + 1 < CPU_SETSIZE && CPU_ISSET(static_cast<unsigned>(last + 1), &set)) ++last;
    if (!text.empty()) text += ",";
    text += std::to_string(first);
    if (last > first) text += "-" + std::to_string(last);
    first = last;
  }
  return text;
}

}  // namespace

std::string leave_processor(int processor) {
  cpu_set_t permitted;
  CPU_ZERO(&permitted);
  if (sched_getaffinity(0, sizeof permitted, &permitted) != 0) return std::strerror(errno);
  const auto number = static_cast<unsigned>(processor);
  if (processor < 0 || processor >= CPU_SETSIZE || !CPU_ISSET(number, &permitted))
    return "processor " + std::to_string(processor) + ": this process may use " + text_of(permitted);
  if (CPU_COUNT(&permitted) == 1)
    return "processor " + std::to_string(processor) +
           " is the only one that this process may use; nothing would be left for Modbus and traces";
  CPU_CLR(number, &permitted);
  return sched_setaffinity(0, sizeof permitted, &permitted) == 0 ? "" : std::strerror(errno);
}

int keep_on_processor(pthread_t thread, int processor) noexcept {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(static_cast<unsigned>(processor), &only);
  return pthread_setaffinity_np(thread, sizeof only, &only);
}

}  // namespace lockstep
