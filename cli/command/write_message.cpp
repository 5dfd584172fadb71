// Messages to standard error.
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>

#include "cli/command/command.hpp"
#include "cli/command/redirect.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

std::atomic<int> redirected{-1};  // descriptor of messages; negative: standard error

constexpr std::size_t kAtOnce = 4096;  // [byte] a pipe that takes something takes that much

/// Whether standard error is the journal's stream that systemd has announced: "device:inode".
bool is_journal() noexcept {
  if (redirected >= 0) return false;
  static const bool answer = [] {
    const char* const announced = std::getenv("JOURNAL_STREAM");
    struct stat status {};
    if (announced == nullptr || fstat(STDERR_FILENO, &status) != 0) return false;
    return announced == std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  }();
  return answer;
}

/// Standard error so that it never waits, whoever shares its terminal or pipe: those are opened anew,
/// since a descriptor that is set not to wait is so for all who have it.
int error_output() noexcept {
  static const int output = [] {
    struct stat status {};
    const bool can_wait =
        fstat(STDERR_FILENO, &status) == 0 && (S_ISFIFO(status.st_mode) || isatty(STDERR_FILENO) == 1);
    if (!can_wait) return STDERR_FILENO;
    const int own = open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    return own < 0 ? STDERR_FILENO : own;
  }();
  return output;
}

ssize_t write_some(int output, const char* text, std::size_t size) noexcept {
  const ssize_t taken = send(output, text, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  return taken >= 0 || errno != ENOTSOCK ? taken : write(output, text, size);
}

}  // namespace

void write_messages_to(int descriptor) noexcept {
  redirected = descriptor;
}

void write_message(const std::string& text, int timeout) noexcept {
  // Where nobody has read for the time of one message, the next ones do not wait as well.
  static std::atomic<bool> is_unread{false};
  const int place = redirected >= 0 ? redirected.load() : error_output();
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(is_unread ? 0 : timeout);
  for (std::size_t written = 0; written < text.size();) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd output{.fd = place, .events = POLLOUT, .revents = 0};
    const int ready = poll(&output, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready < 0 && errno == EINTR) continue;
    if (ready != 1) {
      is_unread = is_unread || timeout > 0;
      return;
    }
    if ((output.revents & POLLOUT) == 0) return;
    const ssize_t taken = write_some(place, text.data() + written, std::min(text.size() - written, kAtOnce));
    if (taken < 0 && (errno == EAGAIN || errno == EINTR) && left.count() > 0) {
      poll(nullptr, 0, 1);
      continue;
    }
    if (taken <= 0) return;
    written += static_cast<std::size_t>(taken);
  }
  is_unread = false;
}

void tell_line(const std::string& text, Severity severity) noexcept {
  const std::string mark = is_journal() ? "<" + std::to_string(static_cast<int>(severity)) + ">" : "";
  write_message(mark + visible(text) + "\n");
}

void tell(const std::string& text, Severity severity) noexcept {
  const bool warning = severity == Severity::information && text.starts_with("warning: ");
  tell_line("lockstep: " + text, warning ? Severity::warning : severity);
}

}  // namespace lockstep::cli
