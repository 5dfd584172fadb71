// lockstep plot: runs gnuplot.
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include "cli/plot/picture.hpp"

extern char** environ;

namespace lockstep::cli {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::generic_category().message(error));
}

/// A file in memory. With three of them for its input, output and errors, gnuplot never waits for us nor we
/// for it.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : fd_(memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0) fail("no memory for a plot", errno);
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int fd() const noexcept { return fd_; }

  void write(const std::string& text) const {
    for (std::size_t written = 0; written < text.size();) {
      const ssize_t taken = ::write(fd_, text.data() + written, text.size() - written);
      if (taken < 0) fail("no memory for a plot", errno);
      written += static_cast<std::size_t>(taken);
    }
    lseek(fd_, 0, SEEK_SET);
  }

  std::string read() const {
    std::string text;
    char block[65536];
    lseek(fd_, 0, SEEK_SET);
    for (ssize_t got = 1; got > 0;) {
      got = ::read(fd_, block, sizeof block);
      if (got > 0) text.append(block, static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int fd_;
};

/// The first lines of a text, on one.
std::string first_lines(const std::string& text) {
  constexpr std::size_t kEnough = 500;
  std::string first = text.substr(0, kEnough);
  std::replace(first.begin(), first.end(), '\n', ' ');
  return first;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const MemoryFile input("plot-script"), output("plot-picture"), errors("plot-errors");
  input.write(script);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.fd(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.fd(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.fd(), STDERR_FILENO);
  // Default settings: what somebody's .gnuplot says must not change the picture.
  char name[] = "gnuplot", defaults[] = "--default-settings";
  char* arguments[] = {name, defaults, nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, name, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  // EACCES: one of the folders in which it was looked for is closed.
  if (error == ENOENT || error == EACCES)
    throw std::runtime_error(
        "gnuplot, which draws the pictures, is not installed; on Debian: apt-get install "
        "gnuplot-nox");
  if (error != 0) fail("gnuplot cannot be started", error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail("gnuplot is lost", errno);
  std::string picture = output.read();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || picture.empty())
    throw std::runtime_error("gnuplot has failed: " + first_lines(errors.read()));
  return picture;
}

}  // namespace lockstep::cli
