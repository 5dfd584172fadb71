#include "cli/command/standard_streams.hpp"

#include <fcntl.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace lockstep::cli {

OutputFailed::OutputFailed(int number)
    : std::runtime_error("standard output: " +
                         (number == 0 ? "it cannot be written" : std::generic_category().message(number))),
      error(number) {}

void open_missing_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest number that is free is this one.
    const int direction = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (open("/dev/null", direction) < 0) open("/", O_RDONLY | O_DIRECTORY);
  }
}

void write_data(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  const int error = errno;
  // What is left would fail, or wait, again when the program ends.
  __fpurge(stdout);
  std::clearerr(stdout);
  throw OutputFailed(error);
}

void finish_output() {
  if (std::fflush(stdout) != 0) throw OutputFailed(errno);
  if (std::ferror(stdout) != 0) throw OutputFailed(0);
}

}  // namespace lockstep::cli
