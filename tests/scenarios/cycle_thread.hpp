// The thread of the cycle of a run, from outside: which it is, and what it asks the system for.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::test {

/// The thread of a process with a name; 0: none.
inline pid_t thread_named(pid_t process, const std::string& name) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::string found;
    std::getline(std::ifstream(task.path() / "comm"), found);
    if (found == name) return std::stoi(task.path().filename().string());
  }
  return 0;
}

/// The system calls of the thread of the cycle, for the three seconds from its making on.
class CycleCalls {
 public:
  explicit CycleCalls(pid_t process)
      : strace_({"timeout", "-s", "INT", "3", "strace", "-qq", "-o", calls_, "-p",
                 std::to_string(cycle_of(process))}) {}

  /// Waits for their end. There is nothing among them but the wait for the next tick.
  void expect_only_waits() {
    strace_.status();
    std::ifstream lines(calls_);
    int waits = 0;
    for (std::string line; std::getline(lines, line);) {
      const bool is_wait = line.starts_with("clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME") ||
                           line.starts_with("restart_syscall");
      waits += is_wait ? 1 : 0;
      if (!is_wait) ADD_FAILURE() << "a system call of the cycle: " << line;
    }
    EXPECT_GT(waits, 500) << "of the some 1,500 of three seconds";
  }

 private:
  static pid_t cycle_of(pid_t process) {
    pid_t cycle = 0;
    EXPECT_TRUE(wait_until([&] { return (cycle = thread_named(process, "cycle")) != 0; }));
    return cycle;
  }

  Directory directory_;
  std::string calls_ = directory_.file("calls");
  Process strace_;
};

}  // namespace lockstep::test
