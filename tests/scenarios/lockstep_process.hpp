/// The built `lockstep` as a user starts it, with what it writes and how it ends.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/directory.hpp"

namespace lockstep::test {

using Clock = std::chrono::steady_clock;

inline constexpr std::chrono::seconds kDeadline{60};

/// Waits for a condition of another process; false at the deadline.
inline bool wait_until(const std::function<bool()>& condition, std::chrono::seconds limit = kDeadline) {
  const auto deadline = Clock::now() + limit;
  while (!condition()) {
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

inline std::string example(const std::string& name) {
  return std::string(LOCKSTEP_SOURCE_DIR) + "/projects/" + name + "/project.json";
}

/// All example projects.
inline std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(LOCKSTEP_SOURCE_DIR) + "/projects"))
    if (std::filesystem::exists(entry.path() / "project.json")) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

/// A program that runs; it ends with this object, or with this process.
class Process {
 public:
  enum class Output { files, terminal };

  explicit Process(std::vector<std::string> command, Output output = Output::files) {
    pid_ = output == Output::terminal ? ::forkpty(&terminal_, nullptr, nullptr, nullptr) : ::fork();
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::closefrom(STDERR_FILENO + 1);  // what this process was started with is nothing of the program's
    if (output == Output::files) {
      redirect(STDOUT_FILENO, directory_.file("out"));
      redirect(STDERR_FILENO, directory_.file("err"));
    }
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~Process() {
    if (!ended_) ::kill(pid_, SIGKILL);
    if (!ended_) ::waitpid(pid_, &status_, 0);
    close_terminal();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const { ::kill(pid_, signal); }
  pid_t pid() const { return pid_; }
  bool running() {
    if (!ended_) ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return !ended_;
  }
  /// Waits for its end; its exit status, or -1 when a signal or the deadline ended it.
  int status() {
    if (!wait_until([this] { return !running(); })) {
      ADD_FAILURE() << "did not end; it wrote:\n" << err();
      ::kill(pid_, SIGKILL);
      ended_ = ::waitpid(pid_, &status_, 0) == pid_;
    }
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }
  std::string out() const { return content(directory_.file("out")); }
  /// What it has written to standard error so far; on a terminal, to both.
  std::string err() {
    if (terminal_ < 0) return seen_.empty() ? content(directory_.file("err")) : seen_;
    ::fcntl(terminal_, F_SETFL, O_NONBLOCK);
    char buffer[4096];
    for (ssize_t n = 0; (n = ::read(terminal_, buffer, sizeof buffer)) > 0;)
      seen_.append(buffer, static_cast<std::size_t>(n));
    return seen_;
  }
  void close_terminal() {
    if (terminal_ >= 0) ::close(terminal_);
    terminal_ = -1;
  }

 private:
  static void redirect(int fd, const std::string& path) {
    const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0600);
    ::dup2(file, fd);
  }

  Directory directory_;
  pid_t pid_ = -1;
  int terminal_ = -1;
  std::string seen_;
  int status_ = 0;
  bool ended_ = false;
};

inline std::vector<std::string> lockstep_command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), LOCKSTEP_PROGRAM);
  return arguments;
}

/// How `lockstep` ended, and what it wrote.
struct Ended {
  int status = -1;
  std::string out;
  std::string err;
};

inline Ended lockstep(std::vector<std::string> arguments) {
  Process process(lockstep_command(std::move(arguments)));
  Ended ended;
  ended.status = process.status();
  ended.out = process.out();
  ended.err = process.err();
  return ended;
}

/// `lockstep run FILE` in real time with a Modbus server on a free port.
class RunningLockstep : public Process {
 public:
  explicit RunningLockstep(const std::string& project, const std::vector<std::string>& options = {},
                           Output output = Output::files)
      : Process(command(project, options), output) {
    const std::string mark = "Modbus server on 127.0.0.1:";
    if (!wait_until([&] { return err().find(mark) != std::string::npos || !running(); }) || !running()) {
      ADD_FAILURE() << "did not start; it wrote:\n" << err();
      return;
    }
    wait_until([&] { return err().find('\n', err().find(mark)) != std::string::npos; });
    const std::string text = err();
    port_ = std::atoi(text.c_str() + text.find(mark) + mark.size());
  }
  int port() const { return port_; }

 private:
  static std::vector<std::string> command(const std::string& project,
                                          const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"run", project, "--modbus", "127.0.0.1:0", "--no-lcm"};
    // An example that keeps values would do so in the sources, one run at a time.
    if (project.starts_with(LOCKSTEP_SOURCE_DIR)) arguments.emplace_back("--no-retain");
    arguments.insert(arguments.end(), options.begin(), options.end());
    return lockstep_command(std::move(arguments));
  }
  int port_ = 0;
};

}  // namespace lockstep::test
