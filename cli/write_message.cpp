// Messages to standard error.
#include <poll.h>
#include <unistd.h>

#include "cli/command.hpp"

namespace lockstep::cli {

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

}  // namespace lockstep::cli
