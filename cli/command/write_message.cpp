// Messages to standard error.
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "cli/command/command.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

/// Whether standard error is the journal's stream that systemd has announced: "device:inode".
bool is_journal() noexcept {
  static const bool answer = [] {
    const char* const announced = std::getenv("JOURNAL_STREAM");
    struct stat status {};
    if (announced == nullptr || fstat(STDERR_FILENO, &status) != 0) return false;
    return announced == std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  }();
  return answer;
}

}  // namespace

void write_message(const std::string& text, int patience) noexcept {
  std::size_t written = 0;
  while (written < text.size()) {
    pollfd place{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (poll(&place, 1, patience) != 1 || (place.revents & POLLOUT) == 0) return;
    const ssize_t taken = write(STDERR_FILENO, text.data() + written, text.size() - written);
    if (taken <= 0) return;
    written += static_cast<std::size_t>(taken);
  }
}

void tell_line(const std::string& text, Gravity gravity) noexcept {
  const std::string mark = is_journal() ? "<" + std::to_string(static_cast<int>(gravity)) + ">" : "";
  write_message(mark + visible(text) + "\n");
}

void tell(const std::string& text, Gravity gravity) noexcept {
  const bool warning = gravity == Gravity::information && text.starts_with("warning: ");
  tell_line("lockstep: " + text, warning ? Gravity::warning : gravity);
}

}  // namespace lockstep::cli
