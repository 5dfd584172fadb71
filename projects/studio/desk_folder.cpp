#include "projects/studio/desk_folder.hpp"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "projects/studio/api.hpp"

namespace lockstep {
namespace {

using studio_api::BadRequest;

constexpr std::size_t kLongestPath = 1024;

/// Opens what lies below a folder; the system itself follows no link and no `..` on the path.
OpenFile open_below(const std::string& folder, const std::string& name, std::uint64_t flags) {
  const OpenFile root(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (root.number() < 0) return OpenFile(-1);
  open_how how{};
  how.flags = flags | O_CLOEXEC;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  return OpenFile(static_cast<int>(::syscall(SYS_openat2, root.number(), name.c_str(), &how, sizeof how)));
}

[[noreturn]] void refuse(std::string_view name, int error) {
  const std::string quoted = "'" + std::string(name) + "'";
  if (error == ENOENT || error == ENOTDIR) throw BadRequest(404, "not_found", "there is no file " + quoted);
  if (error == ELOOP || error == EXDEV)
    throw BadRequest(403, "not_allowed", quoted + " is reached by a link; allowed: files by their own names");
  throw BadRequest(403, "not_allowed", quoted + ": " + std::strerror(error));
}

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(file) == 0;
}

}  // namespace

std::string_view DeskFolder::name_of(std::string_view path) const noexcept {
  if (path_.empty() || !path.starts_with(path_)) return path;
  const std::string_view rest = path.substr(path_.size());
  if (rest.starts_with('/') && !path_.ends_with('/')) return rest.substr(1);
  return path_.ends_with('/') ? rest : path;
}

void DeskFolder::check_name(std::string_view name) const {
  if (path_.empty())
    throw BadRequest(403, "not_allowed", "this studio has no folder of which files are read");
  const bool is_plain = std::all_of(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '\x7f'; });
  if (name.empty() || name.size() > kLongestPath || !is_plain)
    throw BadRequest(403, "not_allowed",
                     "a name of a file has 1 to " + std::to_string(kLongestPath) + " printable characters");
  const bool leads_out = name.starts_with('/') || name == ".." || name.starts_with("../") ||
                         name.ends_with("/..") || name.find("/../") != name.npos;
  if (leads_out)
    throw BadRequest(403, "not_allowed",
                     "'" + std::string(name) +
                         "' lies beyond the folder of this studio; allowed: names below " + path_ +
                         ", without '..'");
}

bool DeskFolder::has(std::string_view name) const {
  check_name(name);
  const OpenFile file = open_below(path_, std::string(name), O_PATH | O_NOFOLLOW);
  return file.number() >= 0 || errno == ELOOP;
}

OpenFile DeskFolder::open(std::string_view name) const {
  check_name(name);
  OpenFile file = open_below(path_, std::string(name), O_RDONLY | O_NONBLOCK);
  if (file.number() < 0) refuse(name, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
    throw BadRequest(403, "not_allowed", "'" + std::string(name) + "' is no file");
  return file;
}

std::string DeskFolder::read(std::string_view name, std::size_t maximum) const {
  const OpenFile file = open(name);
  std::string content;
  char bytes[1 << 14];
  for (ssize_t got = 0; (got = ::read(file.number(), bytes, sizeof bytes)) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(name, errno);
    content.append(bytes, static_cast<std::size_t>(got));
    if (content.size() > maximum)
      throw BadRequest(413, "too_large",
                       "'" + std::string(name) + "' has more than " + std::to_string(maximum) + " bytes");
  }
  return content;
}

void DeskFolder::write(std::string_view name, std::string_view content) const {
  check_name(name);
  const std::size_t slash = name.rfind('/');
  const std::string inner(slash == name.npos ? "." : name.substr(0, slash));
  const std::string last(slash == name.npos ? name : name.substr(slash + 1));
  const OpenFile folder = open_below(path_, inner, O_RDONLY | O_DIRECTORY);
  if (folder.number() < 0) refuse(name, errno);
  struct stat before {};
  const bool is_there = ::fstatat(folder.number(), last.c_str(), &before, AT_SYMLINK_NOFOLLOW) == 0;
  if (is_there && !S_ISREG(before.st_mode)) refuse(name, S_ISLNK(before.st_mode) ? ELOOP : EISDIR);
  const auto failed = [&name](int error) {
    return BadRequest(409, "conflict",
                      "'" + std::string(name) + "' cannot be written: " + std::strerror(error));
  };
  const std::string beside = "." + last + ".studio-" + std::to_string(::getpid());
  const OpenFile file(
      ::openat(folder.number(), beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (file.number() < 0) throw failed(errno);
  const bool is_written = write_all(file.number(), content) &&
                          (!is_there || ::fchmod(file.number(), before.st_mode & 07777) == 0) &&
                          ::renameat(folder.number(), beside.c_str(), folder.number(), last.c_str()) == 0;
  if (is_written) return;
  const int error = errno;
  ::unlinkat(folder.number(), beside.c_str(), 0);
  throw failed(error);
}

}  // namespace lockstep
