#include "hmi_bridge/network/thread_stacks.hpp"

#include <pthread.h>

namespace lockstep {

void keep_stacks_small() noexcept {
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return;
  if (pthread_attr_setstacksize(&attributes, kThreadStack) == 0) pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

}  // namespace lockstep
