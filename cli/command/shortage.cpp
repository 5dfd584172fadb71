#include "cli/command/shortage.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>
#include <vector>

#include "cli/command/command.hpp"

namespace lockstep::cli {
namespace {

constexpr char kDescriptors[] =
    "there are too few file descriptors; what helps: a higher limit (ulimit -n, in a unit LimitNOFILE=)";
constexpr char kDescriptorsOfAll[] =
    "the machine has no file descriptors left; what helps: fewer open files of others, or a higher "
    "fs.file-max (sysctl)";
constexpr char kMemory[] =
    "there is not enough memory; what helps: a higher limit (ulimit -v, in a unit LimitAS= and MemoryMax=), "
    "or a project with less in it";
constexpr char kThreads[] =
    "no further thread can be started; what helps: a higher limit of tasks or memory (ulimit -u and -v, in a "
    "unit TasksMax= and LimitAS=)";

/// What an error of the system is short of; nullptr: of nothing.
const char* shortage_of(int error) noexcept {
  if (error == EMFILE) return kDescriptors;
  if (error == ENFILE) return kDescriptorsOfAll;
  if (error == ENOMEM) return kMemory;
  if (error == EAGAIN) return kThreads;  // as std::thread has it
  return nullptr;
}

const char* shortage_of(const std::exception& error) noexcept {
  if (dynamic_cast<const Shortage*>(&error) != nullptr) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return kMemory;
  const auto* const of_system = dynamic_cast<const std::system_error*>(&error);
  const bool has_number = of_system != nullptr && (of_system->code().category() == std::generic_category() ||
                                                   of_system->code().category() == std::system_category());
  return has_number ? shortage_of(of_system->code().value()) : nullptr;
}

/// Raises the limit of descriptors towards `wanted` as far as the process may.
void raise_limit(rlim_t wanted) noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= wanted)
    return;
  limit.rlim_cur = limit.rlim_max == RLIM_INFINITY || limit.rlim_max > wanted ? wanted : limit.rlim_max;
  static_cast<void>(setrlimit(RLIMIT_NOFILE, &limit));
}

}  // namespace

void require_descriptors(std::size_t count) {
  constexpr rlim_t kOpenAlready = 32;  // that the program was started with, and its own
  raise_limit(count + kOpenAlready);
  std::vector<int> opened;
  opened.reserve(count);
  int error = 0;
  while (error == 0 && opened.size() < count) {
    const int descriptor = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0)
      error = errno;
    else
      opened.push_back(descriptor);
  }
  for (const int descriptor : opened) ::close(descriptor);
  if (error == 0) return;
  const char* const known = shortage_of(error);
  const std::string what = std::to_string(count) + " file descriptors may be needed and " +
                           std::to_string(opened.size()) + " can be had: ";
  throw Shortage(what + (known != nullptr ? known : std::strerror(error)));
}

void require_memory(std::size_t bytes) {
  void* const place =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) throw Shortage(kMemory);
  ::munmap(place, bytes);
}

std::string with_help(const std::string& text) {
  for (const int error : {EMFILE, ENFILE, ENOMEM, EAGAIN})
    if (text.ends_with(std::generic_category().message(error))) return text + ": " + shortage_of(error);
  return text;
}

int tell_failure(const std::exception& error) noexcept {
  const char* const shortage = shortage_of(error);
  if (shortage == nullptr) {
    tell(std::string("internal fault: ") + error.what(), Severity::error);
    return kStoppedByFault;
  }
  // What the system says of it, such as what could not be opened.
  const bool says_more = dynamic_cast<const std::system_error*>(&error) != nullptr;
  std::fprintf(stderr, "lockstep: %s%s%s\n", says_more ? error.what() : "", says_more ? ": " : "", shortage);
  return kCouldNotStart;
}

}  // namespace lockstep::cli
