#include "projects/json/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace lockstep {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Without waiting for who might write to a pipe. @throws UnreadableFile
File opened(const std::string& path) {
  const auto fail = [&](int error) { throw UnreadableFile(path + ": " + std::strerror(error)); };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) fail(errno);
  File file(::fdopen(descriptor, "rb"), &std::fclose);
  if (file == nullptr) {
    const int error = errno;
    ::close(descriptor);
    fail(error);
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(errno);
  if (S_ISDIR(status.st_mode)) fail(EISDIR);
  if (!S_ISREG(status.st_mode)) throw UnreadableFile(path + ": is no file but a pipe, a device or a socket");
  return file;
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t maximum) {
  const File file = opened(path);
  std::string text(64 * 1024, '\0');
  std::size_t size = 0;
  while (size <= maximum) {
    if (size == text.size()) text.resize(std::min(2 * size, maximum + 1));
    const std::size_t count = std::fread(text.data() + size, 1, text.size() - size, file.get());
    size += count;
    if (count == 0) break;
  }
  if (std::ferror(file.get()) != 0) throw UnreadableFile(path + ": " + std::strerror(errno));
  text.resize(size);
  return text;
}

}  // namespace lockstep
