/// What the system has to permit so that a cycle comes in time: real-time priority and locked memory.
#pragma once

#include <pthread.h>

namespace lockstep {

/// Of the cycle, in SCHED_FIFO: below the kernel's own threads.
inline constexpr int kCyclePriority = 80;

/// Gives a thread a priority of SCHED_FIFO. @return 0, or the error number
int give_priority(pthread_t thread, int priority) noexcept;

/// Locks the memory that the process has. What comes later is locked only where there is no limit: with one,
/// an allocation of another thread would fail.
/// @return 0, or the error number
int lock_memory() noexcept;

}  // namespace lockstep
