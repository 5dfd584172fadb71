// A system that gives a program so many threads and no more, for one that is started with this library before
// its own: LOCKSTEP_THREADS of them can be started, the next one cannot.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* argument) {
  static std::atomic<int> left{
      std::getenv("LOCKSTEP_THREADS") == nullptr ? 1'000'000 : std::atoi(std::getenv("LOCKSTEP_THREADS"))};
  if (left-- <= 0) return EAGAIN;
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, start, argument);
}
