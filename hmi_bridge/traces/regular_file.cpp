#include "hmi_bridge/traces/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace lockstep {
namespace {

RegularFile none(int error) {
  RegularFile file;
  file.problem = std::generic_category().message(error);
  return file;
}

}  // namespace

std::int64_t RegularFile::size() const noexcept {
  struct stat status {};
  return ::fstat(::fileno(stream.get()), &status) == 0 ? std::int64_t{status.st_size} : 0;
}

RegularFile open_regular_file(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return none(errno);
  RegularFile file;
  file.stream.reset(::fdopen(descriptor, "rb"));
  if (file.stream == nullptr) {
    const int error = errno;
    ::close(descriptor);
    return none(error);
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return none(errno);
  if (S_ISDIR(status.st_mode)) return none(EISDIR);
  if (!S_ISREG(status.st_mode)) {
    file.stream.reset();
    file.problem = "is no regular file but a pipe, a device or a socket";
  }
  return file;
}

}  // namespace lockstep
