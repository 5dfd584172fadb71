#include "cli/command/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace lockstep::cli {
namespace {

[[noreturn]] void fail_to_write(const std::string& path, int error) {
  throw std::runtime_error(path + ": " + std::generic_category().message(error));
}

/// What is there already: nothing, a file, or something else that takes bytes.
struct Target {
  std::string path;  ///< symbolic links resolved
  bool there = false;
  bool plain = true;  ///< a regular file, or one that will be
  struct stat status {};
};

Target target_of(const std::string& path) {
  Target target{.path = path};
  target.there = ::stat(path.c_str(), &target.status) == 0;
  if (!target.there) {
    std::error_code ignored;
    target.plain = !std::filesystem::is_symlink(path, ignored);  // one that leads to nothing as yet
    return target;
  }
  if (S_ISDIR(target.status.st_mode)) fail_to_write(path, EISDIR);
  target.plain = S_ISREG(target.status.st_mode);
  if (::access(path.c_str(), W_OK) != 0) fail_to_write(path, errno);
  std::error_code ignored;
  if (const auto real = std::filesystem::canonical(path, ignored); !ignored) target.path = real.string();
  return target;
}

/// A descriptor, and the file that goes with it unless it is kept.
class NewFile {
 public:
  NewFile(const std::string& path, int flags) : path_((flags & O_EXCL) != 0 ? path : "") {
    descriptor_ = ::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC | O_NOCTTY, 0666);
    error_ = descriptor_ < 0 ? errno : 0;
  }
  ~NewFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (descriptor_ >= 0 && !path_.empty()) ::unlink(path_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  int error() const noexcept { return error_; }
  int descriptor() const noexcept { return descriptor_; }

  /// @return errno, or 0
  int write(std::string_view text) noexcept {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
  }
  /// Some file systems tell only here that the disk is full.
  int put_in_place(const std::string& target) noexcept {
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) return errno;
    if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
    path_.clear();
    return 0;
  }

 private:
  std::string path_;
  int descriptor_ = -1;
  int error_ = 0;
};

std::string beside(const std::string& path) {
  return path + ".new-" + std::to_string(::getpid());
}

/// Where no other file may be made there, or it is no file.
void write_in_place(const std::string& path, const std::string& text) {
  NewFile file(path, O_CREAT | O_TRUNC);
  int error = file.error();
  if (error == 0) error = file.write(text);
  if (error != 0) fail_to_write(path, error);
}

}  // namespace

void write_whole_file(const std::string& path, const std::string& text) {
  const Target target = target_of(path);
  if (!target.plain) return write_in_place(path, text);
  NewFile fresh(beside(target.path), O_CREAT | O_EXCL);
  // The file may be the user's in a folder that is not.
  if (fresh.error() != 0 && target.there && fresh.error() != ENOSPC) return write_in_place(path, text);
  int error = fresh.error();
  if (error == 0 && target.there) {
    [[maybe_unused]] const int owner =
        ::fchown(fresh.descriptor(), target.status.st_uid, target.status.st_gid);
    if (::fchmod(fresh.descriptor(), target.status.st_mode & 07777) != 0) error = errno;
  }
  if (error == 0) error = fresh.write(text);
  if (error == 0) error = fresh.put_in_place(target.path);
  if (error != 0) fail_to_write(path, error);
}

void require_writable(const std::string& path) {
  const Target target = target_of(path);
  if (target.there) return;
  const NewFile fresh(beside(target.path), O_CREAT | O_EXCL);
  if (fresh.error() != 0) fail_to_write(path, fresh.error());
}

}  // namespace lockstep::cli
