#include "hmi_bridge/traces/file.hpp"

#include <fcntl.h>
#include <stdio_ext.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace lockstep {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18;  // [byte] one write

}  // namespace

TraceFile::TraceFile(TraceSink& sink, std::FILE* file) : sink_(sink), file_(file), buffer_(kBlock) {
  std::setvbuf(file_, buffer_.data(), _IOFBF, buffer_.size());
  ::fcntl(::fileno(file_), F_SETFD, FD_CLOEXEC);
}

bool TraceFile::open_row(std::size_t bytes, std::uint64_t rows) {
  const auto size = static_cast<std::int64_t>(bytes);
  if (end_ - saved_ + size > static_cast<std::int64_t>(buffer_.size())) flush();
  if (failed_) {
    sink_.lose(rows, {});
    return false;
  }
  end_ += size;
  unwritten_.push_back({end_, rows});
  return true;
}

void TraceFile::close_row(bool written) {
  if (!written && !failed_) fail(errno);
}

void TraceFile::flush() {
  if (failed_) return;
  if (std::fflush(file_) != 0) return fail(errno);
  saved_ = end_;
  unwritten_.clear();
}

void TraceFile::close() {
  flush();
  __fpurge(file_);  // after a failure nothing half-written may follow
  // Some file systems write late and tell of it when a descriptor is closed; any copy of it will do.
  const int copy = ::dup(::fileno(file_));
  if (copy >= 0 && ::close(copy) != 0) sink_.lose(0, std::generic_category().message(errno));
}

void TraceFile::fail(int error) {
  failed_ = true;
  __fpurge(file_);
  const int fd = ::fileno(file_);
  struct stat status {};
  const bool on_disk = ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
  const std::int64_t reached = on_disk ? ::lseek(fd, 0, SEEK_CUR) : saved_;
  std::uint64_t lost = 0;
  for (const Mark& mark : unwritten_) {
    if (mark.end <= reached)
      saved_ = mark.end;
    else
      lost += mark.rows;
  }
  unwritten_.clear();
  std::string reason = std::generic_category().message(error);
  if (on_disk && ::ftruncate(fd, saved_) != 0) reason += "; the file ends in the middle of a row";
  sink_.lose(lost, reason);
}

}  // namespace lockstep
