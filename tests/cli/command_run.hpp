/// Runs the built `lockstep`, as a user would.
#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/support/directory.hpp"

namespace lockstep::cli {

using test::content;
using test::Directory;

/// What a command has said and how it ended.
struct Ended {
  int status = -1;  ///< exit status; -1: by a signal
  std::string out, err;
};

/// Runs a program to its end, with standard output and error in files.
inline Ended run(std::vector<std::string> command) {
  const Directory folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const auto redirect = [](const std::string& path, int to) {
      ::dup2(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), to);
    };
    redirect(folder.file("out"), STDOUT_FILENO);
    redirect(folder.file("err"), STDERR_FILENO);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder.file("out")),
          content(folder.file("err"))};
}

/// Runs `lockstep` with arguments.
inline Ended lockstep(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), LOCKSTEP_EXECUTABLE);
  return run(std::move(arguments));
}

}  // namespace lockstep::cli
