/// A processor that the thread of the cycle has for itself.
#pragma once

#include <pthread.h>

#include <string>

namespace lockstep {

/// The calling thread, and those that it starts from then on, leave a processor to the cycle. Call before
/// other threads are started.
/// @param processor number as Linux counts them, from 0
/// @return empty, or why it cannot be: this process may not use it, or has no other
std::string leave_processor(int processor);

/// Keeps a thread on one processor.
/// @return 0, or the number of the error
int keep_on_processor(pthread_t thread, int processor) noexcept;

}  // namespace lockstep
