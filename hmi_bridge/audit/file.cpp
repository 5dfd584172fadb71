#include "hmi_bridge/audit/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace lockstep {

AuditFile::AuditFile(AuditOptions options) : options_(std::move(options)) {
  if (const int error = open(); error != 0)
    throw std::system_error(error, std::generic_category(), options_.file);
}

AuditFile::~AuditFile() {
  if (fd_ >= 0) ::close(fd_);
}

/// @return the error, or 0
int AuditFile::open() noexcept {
  fd_ = ::open(options_.file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0640);
  if (fd_ < 0) return errno;
  struct stat status {};
  if (::fstat(fd_, &status) != 0) return errno;
  if (!S_ISREG(status.st_mode)) {  // a pipe that nobody reads would lose everything
    ::close(std::exchange(fd_, -1));
    return EINVAL;
  }
  size_ = status.st_size;
  char last = '\n';
  is_cut_ = size_ > 0 && ::pread(fd_, &last, 1, size_ - 1) == 1 && last != '\n';
  return 0;
}

/// Whether what is written still is the file of that name.
bool AuditFile::is_there() const noexcept {
  struct stat open {};
  struct stat named {};
  return ::fstat(fd_, &open) == 0 && ::stat(options_.file.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// A file that has been moved, removed or replaced meanwhile gets no more lines: they go to the one that has
/// its name, or to a new one.
void AuditFile::look() {
  if (fd_ < 0 || is_there()) return;
  ::close(std::exchange(fd_, -1));
  problem_ = "the file has been moved, removed or replaced; what follows is in the one that has its name now";
}

std::size_t AuditFile::append(std::span<const AuditLine> lines) {
  problem_.clear();
  look();
  std::size_t written = 0;
  while (written < lines.size() && write(lines[written].text)) ++written;
  if (written > 0 && ::fdatasync(fd_) != 0) problem_ = std::generic_category().message(errno);
  return written;
}

bool AuditFile::write(const std::string& line) {
  if (size_ > 0 && size_ + static_cast<std::int64_t>(line.size()) > options_.size) rotate();
  if (fd_ < 0) {
    if (const int error = open(); error != 0) {
      problem_ = std::generic_category().message(error);
      return false;
    }
  }
  const std::string text = is_cut_ ? "\n" + line : line;
  const ssize_t count = ::write(fd_, text.data(), text.size());
  if (count == static_cast<ssize_t>(text.size())) {
    size_ += count;
    is_cut_ = false;
    return true;
  }
  problem_ = std::generic_category().message(count < 0 ? errno : ENOSPC);
  if (count > 0) {
    size_ += count;
    is_cut_ = text[static_cast<std::size_t>(count) - 1] != '\n';
  }
  return false;
}

/// What cannot be renamed grows on: a log that is too large is better than none.
void AuditFile::rotate() {
  const auto name = [this](int i) {
    return i == 0 ? options_.file : options_.file + "." + std::to_string(i);
  };
  for (int i = options_.files - 1; i > 1; --i) ::rename(name(i - 1).c_str(), name(i).c_str());
  if (::rename(name(0).c_str(), name(1).c_str()) == 0)
    ::close(std::exchange(fd_, -1));
  else
    problem_ = "the next file cannot be begun: " + std::generic_category().message(errno);
  size_ = 0;
}

}  // namespace lockstep
