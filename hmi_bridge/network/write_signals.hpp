/// For threads that write to files and pipes.
#pragma once

#include <pthread.h>
#include <signal.h>

namespace lockstep {

/// A write to a closed pipe and one beyond the file size limit signal the writing thread; blocked there, they
/// are the errors EPIPE and EFBIG of the call and leave the rest of the process alone. Thread: the writing
/// one, before its first write.
inline void block_write_signals() noexcept {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGPIPE);
  sigaddset(&signals, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace lockstep
