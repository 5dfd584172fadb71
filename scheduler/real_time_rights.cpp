#include "scheduler/real_time_rights.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>

namespace lockstep {

int give_priority(pthread_t thread, int priority) noexcept {
  const sched_param parameters{priority};
  return pthread_setschedparam(thread, SCHED_FIFO, &parameters);
}

int lock_memory() noexcept {
  if (mlockall(MCL_CURRENT) != 0) return errno;
  rlimit limit{};
  const bool unlimited =
      geteuid() == 0 || (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
  return !unlimited || mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 0 : errno;
}

}  // namespace lockstep
