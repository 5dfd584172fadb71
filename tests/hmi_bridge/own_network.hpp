/// A network of its own for a test, and the programs that it runs there.
#pragma once

#include <gtest/gtest.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace lockstep {

inline constexpr char kInside[] = "LOCKSTEP_TEST_IN_OWN_NETWORK";
inline constexpr std::chrono::seconds kDeadline{60};

/// A program that ends with this object, or with this process.
class ForeignProgram {
 public:
  explicit ForeignProgram(std::vector<std::string> command) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~ForeignProgram() {
    if (!ended_) ::kill(pid_, SIGKILL);
    status();
  }
  pid_t process() const { return pid_; }
  void stop() { ::kill(pid_, SIGSTOP); }
  void interrupt() { ::kill(pid_, SIGINT); }
  bool running() {
    if (!ended_) ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return !ended_;
  }
  /// Waits for its end; the exit status, or -1 when a signal ended it.
  int status() {
    if (!ended_) ended_ = ::waitpid(pid_, &status_, 0) == pid_;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

inline bool wait_until(const std::function<bool()>& condition, std::chrono::seconds limit = kDeadline) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

// Brings up the loopback device of this network, able to multicast, with a route for all of it.
inline void bring_up_network() {
  const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  ifreq device{};
  std::snprintf(device.ifr_name, sizeof device.ifr_name, "lo");
  device.ifr_flags = IFF_UP | IFF_RUNNING | IFF_LOOPBACK | IFF_MULTICAST;
  ASSERT_EQ(::ioctl(fd, SIOCSIFFLAGS, &device), 0) << std::strerror(errno);
  rtentry route{};
  const auto address = [](sockaddr& place, std::uint32_t number) {
    sockaddr_in in{};
    in.sin_family = AF_INET;
    in.sin_addr.s_addr = htonl(number);
    std::memcpy(&place, &in, sizeof in);
  };
  address(route.rt_dst, 0xE0000000);      // 224.0.0.0
  address(route.rt_genmask, 0xF0000000);  // /4
  route.rt_flags = RTF_UP;
  route.rt_dev = device.ifr_name;
  ASSERT_EQ(::ioctl(fd, SIOCADDRT, &route), 0) << std::strerror(errno);
  ::close(fd);
}

/// Runs the body of a test in a network of its own: the test starts its own program again under `unshare`, as
/// root or else as the root of a user namespace, with itself as the only test.
inline void in_own_network(const std::function<void()>& body, std::chrono::seconds limit = 4 * kDeadline) {
  if (std::getenv(kInside) != nullptr) return body();
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string filter = std::string("--gtest_filter=") + test->test_suite_name() + "." + test->name();
  const std::string options = ::geteuid() == 0 ? "-n" : "-Urn";
  ASSERT_EQ(ForeignProgram({"unshare", options, "true"}).status(), 0)
      << "This test needs a network of its own: root, or user namespaces open to everybody (unshare "
      << options << ").";
  ::setenv(kInside, "1", 1);
  ForeignProgram inside({"unshare", options, std::filesystem::read_symlink("/proc/self/exe"), filter});
  ::unsetenv(kInside);
  ASSERT_TRUE(wait_until([&inside] { return !inside.running(); }, limit)) << "the test inside did not end";
  EXPECT_EQ(inside.status(), 0) << "the test inside failed, its output is above";
}

}  // namespace lockstep
