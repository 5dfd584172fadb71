#include "hmi_bridge/retain/file_on_disk.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr int kMaximumAside = 99;
constexpr int kMaximumLinks = 40;

/// Where a name leads, of which the file itself need not be there.
fs::path target_of(fs::path path) {
  std::error_code none;
  for (int i = 0; i < kMaximumLinks && fs::is_symlink(path, none); ++i)
    path = path.parent_path() / fs::read_symlink(path, none);
  return path;
}

/// Like rename, but never over something. Some file systems know only one of the two calls.
int rename_to_new(const std::string& from, const std::string& to) noexcept {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  if (::link(from.c_str(), to.c_str()) != 0) return errno;
  return ::unlink(from.c_str()) == 0 ? 0 : errno;
}

int write_all(int file, std::span<const std::uint8_t> content) noexcept {
  while (!content.empty()) {
    const ssize_t count = ::write(file, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : ENOSPC;
    content = content.subspan(static_cast<std::size_t>(count));
  }
  return ::fsync(file) == 0 ? 0 : errno;
}

/// So that a name outlives a loss of power. File systems that cannot do so are not asked twice.
void sync_directory(const fs::path& directory) noexcept {
  const int file = ::open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

bool FileStamp::is_regular() const noexcept {
  return S_ISREG(mode);
}

FileStamp stamp_of(const std::string& path) noexcept {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {.exists = true,
          .device = status.st_dev,
          .inode = status.st_ino,
          .mode = status.st_mode,
          .size = status.st_size,
          .changed = std::int64_t{status.st_ctim.tv_sec} * 1'000'000'000 + status.st_ctim.tv_nsec};
}

int write_beside(const std::string& path, std::span<const std::uint8_t> content, mode_t mode,
                 std::string& fresh) {
  fresh = target_of(path).string() + ".new-" + std::to_string(::getpid());
  ::unlink(fresh.c_str());
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) return errno;
  int error = write_all(file, content);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error != 0) ::unlink(fresh.c_str());
  return error;
}

int give_name(const std::string& fresh, const std::string& path) {
  const fs::path target = target_of(path);
  int error = stamp_of(target.string()).exists ? EEXIST : 0;
  // The journal of a file that is gone would be rolled back into the new one.
  if (error == 0) ::unlink((target.string() + "-journal").c_str());
  if (error == 0) error = rename_to_new(fresh, target.string());
  if (error == 0)
    sync_directory(target.parent_path());
  else
    ::unlink(fresh.c_str());
  return error;
}

int put_aside(const std::string& path, std::string& aside) {
  const std::string target = target_of(path).string();
  int error = EEXIST;
  for (int i = 1; i <= kMaximumAside && error == EEXIST; ++i) {
    aside = target + ".aside-" + std::to_string(i);
    if (stamp_of(aside).exists) continue;
    // Its journal first: nothing of the old file may be rolled back into a new one.
    const int journal = rename_to_new(target + "-journal", aside + "-journal");
    error = journal == 0 || journal == ENOENT ? rename_to_new(target, aside) : journal;
  }
  return error;
}

}  // namespace lockstep
