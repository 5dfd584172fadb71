// A disk that does not answer, for a program that is started with this library before its own: bringing a
// file onto it takes for ever as soon as the file named by LOCKSTEP_HANG is there.
#include <unistd.h>

#include <cstdlib>

namespace {

int bring() {
  const char* const mark = std::getenv("LOCKSTEP_HANG");
  while (mark != nullptr && ::access(mark, F_OK) == 0) ::usleep(100'000);
  return 0;
}

}  // namespace

extern "C" int fsync(int /*file*/) {
  return bring();
}

extern "C" int fdatasync(int /*file*/) {
  return bring();
}
